"""What is measured of the papers' figures: metrics and times of images, flicker of sequences, kernels and lights, sizes of
code."""

import json
import pathlib

import numpy

import exr
import kernels
import paper_operators
from code_size import code_lines, dispatches
from paper_values import evaluate
from results import metrics

FILES = ("read", "write")


class NothingFound(Exception):
    """A figure measures what its experiment does not have."""


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


class Data:
    """The results of a figure's stages. Runs in the output folder. values: name -> value of each of its measures."""

    def __init__(self, figure):
        self.rows, self.sequences, self.code = figure["rows"], figure["sequences"], figure["code"]
        self.values = {}
        for name, spec in figure["content"]["measures"].items():
            self.values[name] = evaluate(spec["expression"], self.values) if "expression" in spec else self.one(spec)

    def select(self, where):
        """The images that the selector names by scene, variant, n, error, seed and frame; at least one."""
        found = [row for row in self.rows if all(row[key] == value for key, value in where.items())]
        if not found:
            raise NothingFound(f"no image of {where}; there are " + ", ".join(sorted({row["variant"] for row in self.rows})))
        return found

    def sequence(self, name):
        for row in self.sequences:
            if row["sequence"] == name:
                return row
        raise NothingFound(f"no sequence \"{name}\"; there are " + ", ".join(row["sequence"] for row in self.sequences))

    def one(self, spec):
        """A measure's value."""
        kind = next(key for key in spec if key in MEASURES)
        return MEASURES[kind](self, spec)


def mean_of(function):
    """A measure as the mean over images of what the function tells of one."""
    return lambda data, spec: float(numpy.mean([function(row, spec) for row in data.select(spec["of"])]))


def metric(row, spec):
    """Of compare, of a layer, by default `indirect`."""
    return metrics(row["comparison"], spec.get("layer", "indirect"))[spec["metric"]]


def milliseconds(row, spec):
    """Of stages, or of some of their phases, without reading and writing files. Clock "device": only while the device ran."""
    total = 0
    for tool in spec["time"]:
        phases = read_json(f"{row['stages'][tool]}/report.json")["phases"]
        if "phases" in spec:
            phases = [phase for phase in phases if phase["name"] in spec["phases"]]
            if not phases:
                raise NothingFound(f"{tool}: no phase {', '.join(spec['phases'])}")
        phases = [phase for phase in phases if phase["name"] not in spec.get("without", [])]
        if spec.get("clock") == "device":
            total += sum(phase.get("device_s", 0) for phase in phases)
        else:
            total += sum(phase["host_s"] for phase in phases if phase["name"].split()[0] not in FILES)
    return 1000 * total


def count(row, spec):
    """What a stage's tool counted; the key may lead into an object ("layer light/lit_texels")."""
    value = read_json(f"{row['stages'][spec['stage']]}/report.json")["counts"]
    for key in spec["count"].split("/"):
        value = value[key]
    return value


def channel(row, spec):
    """Of the image's channel: its mean over the pixels that are not black, or the share of pixels above a value."""
    values = exr.channels(row["image"], spec["channel"])
    lit = exr.colour(row["image"]) @ exr.LUMINANCE > 0
    if "above" in spec:
        return float(numpy.mean(values[lit] > spec["above"]))
    return float(numpy.mean(values[lit]))


def kernel(row, spec):
    """Of the kernels by which lights were filtered: how they cover the texels; see kernels.py."""
    return kernels.coverage(row["stages"]["vsgl-gen"], row["stages"]["pdf-build"])[spec["kernels"]]


def light(row, spec):
    """Of the list of lights: the power of the brightest, in means; see kernels.py."""
    return kernels.lights(row["stages"]["vsgl-gen"])[spec["light"]]


def flicker(data, spec):
    return read_json(data.sequence(spec["sequence"])["comparison"])[spec["flicker"]]


def frame_time(data, spec):
    """Milliseconds of a frame of the sequence: all stages of `render`, or those named."""
    row = data.sequence(spec["sequence"])
    phases = read_json(f"{row['stage']}/report.json")["phases"]
    if spec["frame_time"] is True:
        wanted = [phase for phase in phases if phase["name"].split()[0] not in FILES]
    else:
        wanted = [phase for phase in phases if phase["name"] in spec["frame_time"]]
    return 1000 * sum(phase["host_s"] for phase in wanted) / row["frames"]


def code(data, spec):
    """Of a method: "lines" that are neither empty nor comments, or "shaders"."""
    paths = data.code[spec["method"]]
    if spec["code"] == "shaders":
        return sum(path.endswith(".comp.glsl") for path in paths)
    return sum(code_lines(pathlib.Path(path).read_text(encoding="utf-8")) for path in paths)


def operator(_, spec):
    """Of the operators that give a lit sphere's radiance; see paper_operators.py."""
    return paper_operators.MEASURES[spec["operator"]]()


def dispatch_count(row, spec):
    return dispatches(read_json(f"{row['stages'][spec['dispatches']]}/report.json"))


MEASURES = {
    "metric": mean_of(metric),
    "time": mean_of(milliseconds),
    "count": mean_of(count),
    "channel": mean_of(channel),
    "kernels": mean_of(kernel),
    "light": mean_of(light),
    "dispatches": mean_of(dispatch_count),
    "flicker": flicker,
    "frame_time": frame_time,
    "code": code,
    "operator": operator,
}
