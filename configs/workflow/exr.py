"""Channels of EXR files as arrays. The tools' files of one part in scan lines, which are not compressed, are read here; oiiotool
turns others into such."""

import pathlib
import struct
import subprocess
import tempfile

import numpy

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])  # of linear Rec. 709
MAGIC = 20000630
TILED, SEVERAL_PARTS = 0x200, 0x1000
NUMBERS = {"float": "<f4", "v3f": "<f4", "double": "<f8", "v3d": "<f8"}  # kinds of attributes
TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}


class BadImage(Exception):
    """No EXR file, or none with the channels asked for."""


def _text(data, place):
    end = data.index(b"\0", place)
    return data[place:end].decode(), end + 1


def _header(data):
    """Attributes by name, numbers and vectors as arrays, others as bytes; and where the header ends."""
    found, place = {}, 8
    while True:
        name, place = _text(data, place)
        if not name:
            return found, place
        kind, place = _text(data, place)
        size = struct.unpack_from("<i", data, place)[0]
        value = data[place + 4:place + 4 + size]
        found[name] = numpy.frombuffer(value, NUMBERS[kind]) if kind in NUMBERS else value
        place += 4 + size


def _types(entries):
    """Channel -> type, in the file's order."""
    found, place = {}, 0
    while entries[place:place + 1] != b"\0":
        name, place = _text(entries, place)
        found[name] = TYPES[struct.unpack_from("<i", entries, place)[0]]
        place += 16
    return found


def _converted(path, part):
    """The file's part, without compression and in scan lines, as bytes."""
    with tempfile.TemporaryDirectory() as folder:
        target = pathlib.Path(folder) / "plain.exr"
        command = ["oiiotool", "--nosoftwareattrib", path, "--subimage", str(part), "--selectmip", "0", "--compression", "none",
                   "--scanline", "-o", target]
        subprocess.run(command, check=True, capture_output=True)
        return target.read_bytes()


def _is_plain(data, path):
    """Whether the file has one part in scan lines without compression."""
    magic, version = struct.unpack_from("<ii", data) if len(data) >= 8 else (0, 0)
    if magic != MAGIC:
        raise BadImage(f"{path}: no EXR file")
    return not version & (TILED | SEVERAL_PARTS) and _header(data)[0]["compression"] == b"\0"


def _lines(data):
    """The scan lines of a plain file, one array with a field per channel, and the header's attributes."""
    attributes, place = _header(data)
    left, top, right, bottom = struct.unpack("<iiii", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    types = _types(attributes["channels"])
    line = numpy.dtype([("y", "<i4"), ("bytes", "<i4"), *((name, kind, (width,)) for name, kind in types.items())])
    return numpy.frombuffer(data, line, height, place + 8 * height), attributes


def read(path, part=0):
    """(channel -> array [height, width], attribute -> value) of a part at full resolution."""
    data = pathlib.Path(path).read_bytes()
    lines, attributes = _lines(data if _is_plain(data, path) else _converted(path, part))
    return {name: lines[name] for name in lines.dtype.names[2:]}, attributes


def replace(path, arrays):
    """Writes channels of a file of one part, not compressed and in scan lines, anew: channel -> array [height, width]."""
    data = bytearray(pathlib.Path(path).read_bytes())
    if not _is_plain(data, path):
        raise BadImage(f"{path}: not one part in scan lines without compression")
    lines, _ = _lines(data)
    for name, values in arrays.items():
        lines[name] = values
    pathlib.Path(path).unlink()  # of a link the file behind it stays as it is
    pathlib.Path(path).write_bytes(data)


def channels(path, *names, part=0):
    """Array [height, width, channels], or [height, width] of one channel."""
    found, _ = read(path, part)
    missing = [name for name in names if name not in found]
    if missing:
        raise BadImage(f"{path}: has no channel {missing[0]}; it has {', '.join(found)}")
    arrays = [numpy.asarray(found[name]) for name in names]
    return arrays[0] if len(arrays) == 1 else numpy.stack(arrays, axis=-1)


def colour(path, layer="indirect"):
    """Linear RGB, float64."""
    return channels(path, *(f"{layer}.{c}" for c in "RGB")).astype(float)
