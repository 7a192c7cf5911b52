#!/usr/bin/env python3
"""Writes the runtime tables of two made-up textures beside this file, from the description of the format in
crates/synth/src/runtime_table.rs alone, and reads them again. Needs Python only.

layered.shgt has every layer; published.shgt has excitations and a moving average.
"""
import os
import struct
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
NONE = 0xFFFF  # no neighbor


def f32(x):
    """The nearest number of 32 bits, as in Rust."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def floats(*values):
    return struct.pack(f"<{len(values)}f", *values)


def section(letters, content):
    return letters.encode() + struct.pack("<I", len(content)) + content


def table(sections):
    body = b"".join(sections)
    length = 12 + len(body) + 4
    frame = b"SHGT" + struct.pack("<HHI", 1, 0, length) + body
    return frame + struct.pack("<I", zlib.crc32(frame))


def head(ma_order, turn, flags):
    return section("HEAD", floats(1000.0, 1.0, 1.0, turn) + struct.pack("<HHI", 2, ma_order, flags))


# The unit square of 1 m/s and 1 N: two triangles, with a level at full speed and force only.
LOWS = [0.5, 0.7, 0.9, 0.6]
LEVELS = [0.0, 0.0, 1.0, 0.0]
TRIANGLES = [
    ([0, 1, 2], [NONE, 1, NONE], [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0]),
    ([0, 2, 3], [NONE, NONE, 0], [0.0, -1.0, 1.0, 1.0, 0.0, 0.0]),
]


def nodes(level_factor, shift):
    pairs = [(f32(low), f32(f32(low) + f32(0.2))) for low in LOWS]
    return b"".join(
        floats(level * level_factor, f32(low + shift), f32(high + shift)) for level, (low, high) in zip(LEVELS, pairs)
    )


triangles = b"".join(
    struct.pack("<6H", *corners, *neighbors) + floats(*weights) + floats(*[1.0] * 6)
    for corners, neighbors, weights in TRIANGLES
)
relief = floats(1e-4, 1.0) + struct.pack("<I", 4) + floats(0.5, -0.5, 0.25, -0.25)
# Three patches of one octave of 4 x 4 samples.
height_map = struct.pack("<d", 0.01) + floats(1.0, 1.5) + struct.pack("<I", 4)
height_map += floats(*[f32(i * f32(1e-6)) for i in range(48)])
layered = table([
    head(0, 0.25, 1),
    section("NODE", nodes(1.0, 0.0)),
    section("TRIA", triangles),
    section("NODL", nodes(3.0, 1.0)),
    section("TRIL", triangles),
    section("RELI", relief),
    section("HMAP", height_map),
    section("FRIC", floats(0.4, 1.5, 0.02)),
    section("TAPS", floats(180.0, 90.0, 6.0)),
    section("NAME", "Square °".encode()),
    section("TERM", b"CC0-1.0"),
    section("ORIG", b"Made up."),
    section("MADE", b"nobody"),
])
excitations = b"".join(floats(float(i), 0.5 * i, f32(1.0 + f32(0.25 * i))) for i in range(4))
published = table([
    head(1, 0.0, 0),
    section("NODE", nodes(1.0, 0.0)),
    section("TRIA", triangles),
    section("EXCI", excitations),
])

for name, data in [("layered", layered), ("published", published)]:
    with open(f"{HERE}/{name}.shgt", "wb") as out:
        out.write(data)
    assert zlib.crc32(data[:-4]) == struct.unpack("<I", data[-4:])[0]
    print(name, len(data), "bytes")
