#!/usr/bin/env python3
"""Runs compare on small images of its own: exit statuses, and every result against the committed schema."""

import argparse
import json
import pathlib
import struct
import tempfile

import jsonschema

from blackbox import require, run, run_checks

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "configs/schema/compare.schema.json"
SIZE = 8
UINT, FLOAT = 0, 2


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def write_exr(path, channels):
    """An uncompressed EXR of SIZE x SIZE pixels, written without OpenEXR; `channels`: name to values (int: UINT, float: FLOAT)."""
    names = sorted(channels)
    types = {name: UINT if isinstance(channels[name][0], int) else FLOAT for name in names}
    entries = b"".join(name.encode() + b"\0" + struct.pack("<iiii", types[name], 0, 1, 1) for name in names)
    window = struct.pack("<iiii", 0, 0, SIZE - 1, SIZE - 1)
    header = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute("channels", "chlist", entries + b"\0"), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
    rows = []
    for y in range(SIZE):
        row = b"".join(struct.pack(f"<{SIZE}{'If'[types[name] == FLOAT]}", *channels[name][y * SIZE:(y + 1) * SIZE])
                       for name in names)
        rows.append(struct.pack("<ii", y, len(row)) + row)
    first = len(header) + 8 * SIZE
    table = struct.pack(f"<{SIZE}Q", *(first + y * len(rows[0]) for y in range(SIZE)))
    path.write_bytes(header + table + b"".join(rows))


def image(gain=1.0):
    pixels = range(SIZE * SIZE)
    return {"indirect.R": [gain * (1.0 + i) for i in pixels], "indirect.G": [gain * 2.0] * len(pixels),
            "indirect.B": [gain * i / 4 for i in pixels], "id.I": list(pixels)}


class CompareTest:
    def __init__(self, compare, folder):
        self.compare = compare
        self.folder = pathlib.Path(folder)
        self.schema = json.loads(SCHEMA.read_text())
        jsonschema.Draft202012Validator.check_schema(self.schema)
        variants = {"a": image(), "b": image(), "brighter": image(1.05), "nan": image(), "few": image()}
        variants["nan"]["indirect.G"][5] = float("nan")
        del variants["few"]["indirect.B"]
        for name, channels in variants.items():
            write_exr(self.folder / f"{name}.exr", channels)
        (self.folder / "short.exr").write_bytes((self.folder / "a.exr").read_bytes()[:900])

    def run(self, *arguments):
        return run([self.compare, *arguments, "--overwrite"], cwd=self.folder)

    def judge(self, status, result, kinds, *arguments):
        """Runs it with -o; the file must be valid and say this; stdout under --json holds the same."""
        done = self.run(*arguments, "-o", "result.json", "--json")
        require(done.status == status, f"{done}: expected status {status}")
        document = json.loads((self.folder / "result.json").read_text())
        jsonschema.Draft202012Validator(self.schema).validate(document)
        require(document["result"] == result, f"{done}: is {document['result']}, expected {result}")
        found = {failure["kind"] for failure in document["failures"]}
        require(found == set(kinds), f"{done}: failures {found}, expected {kinds}")
        require(json.loads(done.out)["counts"]["comparison"] == document, "--json and -o disagree")
        for failure in document["failures"]:
            require(failure["message"] in done.err, f"{done}: stderr lacks {failure['message']!r}")
        return document

    def same(self):
        document = self.judge(0, "same", [], "a.exr", "b.exr")
        require(len(document["channels"]) == 4, "four channels")

    def gain(self):
        document = self.judge(1, "differs", ["threshold"], "brighter.exr", "a.exr")
        red = next(c for c in document["channels"] if c["channel"] == "indirect.R")
        require(abs(red["metrics"]["bias"] - 1.05) < 1e-6, "bias of the gain")
        require(abs(red["metrics"]["mrse"] - 0.0025) < 1e-6, "mrse of the gain")
        require(red["worst_pixel"] == [7, 7], "the worst pixel is the brightest")

    def thresholds(self):
        self.judge(0, "within_thresholds", [], "brighter.exr", "a.exr", "--threshold", "4")
        self.judge(1, "differs", ["hard_limit"], "brighter.exr", "a.exr", "--fail-percent", "100", "--hard-limit", "3")

    def limits(self):
        self.judge(0, "within_thresholds", [], "brighter.exr", "a.exr", "--limit", "relmse=0.003", "--limit", "bias=0.06")
        self.judge(1, "differs", ["limit"], "brighter.exr", "a.exr", "--limit", "relmse=0.002")

    def nan(self):
        for files in (["nan.exr", "a.exr"], ["a.exr", "nan.exr"], ["nan.exr", "nan.exr"]):
            self.judge(1, "differs", ["non_finite"], *files, "--threshold", "1e30")
        self.judge(0, "within_thresholds", [], "nan.exr", "a.exr", "--allow-non-finite")

    def structure(self):
        self.judge(1, "differs", ["missing_channel"], "few.exr", "a.exr")
        self.judge(1, "differs", ["missing_channel"], "a.exr", "few.exr")
        self.judge(0, "same", [], "a.exr", "few.exr", "--exclude", "indirect.B")

    def pictures(self):
        done = self.run("nan.exr", "brighter.exr", "--error-map", "e.exr", "--false-color", "f.png", "--side-by-side", "s.png")
        require(done.status == 1, f"{done}: expected status 1")
        for name, width in (("f.png", SIZE), ("s.png", 3 * SIZE)):
            size = struct.unpack(">II", (self.folder / name).read_bytes()[16:24])
            require(size == (width, SIZE), f"{name} is {size}")
        self.judge(0, "same", [], "e.exr", "e.exr")

    def bad_input(self):
        self.run("absent.exr", "a.exr").expect_error(3, r"E3001: absent\.exr")
        self.run("short.exr", "a.exr").expect_error(3, r"E3002: .*short\.exr")
        self.run("a.exr", "b.exr", "--limit", "relmse").expect_error(2, "E2002: --limit relmse")
        self.run("a.exr", "b.exr", "--limit", "msse=1").expect_error(2, "E2002: --limit msse: no such metric")
        self.run("a.exr", "b.exr", "--channels", "flux").expect_error(2, "E2002: --channels flux.*id.I, indirect.B")
        self.run("a.exr", "b.exr", "--layer", "flux", "--false-color", "f2.png").expect_error(2, "E2002: --layer flux")
        require(not (self.folder / "f2.png").exists(), "a failed run left its picture")
        self.run("a.exr", "b.exr", "--exposure", "bright", "--side-by-side", "f2.png").expect_error(2, "E2002: --exposure")

    def metrics_are_listed(self):
        listed = {line.split()[0] for line in self.run("--list-metrics").expect_success().out.splitlines()}
        known = {name for kind in ("channel", "layer") for name in self.schema["$defs"][f"{kind}_metrics"]["properties"]}
        require(listed == known == set(self.schema["properties"]["limits"]["propertyNames"]["enum"]), f"the schema knows others than {listed}")

    def checks(self):
        return [(check.__name__, check) for check in (self.same, self.gain, self.thresholds, self.limits, self.nan,
                self.structure, self.pictures, self.bad_input, self.metrics_are_listed)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("compare", type=pathlib.Path, help="the executable")
    with tempfile.TemporaryDirectory() as folder:
        return run_checks(CompareTest(parser.parse_args().compare.resolve(), folder).checks())


if __name__ == "__main__":
    raise SystemExit(main())
