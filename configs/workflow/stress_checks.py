"""What each kind of case of the stress suite compares, and with what. A check returns how far the tools are off and what it left
out; the case says how far they may be off."""

import dataclasses
import json
import math

import numpy

import exr
from stress_tools import ToolFailed

FLOOR = 0.02  # of the mean: what a dark pixel's error is relative to, at least
LEAST_DEVIATION = 1e-6  # of a light's footprint, in scene radii: docs/sampling.md
MOVED = 1e-3  # of the scene's radius: a pixel whose point moved by more sees another surface


class CheckFailed(Exception):
    """Not a matter of degree: a value that is not finite, an image that should not be black, an error that did not come."""


@dataclasses.dataclass
class Measured:
    error: float
    left_out: int = 0  # pixels
    pixels: int = 0


def require(condition, message):
    if not condition:
        raise CheckFailed(message)


def luminance(colour):
    return colour @ exr.LUMINANCE


def sound_image(made):
    """The indirect image, RGB in float64, after a look at every channel of the file: all finite, none negative."""
    channels, _ = exr.read(made.path("indirect.exr"))
    for name, values in channels.items():
        require(numpy.isfinite(values).all(), f"indirect.exr: {name} is not finite")
        require((values >= 0).all(), f"indirect.exr: {name} is negative")
    return made.image()


def relative_mse(test, truth):
    """Of luminances, over the pixels given; the floor keeps dark pixels from deciding it alone."""
    mean = truth.mean()
    require(mean > 0, "the image to compare with is black")
    return float((((test - truth) ** 2) / (truth**2 + (FLOOR * mean) ** 2)).mean())


def world_positions(made):
    channels, attributes = exr.read(made.path("gbuffer.exr"))
    relative = numpy.stack([channels[f"position.{letter}"] for letter in "XYZ"], axis=-1).astype(float)
    return relative + attributes["anchor"], channels["id.I"], float(attributes["scene_radius"][0])


def same_surface(made, other, case):
    """Which pixels of both runs see the same point of the same surface, and how many see any."""
    place, found, radius = world_positions(made)
    home, home_found, _ = world_positions(other)
    moved = numpy.array(case.get("offset", [0, 0, 0]), dtype=float)
    mirror = [-1, 1, 1] if case.get("mirrored") else [1, 1, 1]
    if case.get("mirrored"):
        home, home_found = home[:, ::-1], home_found[:, ::-1]
    distance = numpy.linalg.norm((place - moved) - home * mirror * case.get("scale", 1), axis=-1)
    seen = (found != 0xFFFFFFFF) | (home_found != 0xFFFFFFFF)
    return seen & (found == home_found) & (distance <= MOVED * radius), seen


def check_same(workshop, case):
    """The image is that of `base`, times `factor`; with `mirrored` left is right. relMSE of luminance over the pixels that see
    the same surface."""
    made, other = workshop.make(case["run"]), workshop.make(case["base"])
    test, truth = luminance(sound_image(made)), luminance(sound_image(other)) * case.get("factor", 1)
    if case.get("mirrored"):
        truth = truth[:, ::-1]
    same, seen = same_surface(made, other, case)
    require(same.any(), "no pixel sees what it saw")
    left_out = int((seen & ~same).sum())
    require(left_out <= case.get("may_leave_out", 0) * seen.sum(), f"{left_out} of {seen.sum()} pixels see another surface")
    return Measured(relative_mse(test[same], truth[same]), left_out, int(seen.sum()))


def check_black(workshop, case):
    """Nothing reflects, or nothing arrives: every value is exactly 0."""
    return Measured(float(numpy.abs(sound_image(workshop.make(case["run"]))).max()))


def check_sound(workshop, case):
    """The chain runs through; every value of the image is finite and none negative. Not black, unless it `may_be_black`."""
    image = sound_image(workshop.make(case["run"]))
    require(case.get("may_be_black") or image.max() > 0, "the image is black")
    return Measured(0.0)


def check_error(workshop, case):
    """The chain ends at a tool with the documented error."""
    expected = case["error"]
    try:
        workshop.make(case["run"])
    except ToolFailed as failed:
        found = {"tool": failed.tool, "status": failed.status, "code": failed.code}
        require(found == expected, f"expected {expected}, got {found}: {failed}")
        return Measured(0.0)
    raise CheckFailed(f"expected {expected}, but the chain ran through")


def reflected(made):
    """Sum of the reflected power over the texels of the first layer, RGB, in float64; and the channels."""
    channels, _ = exr.read(made.path("rsm.exr"))
    total = numpy.zeros(3)
    for part in ("diffuse", "specular"):
        if f"power_{part}.R" in channels:
            total += [channels[f"power_{part}.{c}"].astype(float).sum() for c in "RGB"]
    return total, channels


