#!/usr/bin/env python3
"""Runs tiny.json once, undisturbed, for the other tests to compare with."""

import shutil
import time

from workflow import files, parser, run


def main():
    options = parser(__doc__).parse_args()
    shutil.rmtree(options.undisturbed, ignore_errors=True)
    start = time.monotonic()
    run(options.bin, options.undisturbed)
    print(f"{len(files(options.undisturbed))} files in {time.monotonic() - start:.1f} s")
    for name in ("results.json", "results.csv", "equal.csv", "report.html"):
        assert (options.undisturbed / name).stat().st_size > 0, name
    assert not list(options.undisturbed.rglob("ism.exr")), "shadow maps are kept though nobody needs them any more"


if __name__ == "__main__":
    main()
