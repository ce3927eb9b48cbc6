"""Reading TOML: the configuration and files of cases."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Any

from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import read_file

if TYPE_CHECKING:
    from pathlib import Path


def read_toml(
    path: str | Path, shown: str, error: type[SleecError], parse_float: Callable[[str], object] = float
) -> dict[str, Any]:
    """The table in a file, which messages call `shown`. `parse_float` converts numbers with a point or an exponent.

    Raises:
        error: the file cannot be read, or is not TOML.
    """
    try:
        return parse_toml(read_file(path), shown, error, parse_float)
    except FileNotFoundError:
        raise error(f"file {shown} does not exist", "check its name and folder") from None
    except OSError as problem:
        raise error(f"{shown} cannot be read: {problem.strerror}") from None


def parse_toml(
    data: bytes, shown: str, error: type[SleecError], parse_float: Callable[[str], object] = float
) -> dict[str, Any]:
    """The same as `read_toml`, for bytes."""
    toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    try:
        table: dict[str, Any] = toml.loads(data.decode("utf-8-sig"), parse_float=parse_float)
        _check_integers(table)
    except UnicodeDecodeError:
        raise error(f"{shown} is not UTF-8", "save it as UTF-8") from None
    except RecursionError:
        raise error(f"{shown} is nested too deeply") from None
    except ValueError as problem:
        raise error(f"{shown} is not TOML: {problem}") from None
    return table


def _check_integers(table: object) -> None:
    """Raises `ValueError` for integers of more than 64 bits. TOML does not have them, and Python may not be able to
    print them."""
    values = [table]
    while values:
        value = values.pop()
        if isinstance(value, dict):
            values += value.values()
        elif isinstance(value, list):
            values += value
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            raise ValueError("an integer has more than 64 bits")
