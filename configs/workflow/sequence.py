"""Sequences of images of an animated scene, frame by frame in one folder: rendered, traced, measured by compare and loaded as
arrays."""

import json
import pathlib
import subprocess

import numpy

import exr
from chain import Chain, StageFailed


class Sequence:
    """The frames 0 .. frames - 1 of a scene, by several methods; that called LABEL has the files LABEL.0000.exr and so on. What
    is there already and unchanged is not made again."""

    def __init__(self, bin_dir, folder, frames, resolution, common=("--if-changed",)):
        self.chain = Chain(bin_dir, folder, common)
        self.frames = frames
        self.resolution = resolution

    def files(self, label):
        """Name of a method's frames, for compare and render."""
        return self.chain.path(f"{label}.%04d.exr")

    def file(self, label, frame):
        return self.chain.path(f"{label}.{frame:04d}.exr")

    def names(self, label):
        return [f"{label}.{frame:04d}.exr" for frame in range(self.frames)]

    def scene_gen(self, *arguments):
        """The scene; `arguments` must say what moves."""
        self.chain.scene_gen(*arguments, "--frames", str(self.frames))

    def render(self, label, pipeline, *arguments):
        """Renders all frames by a pipeline, a dictionary of the stages' options; returns the tool's result."""
        path = pathlib.Path(self.chain.path(f"{label}.pipeline.json"))
        text = json.dumps({"$schema": "vsgltools/pipeline/1", **pipeline}, indent=2) + "\n"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
        return self.chain.run("render", self.chain.path("scene.json"), "--pipeline", str(path), "--frames",
                              f"0:{self.frames - 1}", "--resolution", self.resolution, "-o", self.files(label), *arguments,
                              outputs=self.names(label))

    def reference(self, label, samples, seed):
        """Traces all frames. Seeds differ between frames: their noise must not repeat, or else it would hide."""
        for frame, name in enumerate(self.names(label)):
            self.chain.run("reference", self.chain.path("scene.json"), "--frame", str(frame), "--resolution", self.resolution,
                           "--samples", str(samples), "--seed", str(seed + frame), "-o", self.chain.path(name), outputs=[name])

    def compare(self, name, *arguments):
        """Runs compare; returns what it writes. Images that differ are no failure."""
        path = self.chain.path(f"{name}.json")
        command = [str(self.chain.bin / "compare"), *arguments, "-o", path, "--overwrite", "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            raise StageFailed(f"{' '.join(command)}\n{done.stderr}")
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))

    def flicker(self, test, truth):
        """The figures of a sequence against another (docs/compare.md)."""
        return self.compare(f"{test}-{truth}.flicker", self.files(test), self.files(truth), "--frames", f"0:{self.frames - 1}")

    def seams(self, test, truth):
        """Of each frame: steps at the borders of 16 x 16 tiles, and how far they exceed those beside them."""
        found = []
        for frame in range(self.frames):
            comparison = self.compare(f"{test}-{truth}.seams", self.file(test, frame), self.file(truth, frame), "--channels",
                                      "indirect", "--metric", "seam_p99", "--seams", "16")
            found.append(next(layer["seams"] for layer in comparison["layers"] if layer["layer"] == "indirect"))
        return found

    def load(self, label):
        """The layer `indirect` of all frames: [frame, row, column, channel], float64."""
        return numpy.stack([exr.colour(self.file(label, frame)) for frame in range(self.frames)])


def relative_steps(test, truth):
    """How much the error of each pixel changes from a frame to the next, relative to its luminance as compare's `pops` counts it:
    [frame - 1, row, column]. Both as load() gives them."""
    reference = truth @ exr.LUMINANCE
    seen = reference.max(axis=0) > 0
    floor = 0.05 * reference[:, seen].mean()
    return numpy.diff(test @ exr.LUMINANCE - reference, axis=0) / (reference[1:] + floor)
