#!/usr/bin/env python3
"""Changes a scene JSON in place by a JSON merge patch (RFC 7396): objects are merged, other values replaced, null removes.

Usage: scene_patch.py PATCH SCENE"""

import json
import pathlib
import sys

from stage import write_json


def merged(value, patch):
    """The patched value."""
    if not isinstance(patch, dict):
        return patch
    result = dict(value) if isinstance(value, dict) else {}
    for key, change in patch.items():
        if change is None:
            result.pop(key, None)
        else:
            result[key] = merged(result.get(key), change)
    return result


def main():
    patch, path = json.loads(sys.argv[1]), pathlib.Path(sys.argv[2])
    write_json(path, merged(json.loads(path.read_text(encoding="utf-8")), patch))


if __name__ == "__main__":
    main()
