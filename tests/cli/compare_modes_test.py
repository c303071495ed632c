#!/usr/bin/env python3
"""Runs compare on sequences of images and on chains of them: exit statuses, and every result against the committed schemas."""

import argparse
import json
import math
import pathlib
import random
import tempfile

import jsonschema

from blackbox import require, run, run_checks
from compare_test import SIZE
from plain_exr import write_exr

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "configs/schema"
FRAMES = 6


def grey(value, layer="indirect"):
    """An image whose three channels are value(x, y)."""
    pixels = [float(value(i % SIZE, i // SIZE)) for i in range(SIZE * SIZE)]
    return {f"{layer}.{channel}": pixels for channel in "RGB"}


def wave(frame, bias=0.0):
    return grey(lambda x, y: 2 + bias + math.sin(0.9 * (x - frame)) * math.cos(0.7 * y))


class ModesTest:
    def __init__(self, compare, folder):
        self.compare = compare
        self.folder = pathlib.Path(folder)
        self.schemas = {mode: json.loads((SCHEMAS / f"{mode}.schema.json").read_text()) for mode in ("flicker", "decomposition")}
        for schema in self.schemas.values():
            jsonschema.Draft202012Validator.check_schema(schema)

    def write(self, name, channels):
        write_exr(self.folder / name, SIZE, SIZE, channels)

    def sequence(self, name, image, frames=FRAMES):
        for frame in range(frames):
            self.write(f"{name}.{frame:04d}.exr", image(frame))

    def run(self, *arguments):
        return run([self.compare, *arguments, "--overwrite"], cwd=self.folder)

    def judge(self, mode, status, result, *arguments):
        """Runs it with -o; the file must be valid and say this; stdout under --json holds the same."""
        done = self.run(*arguments, "-o", "result.json", "--json")
        require(done.status == status, f"{done}: expected status {status}")
        document = json.loads((self.folder / "result.json").read_text())
        jsonschema.Draft202012Validator(self.schemas[mode]).validate(document)
        require(document["result"] == result, f"{done}: is {document['result']}, expected {result}")
        require(json.loads(done.out)["counts"]["comparison"] == document, "--json and -o disagree")
        return document

    def flicker(self, status, result, kinds, test, *arguments, last=FRAMES - 1):
        document = self.judge("flicker", status, result, f"{test}.%04d.exr", "b.%04d.exr", "--frames", f"0:{last}", *arguments)
        found = {failure["kind"] for failure in document["failures"]}
        require(found == set(kinds), f"failures {found}, expected {kinds}")
        return document

    def sequences(self):
        self.sequence("b", wave)
        self.sequence("biased", lambda frame: wave(frame, 0.25))
        noise = random.Random(1)
        self.sequence("noisy", lambda frame: {name: [v + noise.gauss(0, 0.1) for v in values] for name, values in wave(frame).items()})
        equal = self.flicker(0, "within_limits", [], "b")
        require(equal["flicker"] == equal["bias_rms"] == 0 and equal["spectrum"] is None, "equal sequences do not flicker")
        biased = self.flicker(0, "within_limits", [], "biased", "--limit", "flicker=1e-6")
        require(biased["bias_mean"] > 0.05, "the bias is seen")
        noisy = self.flicker(0, "within_limits", [], "noisy", "--versus", "biased.%04d.exr", "--limit", "flicker=0.2")
        require(noisy["versus"]["difference"] == noisy["flicker"] - noisy["versus"]["flicker"] > 0, "the noisy one flickers more")
        require(noisy["versus"]["difference_interval"][0] > 0, "and that is sure")
        self.flicker(1, "differs", ["limit"], "noisy", "--limit", "flicker=0.01")

    def frames_out_of_place(self):
        self.sequence("b", wave, FRAMES + 1)
        self.sequence("dropped", lambda frame: wave(frame if frame < 3 else frame + 1))
        self.sequence("repeated", lambda frame: wave(2 if frame == 3 else frame))
        dropped = self.flicker(1, "differs", ["misaligned_frame"], "dropped")
        require(dropped["misaligned"][0] == {"frame": 3, "offset": 1}, f"misaligned: {dropped['misaligned']}")
        repeated = self.flicker(1, "differs", ["misaligned_frame", "repeated_frame"], "repeated")
        require(repeated["repeated"] == [3], f"repeated: {repeated['repeated']}")

    def spectrum(self):
        self.sequence("b", wave, 64)
        self.sequence("waving", lambda frame: wave(frame, 0.1 * math.sin(2 * math.pi * frame / 6)), 64)
        at_60_hz = self.flicker(0, "within_limits", [], "waving", last=63)["spectrum"]
        require(at_60_hz["visible"] > 10 * at_60_hz["fast"], f"10 Hz is visible: {at_60_hz}")
        at_240_hz = self.flicker(0, "within_limits", [], "waving", "--frame-rate", "240", last=63)["spectrum"]
        require(at_240_hz["visible"] < 0.1 * at_60_hz["visible"], f"40 Hz is not: {at_240_hz}")

    def bad_sequences(self):
        self.sequence("b", wave)
        self.sequence("nan", wave)
        broken = wave(2)
        broken["indirect.G"][9] = math.nan
        self.write("nan.0002.exr", broken)
        pair = ["b.%04d.exr", "b.%04d.exr"]
        frames = ["--frames", "0:5"]
        self.run("nan.%04d.exr", "b.%04d.exr", *frames).expect_error(3, r"E3006: nan\.0002\.exr.*NaN at \(1,1\)")
        self.run(*pair, "--frames", "100:101").expect_error(3, r"E3001: b\.0100\.exr")
        self.run(*pair, *frames, "--layer", "specular").expect_error(3, r"E3003: b\.0000\.exr.*specular")
        self.run(*pair).expect_error(2, "E2004: --frames")
        self.run(*pair, "--frames", "5").expect_error(2, "E2002: --frames 5")
        self.run(*pair, "--frames", "5:5").expect_error(2, "E2003: --frames 5:5")
        self.run(*pair, *frames, "--limit", "flicker").expect_error(2, "E2002: --limit flicker")
        self.run(*pair, *frames, "--limit", "rmse=1").expect_error(2, "E2002: --limit rmse: no metric of sequences")
        self.run(*pair, *frames, "--threshold", "1").expect_error(2, "E2005: --threshold: does not go with sequences")
        self.run(*pair, *frames, "--step", "a=b.exr").expect_error(2, "E2005: --step: does not go with sequences")
        self.run("b.%04d.exr", "b.0000.exr", *frames).expect_error(2, r"E2005: b\.0000\.exr: must be a sequence")
        self.run("b.0000.exr", "b.0001.exr", *frames).expect_error(2, "E2005: --frames: needs two sequences")
        self.run(*pair, *frames, "--versus", "b.0000.exr").expect_error(2, r"E2002: --versus b\.0000\.exr")

    def chain(self):
        """Errors of the known size and sign, orthogonal to one another."""
        truth = grey(lambda x, y: 2 + x % 2)
        plus = lambda image, value: {name: [v + value(i % SIZE, i // SIZE) for i, v in enumerate(values)] for name, values in image.items()}
        leaky = plus(truth, lambda x, y: 0.25 if y % 2 else -0.25)
        self.write("truth.exr", truth)
        self.write("leaky.exr", leaky)
        self.write("all.exr", plus(leaky, lambda x, y: 0.5 if x % 4 < 2 else -0.5))
        self.write("rest.exr", plus(truth, lambda x, y: 0.125))
        steps = ["--step", "clustering=leaky.exr", "--step", "leaks=truth.exr"]
        document = self.judge("decomposition", 0, "explained", *steps, "all.exr", "truth.exr")
        shares = {step["cause"]: step["share"] for step in document["steps"]}
        require(abs(shares["clustering"] - 0.8) < 1e-6 and abs(shares["leaks"] - 0.2) < 1e-6, f"shares {shares}")
        require(document["remainder"]["cause"] == "discretisation" and document["remainder"]["share"] == 0, "nothing remains")
        relative = self.judge("decomposition", 0, "explained", *steps, "all.exr", "truth.exr", "--step-weights", "relative")
        require(relative["weights"] == "relative", "the weights are named")
        require(abs(relative["total"]["rms"] ** 2 / relative["total"]["relmse"] - 1) < 1e-3, f"the whole is relmse: {relative['total']}")
        left = self.judge("decomposition", 1, "unexplained", "all.exr", "truth.exr", "--step", "x=rest.exr", "--remainder", "left")
        require(left["remainder"]["cause"] == "left" and left["remainder"]["power"] > 0, "the rest is left")
        self.judge("decomposition", 0, "explained", "all.exr", "truth.exr", "--step", "x=rest.exr", "--limit", "remainder=0.1")
        table = self.run("all.exr", "truth.exr", *steps).expect_success().out
        for word in ("clustering", "leaks", "discretisation", "noise of the reference", "0.8000"):
            require(word in table, f"the table lacks {word}: {table}")

    def seeds(self):
        noise = random.Random(2)
        noisy = lambda: {name: [v + noise.gauss(0, 0.2) for v in values] for name, values in wave(0).items()}
        for name in ("all", "s1", "s2", "s3"):
            self.write(f"{name}.exr", noisy())
        self.write("truth.exr", wave(0))
        averaged = self.judge("decomposition", 0, "explained", "all.exr", "truth.exr", "--step", "sampling=s1.exr,s2.exr,s3.exr",
                              "--limit", "remainder=0.2")
        require(averaged["steps"][0]["files"] == ["s1.exr", "s2.exr", "s3.exr"], "the files are named")
        require(abs(averaged["steps"][0]["power"] - 1) < 0.25, f"sampling is all: {averaged['steps'][0]}")
        self.run("all.exr", "truth.exr", "--step", "sampling=s1.exr,all.exr").expect_error(3, r"E3021: all\.exr.*other seeds")

    def bad_chains(self):
        self.write("a.exr", wave(0))
        run_with = lambda *arguments: self.run("a.exr", "a.exr", *arguments)
        for text in ("a.exr", "=a.exr", "cause="):
            run_with("--step", text).expect_error(2, f"E2002: --step {text}")
        run_with("--step", "cause=absent.exr").expect_error(3, r"E3001: absent\.exr")
        run_with("--step", "x=a.exr", "--step", "x=a.exr").expect_error(2, "E2002: --step x: is given twice")
        run_with("--step", "left=a.exr", "--remainder", "left").expect_error(2, "E2002: --step left: .*--remainder")
        run_with("--remainder", "left").expect_error(2, "E2005: --remainder: needs --step")
        run_with("--step-weights", "relative").expect_error(2, "E2005: --step-weights: needs --step")
        run_with("--step", "x=a.exr", "--limit", "rmse=1").expect_error(2, "E2002: --limit rmse=1")
        run_with("--step", "x=a.exr", "--limit", "remainder=-1").expect_error(2, "E2003: --limit remainder=-1")
        run_with("--step", "x=a.exr", "--threshold", "1").expect_error(2, "E2005: --threshold: does not go with --step")

    def checks(self):
        return [(check.__name__, check) for check in (self.sequences, self.frames_out_of_place, self.spectrum, self.bad_sequences,
                                                      self.chain, self.seeds, self.bad_chains)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("compare", type=pathlib.Path, help="the executable")
    with tempfile.TemporaryDirectory() as folder:
        return run_checks(ModesTest(parser.parse_args().compare.resolve(), folder).checks())


if __name__ == "__main__":
    raise SystemExit(main())
