"""Sizes on the command line: a number of bytes, with or without a unit."""

from __future__ import annotations

import re

_UNITS = {
    "": 1,
    "b": 1,
    "kb": 1000,
    "mb": 1000**2,
    "gb": 1000**3,
    "kib": 1024,
    "mib": 1024**2,
    "gib": 1024**3,
}
_SIZE = re.compile(r"([0-9]{1,15}) ?([A-Za-z]*)")
_MOST = 2**50


def size_in_bytes(written: str) -> int:
    """The number of bytes of ``16MiB``, ``200kB`` or a plain number.

    Raises:
        ValueError: it is not a size, or not between 1 byte and 1 PiB.
    """
    match = _SIZE.fullmatch(written)
    unit = match and _UNITS.get(match[2].lower())
    if match is None or unit is None:
        raise ValueError(f"{written!r} is not a size; write a number of bytes, for example 200kB, 16MiB or 1000000")
    size = int(match[1]) * unit
    if not 0 < size <= _MOST:
        raise ValueError(f"{written!r} is not between 1 byte and 1 PiB")
    return size
