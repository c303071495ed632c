#!/usr/bin/env python3
"""compare --z-test finds each planted fault and stays quiet between two seeds: on images whose noise is known, and on
those of the tool reference."""

import argparse
import json
import math
import pathlib
import random
import tempfile

from blackbox import require, run, run_checks
from plain_exr import read_exr, write_exr

WIDTH, HEIGHT, PASSES = 64, 40, 8
RGB = ("R", "G", "B")


def synthetic(seed):
    """What PASSES passes measure of a smooth image with edges, with noise of 15% a pass."""
    draw = random.Random(seed)
    channels = {f"{layer}.{c}": [] for layer in ("indirect", "diffuse", "variance") for c in RGB}
    for y in range(HEIGHT):
        for x in range(WIDTH):
            value = math.exp(math.sin(x / 9) + math.cos(y / 7)) * (4 if (x // 16 + y // 10) % 2 else 1)
            for c, scale in zip(RGB, (1.0, 0.6, 0.3)):
                samples = [value * scale * draw.gauss(1, 0.15) for _ in range(PASSES)]
                mean = sum(samples) / PASSES
                channels[f"indirect.{c}"].append(mean)
                channels[f"diffuse.{c}"].append(0.5 * mean)
                channels[f"variance.{c}"].append(sum((s - mean) ** 2 for s in samples) / (PASSES - 1) / PASSES)
    return WIDTH, HEIGHT, channels, {"reference.passes": PASSES}


def traced(tools, folder, seed):
    """What the tool reference makes of a small scene."""
    if not (folder / "scene.json").exists():
        run([tools / "scene-gen", "cornell-glossy", "-o", folder / "scene.json", "--quiet"]).expect_success()
    path = folder / f"seed{seed}.exr"
    run([tools / "reference", folder / "scene.json", "--resolution", "80x45", "--samples", "512", "--seed", str(seed), "-o", path,
         "--quiet"]).expect_success()
    return read_exr(path)


def nan_pixel(channels, width, reference):
    channels["indirect.G"][len(channels["indirect.G"]) // 2] = math.nan


def swapped_channels(channels, width, reference):
    channels["indirect.R"], channels["indirect.B"] = channels["indirect.B"], channels["indirect.R"]


def gain(channels, width, reference):
    for c in RGB:
        channels[f"indirect.{c}"] = [1.02 * v for v in channels[f"indirect.{c}"]]


def one_pixel_shift(channels, width, reference):
    for c in RGB:
        values = channels[f"indirect.{c}"]
        channels[f"indirect.{c}"] = values[:1] + values[:-1]


def missing_layer(channels, width, reference):
    for c in RGB:
        del channels[f"diffuse.{c}"]


def noise(channels, width, reference):
    """Three standard errors of the reference; the test states no variance, as a biased method would not."""
    draw = random.Random(7)
    for c in RGB:
        channels[f"indirect.{c}"] = [v + 3 * math.sqrt(s) * draw.gauss(0, 1)
                                     for v, s in zip(reference[f"indirect.{c}"], reference[f"variance.{c}"])]
        channels[f"variance.{c}"] = [0.0] * len(channels[f"variance.{c}"])


# Fault, and the kinds of failure of which one at least must be there.
FAULTS = ((nan_pixel, {"non_finite"}), (swapped_channels, {"z_mean"}), (gain, {"z_mean"}),
          (one_pixel_shift, {"z_pixel", "z_exact"}), (missing_layer, {"missing_channel"}), (noise, {"z_rms"}))


class FaultsTest:
    def __init__(self, compare, folder, make):
        self.compare, self.folder = compare, folder
        self.images = [make(seed) for seed in (1, 2)]
        for number, image in enumerate(self.images):
            self.write(f"image{number}.exr", image)

    def write(self, name, image):
        width, height, channels, attributes = image
        write_exr(self.folder / name, width, height, channels, {"reference.passes": attributes["reference.passes"]})

    def kinds(self, test, reference, *flags):
        done = run([self.compare, test, reference, "--z-test", "--metric", "z_rms", "--json", *flags], cwd=self.folder)
        require(done.status in (0, 1), f"{done}: failed")
        failures = json.loads(done.out)["counts"]["comparison"]["failures"]
        require(done.status == (1 if failures else 0), f"{done}: status and failures disagree")
        return {failure["kind"] for failure in failures}

    def quiet_between_seeds(self):
        found = self.kinds("image0.exr", "image1.exr")
        require(not found, f"a false alarm: {found}")

    def quiet_with_itself(self):
        require(not self.kinds("image1.exr", "image1.exr"), "a difference from itself")

    def finds(self, fault, expected):
        width, height, channels, attributes = self.images[0]
        broken = dict(channels)
        broken["indirect.G"] = list(channels["indirect.G"])
        fault(broken, width, self.images[1][2])
        self.write("broken.exr", (width, height, broken, attributes))
        found = self.kinds("broken.exr", "image1.exr")
        require(found & expected, f"{fault.__name__}: found {found}, expected one of {expected}")

    def checks(self, prefix):
        quiet = [(f"{prefix} {check.__name__}", check) for check in (self.quiet_between_seeds, self.quiet_with_itself)]
        faults = [(f"{prefix} {fault.__name__}", lambda f=fault, e=kinds: self.finds(f, e)) for fault, kinds in FAULTS]
        return quiet + faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the executables")
    tools = parser.parse_args().bin.resolve()
    with tempfile.TemporaryDirectory() as a, tempfile.TemporaryDirectory() as b:
        of_known_noise = FaultsTest(tools / "compare", pathlib.Path(a), synthetic)
        of_reference = FaultsTest(tools / "compare", pathlib.Path(b), lambda seed: traced(tools, pathlib.Path(b), seed))
        return run_checks(of_known_noise.checks("known noise:") + of_reference.checks("reference:"))


if __name__ == "__main__":
    raise SystemExit(main())
