"""Reads and writes uncompressed EXR files of one part in scan lines, without OpenEXR."""

import struct

UINT, HALF, FLOAT = 0, 1, 2
MAGIC = struct.pack("<i", 20000630)


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def write_exr(path, width, height, channels, integers=None):
    """`channels`: name to values, row by row from the top-left (int: UINT, float: FLOAT); `integers`: int attributes."""
    names = sorted(channels)
    types = {name: UINT if isinstance(channels[name][0], int) else FLOAT for name in names}
    entries = b"".join(name.encode() + b"\0" + struct.pack("<iiii", types[name], 0, 1, 1) for name in names)
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = MAGIC + struct.pack("<i", 2) + b"".join([
        attribute("channels", "chlist", entries + b"\0"), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
        *(attribute(name, "int", struct.pack("<i", value)) for name, value in (integers or {}).items())]) + b"\0"
    rows = []
    for y in range(height):
        row = b"".join(struct.pack(f"<{width}{'If'[types[name] == FLOAT]}", *channels[name][y * width:(y + 1) * width])
                       for name in names)
        rows.append(struct.pack("<ii", y, len(row)) + row)
    first = len(header) + 8 * height
    table = struct.pack(f"<{height}Q", *(first + y * len(rows[0]) for y in range(height)))
    path.write_bytes(header + table + b"".join(rows))


def read_exr(path):
    """(width, height, channels, attributes); attributes as bytes by name, but `int` ones as numbers."""
    data = path.read_bytes()
    place = 8

    def text():
        nonlocal place
        end = data.index(b"\0", place)
        found, place = data[place:end].decode(), end + 1
        return found

    attributes = {}
    while name := text():
        kind, size = text(), struct.unpack_from("<i", data, place)[0]
        value, place = data[place + 4:place + 4 + size], place + 4 + size
        attributes[name] = struct.unpack("<i", value)[0] if kind == "int" else value
    if data[:4] != MAGIC or attributes["compression"] != b"\0":
        raise ValueError(f"{path}: no uncompressed EXR")
    left, top, right, bottom = struct.unpack("<iiii", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    entries, types = attributes["channels"], {}
    while entries[:1] != b"\0":
        name, _, entries = entries.partition(b"\0")
        types[name.decode()] = struct.unpack_from("<i", entries)[0]
        entries = entries[16:]
    channels = {name: [] for name in types}
    place += 8 * height
    for _ in range(height):
        place += 8
        for name, kind in types.items():  # in the file's order, which is that of the names
            channels[name] += struct.unpack_from(f"<{width}{'Ief'[kind]}", data, place)
            place += width * (2 if kind == HALF else 4)
    return width, height, channels, attributes