def check_flux(workshop, case):
    """The flux of a spot light's RSM is the integral of its intensity, in closed form: 2 pi I (1 - ci + (ci - co) / 3) with the
    cosines of the inner and outer cone, between which it falls off with the square. All of the cone must meet the scene."""
    made = workshop.make(case["run"])
    sound_image(made)
    channels, attributes = exr.read(made.path("rsm.exr"))
    inner, outer = (float(attributes[f"light.cos_{name}"][0]) for name in ("inner", "outer"))
    exact = 2 * math.pi * attributes["light.intensity"] * (1 - inner + (inner - outer) / 3)
    found = [channels[f"flux.{c}"].astype(float).sum() for c in "RGB"]
    return Measured(float(numpy.abs(found / exact - 1).max()))


def check_power(workshop, case):
    """The lights emit what the RSM's texels reflect: relative error of the luminance, summed in float64."""
    made = workshop.make(case["run"])
    sound_image(made)
    total, _ = reflected(made)
    lights, attributes = exr.read(made.path("lights.exr"))
    leaves = (lights["children.I"] == 0) if attributes["lights.tree"] == b"\1\0\0\0" else numpy.True_
    found = numpy.zeros(3)
    for part in ("diffuse", "specular"):
        if f"power_{part}.R" in lights:
            found += [numpy.where(leaves, lights[f"power_{part}.{c}"], 0).astype(float).sum() for c in "RGB"]
    require((total > 0).all(), "nothing reflects")
    return Measured(abs(float(luminance(found) / luminance(total)) - 1))


def check_moments(workshop, case):
    """Of a single light of all texels: mean position, variance, mean normal and its deficit against sums over the texels in
    float64, by the law of total variance about the true mean; relative to the deviation, and to 1 for normals."""
    made = workshop.make(case["run"])
    _, texels = reflected(made)
    lights, attributes = exr.read(made.path("lights.exr"))
    floor = (LEAST_DEVIATION * float(attributes["scene_radius"][0])) ** 2
    weight = texels["weight.V"].astype(float).ravel()
    weight /= weight.sum()
    gather = lambda name: numpy.stack([texels[f"{name}.{letter}"].astype(float).ravel() for letter in "XYZ"], axis=-1)
    place, normal = gather("position"), gather("normal_moment")
    mean = weight @ place
    variance = float(weight @ (texels["spread.V"].astype(float).ravel() + ((place - mean) ** 2).sum(axis=-1))) / 2
    variance = max(variance, floor)
    mean_normal = weight @ normal
    deficit = float(weight @ (texels["normal_moment.Q"].astype(float).ravel() + ((normal - mean_normal) ** 2).sum(axis=-1)))
    first = lambda name: numpy.array([lights[f"{name}.{letter}"].ravel()[0] for letter in "XYZ"], dtype=float)
    errors = [numpy.linalg.norm(first("position") - mean) / variance**0.5,
              abs(float(lights["variance.V"].ravel()[0]) / variance - 1),
              abs(float(lights["normal_deficit.V"].ravel()[0]) - deficit),
              numpy.linalg.norm(first("normal") - mean_normal / numpy.linalg.norm(mean_normal))]
    return Measured(float(max(errors)))


def check_twin(workshop, case):
    """The image against the same lights summed in double precision by stress_twin: largest error of a channel of a layer over the
    layer's largest value, row by row where `rows`, else in the image."""
    made = workshop.make(case["run"])
    sound_image(made)
    shade = json.loads(made.path("shade.json").read_text(encoding="utf-8"))
    known = ("light_model", "specular_lobe", "cbr")
    words = [f"--{key.replace('_', '-')}={value}" for key, value in shade.items() if key in known]
    cut = ["--cut", made.path("ism.exr")] if made.path("ism.exr").exists() else []
    workshop.tool("stress_twin", "--gbuffer", made.path("gbuffer.exr"), "--lights", made.path("lights.exr"), *cut, *words, "-o",
                  made.path("twin.exr"), "--overwrite", "--quiet")
    worst = 0.0
    for layer in ("diffuse", "specular"):
        names = [f"{layer}.{c}" for c in "RGB"]
        if names[0] not in exr.read(made.path("indirect.exr"))[0]:
            continue
        test = exr.channels(made.path("indirect.exr"), *names).astype(float)
        truth = exr.channels(made.path("twin.exr"), *names).astype(float)
        require(numpy.isfinite(truth).all() and truth.max() > 0, f"the twin's {layer} light is black or not finite")
        axes = (1, 2) if case.get("rows") else (0, 1, 2)
        error, peak = numpy.abs(test - truth).max(axis=axes), truth.max(axis=axes)
        worst = max(worst, float(numpy.max(error / numpy.maximum(peak, numpy.finfo(numpy.float32).tiny))))
    return Measured(worst)


CHECKS = {name.removeprefix("check_"): check for name, check in globals().items() if name.startswith("check_")}
