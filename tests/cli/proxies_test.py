#!/usr/bin/env python3
"""The proxies of the fixture hold by their schema, which also refuses what the reader refuses."""

import argparse
import copy
import json
import pathlib

import jsonschema

from blackbox import require, run_checks

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "configs/schema/proxies.schema.json"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fixture", type=pathlib.Path, required=True, help="folder of the artifacts")
    arguments = parser.parse_args()
    proxies = json.loads((arguments.fixture / "proxies.json").read_text())
    validator = jsonschema.Draft202012Validator(json.loads(SCHEMA.read_text()))

    def holds():
        validator.validate(proxies)
        require(proxies["objects"] and proxies["receivers"], "the fixture has no objects or no receivers")

    def refuses():
        for key, value in (("radius_m", 0), ("albedo", [2, 0, 0]), ("center", [1, 2]), ("colour", "red")):
            broken = copy.deepcopy(proxies)
            broken["objects"][0]["spheres"][0][key] = value
            require(not validator.is_valid(broken), f"the schema takes {key} {value}")

    return run_checks([("schema", holds), ("schema refuses", refuses)])


if __name__ == "__main__":
    raise SystemExit(main())
