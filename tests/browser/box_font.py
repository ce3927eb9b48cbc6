"""A font in which every character is the same box, so that a page has the same layout on every machine.

The method is that of Ahem, the test font of web-platform-tests. A face has its own size of the box, so that a change of
the font is seen.
"""

from __future__ import annotations

import struct
from base64 import b64encode

_EM, _ASCENT, _DESCENT = 1000, 800, 200
_LAST = 0x10FFFF
_EMPTY, _BOX = 0, 1


def faces(family: str, advance: int) -> str:
    """The CSS of a font in four styles. `advance` is the width of a character in thousandths of the font size."""
    styles = (("normal", 400, 450), ("normal", 700, 700), ("italic", 400, 300), ("italic", 700, 550))
    return "".join(
        f'@font-face {{ font-family: "{family}"; font-style: {style}; font-weight: {weight}; '
        f"src: url(data:font/ttf;base64,{b64encode(_font(advance, height)).decode()}); }}\n"
        for style, weight, height in styles
    )


def _font(advance: int, height: int) -> bytes:
    """A TrueType font with two glyphs: nothing for spaces and control characters, and a box for all others."""
    box = struct.pack(">5h2H", 1, 50, 0, advance - 50, height, 3, 0) + bytes([1, 1, 1, 1])
    box += struct.pack(">4h", 50, 0, advance - 100, 0) + struct.pack(">4h", 0, height, 0, -height)
    tables = {
        b"OS/2": struct.pack(
            ">HhHHH10hh10s4L4sHHH3hHH2L",
            *(3, advance, 400, 5, 0, *([0] * 10), 0, bytes(10), 1, 0, 0, 0, b"test", 64, 0x20, 0xFFFF),
            *(_ASCENT, -_DESCENT, 0, _ASCENT, _DESCENT, 1, 0),
        )
        + struct.pack(">hhHHH", 450, 700, 0, 0x20, 1),
        b"cmap": _characters(),
        b"glyf": box,
        b"head": struct.pack(
            ">4L2H2q4hHHhhh", 0x10000, 0x10000, 0, 0x5F0F3CF5, 3, _EM, 0, 0, *(0, 0, advance, height, 0, 8, 2, 1, 0)
        ),
        b"hhea": struct.pack(">L3hH11hH", 0x10000, _ASCENT, -_DESCENT, 0, advance, *([0] * 3), 1, *([0] * 7), 2),
        b"hmtx": struct.pack(">HhHh", advance, 0, advance, 50),
        b"loca": struct.pack(">3L", 0, 0, len(box)),
        b"maxp": struct.pack(">L14H", 0x10000, 2, 4, 1, *([0] * 2), 2, *([0] * 8)),
        b"name": struct.pack(">3H", 0, 0, 6),
        b"post": struct.pack(">2L2h5L", 0x30000, 0, -100, 50, 0, 0, 0, 0, 0),
    }
    offset = 12 + 16 * len(tables)
    directory, content = struct.pack(">L4H", 0x10000, len(tables), 128, 3, 16 * len(tables) - 128), b""
    for tag, data in sorted(tables.items()):
        padded = data + bytes(-len(data) % 4)
        checksum = sum(struct.unpack(f">{len(padded) // 4}L", padded)) & 0xFFFFFFFF
        directory += struct.pack(">4s3L", tag, checksum, offset + len(content), len(data))
        content += padded
    return directory + content


def _characters() -> bytes:
    """The table of characters in format 13: one glyph for a whole range."""
    ranges = ((0, 0x20, _EMPTY), (0x21, 0x9F, _BOX), (0xA0, 0xA0, _EMPTY), (0xA1, _LAST, _BOX))
    groups = b"".join(struct.pack(">3L", *one) for one in ranges)
    table = struct.pack(">2H3L", 13, 0, 16 + len(groups), 0, len(ranges)) + groups
    return struct.pack(">2H2HL", 0, 1, 3, 10, 12) + table
