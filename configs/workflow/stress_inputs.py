"""Artifacts with values that no scene would give: channels of a file that a tool wrote are replaced in place."""

import math

import numpy

import exr


PLACES = ("position", "origin")  # layers of X, Y, Z that are no directions


def edit(path, changes):
    """Writes channels, or whole layers, anew. Each has a list of values that repeats over the pixels, so that lists of coprime
    lengths meet in all combinations: numbers for a channel, triples for a layer. "around" replaces a G-buffer by pixels around a
    light, see pixels_around()."""
    channels, attributes = exr.read(path)
    shape = next(iter(channels.values())).shape
    replaced = {}
    for name, values in changes.items():
        if name == "around":
            replaced |= pixels_around(shape, attributes["camera"], values)
        elif "." in name:
            replaced[name] = repeated(values, shape)
        else:
            replaced |= layer(name, numpy.array(values, dtype=float), channels, shape)
    missing = set(replaced) - set(channels)
    if missing:
        raise exr.BadImage(f"{path}: has no channel {', '.join(sorted(missing))}")
    exr.replace(path, {name: values.astype(channels[name].dtype) for name, values in replaced.items()})


def repeated(values, shape):
    return numpy.resize(numpy.array(values, dtype=float), shape)


def layer(name, triples, channels, shape):
    """Channels of a colour, a place, or a direction, which is normalised."""
    letters = "RGB" if f"{name}.R" in channels else "XYZ"
    if letters == "XYZ" and name not in PLACES:
        triples = unit(triples)
    return {f"{name}.{letter}": repeated(triples[:, i], shape) for i, letter in enumerate(letters)}


def unit(v):
    return v / numpy.linalg.norm(v, axis=-1, keepdims=True)


def across(axis, turns):
    """Unit vectors across an axis, turned about it by a share of a full turn."""
    helper = numpy.where(numpy.abs(axis[..., :1]) > 0.9, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0])
    first = unit(numpy.cross(axis, helper))
    second = numpy.cross(axis, first)
    angle = 2 * math.pi * turns[..., None]
    return numpy.cos(angle) * first + numpy.sin(angle) * second


def pixels_around(shape, camera, spec):
    """Channels of a G-buffer whose pixels lie around the place 0, where a light stands. A row has one of `distances_m`. Along it
    the direction from the light deviates from `axis` by `deviation_deg`, in units of the lobe's width 1/sqrt(`sharpness`), at
    most 1 rad; the normal leans from the half vector of light and view by `tilt`, in units of `alpha` rad. Lists repeat, azimuths
    follow the golden ratio."""
    height, width = shape
    column = numpy.tile(numpy.arange(width), (height, 1))
    turns = numpy.modf(column * 0.6180339887498949)[0]
    listed = lambda key: numpy.resize(numpy.array(spec[key], dtype=float), width)[column]
    lobe = 1 / math.sqrt(max(spec["sharpness"], 1.0))
    deviation = numpy.minimum(listed("deviation") * lobe, math.pi)
    axis = numpy.broadcast_to(unit(numpy.array(spec["axis"], dtype=float)), (height, width, 3))
    away = numpy.cos(deviation)[..., None] * axis + numpy.sin(deviation)[..., None] * across(axis, turns)
    distance = numpy.resize(numpy.array(spec["distances_m"], dtype=float), height)[:, None, None]
    position = (distance * away).astype(numpy.float32)
    view = unit(camera - position.astype(float))
    half = view - away
    length = numpy.linalg.norm(half, axis=-1, keepdims=True)
    half = numpy.where(length > 1e-6, half / numpy.maximum(length, 1e-6), view)
    tilt = numpy.minimum(listed("tilt") * listed("alpha"), 1.5)[..., None]
    normal = numpy.cos(tilt) * half + numpy.sin(tilt) * across(half, numpy.modf(turns * 7)[0])
    facing = (normal * view).sum(axis=-1, keepdims=True)
    normal = unit(numpy.where(facing < 0, normal - 2 * facing * view, normal))
    found = {"alpha.V": listed("alpha"), "ndf.I": listed("ndf")}
    for name, vectors in (("position", position), ("normal", normal), ("shading_normal", normal)):
        found |= {f"{name}.{letter}": vectors[..., i] for i, letter in enumerate("XYZ")}
    return found
