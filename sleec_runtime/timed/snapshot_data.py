"""Checks of the plain data of a snapshot. A malformed part raises SnapshotRefused with its place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NoReturn

from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.support.messages import represent
from sleec_runtime.timed.clock import FURTHEST, Time
from sleec_runtime.timed.plain_data import number_from_plain


def refuse_malformed(where: str, value: object, expected: str) -> NoReturn:
    """Raises SnapshotRefused for a malformed `value` at the place `where`."""
    raise SnapshotRefused(
        f"the snapshot is malformed: {where} is {represent(value)}, and should be {expected}",
        "restore what pending_snapshot() returned, unchanged",
    )


def record(data: object, where: str, *keys: str) -> dict[str, Any]:
    """`data`, if it is a dict with exactly these keys."""
    if type(data) is not dict or data.keys() != set(keys):
        refuse_malformed(where, data, f"a dict with {', '.join(keys)}")
    return data


def items(whole: dict[str, Any], key: str) -> Iterator[tuple[str, object]]:
    """The items of the list at `key`, each with its place."""
    if type(whole[key]) is not list:
        refuse_malformed(key, whole[key], "a list")
    return ((f"{key}[{number}]", one) for number, one in enumerate(whole[key]))


def chosen(items: Sequence[Any], index: object, where: str) -> Any:
    """The item at `index`, if there is one."""
    if type(index) is not int or not 0 <= index < len(items):
        refuse_malformed(where, index, f"a whole number from 0 to {len(items) - 1}")
    return items[index]


def number_at(data: object, where: str) -> Time:
    """The number that `data` stands for, within the bounds of times."""
    number = number_from_plain(data)
    if number is None or not -FURTHEST <= number <= FURTHEST:
        refuse_malformed(where, data, f"a number from -{FURTHEST:,} to {FURTHEST:,}")
    return number
