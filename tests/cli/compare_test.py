#!/usr/bin/env python3
"""Runs compare on small images of its own: exit statuses, and every result against the committed schema."""

import argparse
import json
import pathlib
import struct
import tempfile

import jsonschema

from blackbox import require, run, run_checks
from plain_exr import write_exr

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "configs/schema/compare.schema.json"
SIZE = 8


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
            write_exr(self.folder / f"{name}.exr", SIZE, SIZE, channels)
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

    def layers(self):
        document = self.judge(0, "within_thresholds", [], "brighter.exr", "a.exr", "--limit", "flip=0.1", "--limit", "ssim=0.99")
        layer, = document["layers"]
        require(layer["layer"] == "indirect" and abs(layer["luminance_bias"]["ratio"] - 1.05) < 1e-6, "bias of the gain")
        require(0.01 < layer["metrics"]["flip"] < 0.1, f"FLIP of the gain: {layer['metrics']['flip']}")
        require(sum(layer["histograms"]["reference"]["counts"]) == SIZE * SIZE, "every luminance has a bin")
        self.judge(1, "differs", ["limit"], "brighter.exr", "a.exr", "--limit", "flip=0.001")
        self.judge(1, "differs", ["limit"], "brighter.exr", "a.exr", "--limit", "ssim=0.9999999")
        self.judge(1, "differs", ["nothing_compared"], "a.exr", "b.exr", "--channels", "id", "--limit", "flip=1")
        self.judge(1, "differs", ["nothing_compared"], "a.exr", "b.exr", "--limit", "z_rms=1")
        ldr = self.judge(1, "differs", ["threshold"], "brighter.exr", "a.exr", "--flip-mode", "ldr", "--metric", "flip",
                         "--metric", "mse")
        require(ldr["layers"][0]["metrics"].keys() == {"flip"} and ldr["layers"][0]["ssim"] is None, "what was not asked for")
        require(ldr["layers"][0]["flip"]["out_of_range"] > 0, "values above 1 are counted")

    def seams(self):
        steps = image()
        steps["indirect.G"] = [2.0 if i % SIZE < 6 else 2.1 for i in range(SIZE * SIZE)]
        for name, channels in (("steps", steps), ("flat", image())):
            for c in "RB":
                channels[f"indirect.{c}"] = [2.0] * (SIZE * SIZE)
            write_exr(self.folder / f"{name}.exr", SIZE, SIZE, channels)
        files = ("steps.exr", "flat.exr", "--seams", "6", "--limit")
        document = self.judge(0, "within_thresholds", [], *files, "seam_max=0.036")
        seams = document["layers"][0]["seams"]
        require(abs(seams["excess"]["max"] - 0.7152 * 0.05 / 1.02) < 1e-5, f"the step in green: {seams}")
        require(seams["worst_border"] == "vertical" and seams["worst_pixel"][0] == 6, f"the step's place: {seams}")
        self.judge(1, "differs", ["limit"], *files, "seam_max=0.034")

    def perceived_maps(self):
        done = self.run("brighter.exr", "a.exr", "--flip-map", "flip.exr", "--ssim-map", "ssim.png")
        require(done.status == 1, f"{done}: expected status 1")
        self.judge(0, "same", [], "flip.exr", "flip.exr")
        require(struct.unpack(">II", (self.folder / "ssim.png").read_bytes()[16:24]) == (SIZE, SIZE), "size of the PNG")

    def bad_input(self):
        self.run("absent.exr", "a.exr").expect_error(3, r"E3001: absent\.exr")
        self.run("short.exr", "a.exr").expect_error(3, r"E3002: .*short\.exr")
        self.run("a.exr", "b.exr", "--limit", "relmse").expect_error(2, "E2002: --limit relmse")
        self.run("a.exr", "b.exr", "--limit", "msse=1").expect_error(2, "E2002: --limit msse: no such metric")
        self.run("a.exr", "b.exr", "--z-test").expect_error(3, "E3003: b.exr: variance.R: --z-test needs")
        self.run("a.exr", "b.exr", "--channels", "flux").expect_error(2, "E2002: --channels flux.*id.I, indirect.B")
        self.run("a.exr", "b.exr", "--layer", "flux", "--false-color", "f2.png").expect_error(2, "E2002: --layer flux")
        require(not (self.folder / "f2.png").exists(), "a failed run left its picture")
        self.run("a.exr", "b.exr", "--exposure", "bright", "--side-by-side", "f2.png").expect_error(2, "E2002: --exposure")

    def metrics_are_listed(self):
        listed = {line.split()[0] for line in self.run("--list-metrics").expect_success().out.splitlines()}
        known = {name for kind in ("channel", "layer") for name in self.schema["$defs"][f"{kind}_metrics"]["properties"]}
        limits = set(self.schema["properties"]["limits"]["propertyNames"]["enum"])
        require(listed == known == limits, f"the schema knows others than {listed}")

    def checks(self):
        return [(check.__name__, check) for check in (self.same, self.gain, self.thresholds, self.limits, self.nan,
                self.structure, self.pictures, self.layers, self.seams, self.perceived_maps, self.bad_input,
                self.metrics_are_listed)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("compare", type=pathlib.Path, help="the executable")
    with tempfile.TemporaryDirectory() as folder:
        return run_checks(CompareTest(parser.parse_args().compare.resolve(), folder).checks())


if __name__ == "__main__":
    raise SystemExit(main())
