"""Marks that are too close to each other are drawn as one. So a picture of many events stays readable."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass
class Group(Generic[T]):
    """Members that are drawn as one, from `left` to `right`."""

    left: float
    right: float
    members: list[T]


def marks(places: Iterable[tuple[float, T]], distance: float) -> list[Group[T]]:
    """Groups of marks that are nearer than `distance` to the first one of their group. `places` are in order."""
    found: list[Group[T]] = []
    for x, member in places:
        if found and x - found[-1].left < distance:
            found[-1].right = x
            found[-1].members.append(member)
        else:
            found.append(Group(x, x, [member]))
    return found


def bars(intervals: Iterable[tuple[float, float, T]], distance: float) -> list[Group[T]]:
    """Groups of bars that overlap, or are nearer than `distance` to each other."""
    found: list[Group[T]] = []
    for left, right, member in sorted(intervals, key=lambda interval: interval[:2]):
        if found and left - found[-1].right < distance:
            found[-1].right = max(found[-1].right, right)
            found[-1].members.append(member)
        else:
            found.append(Group(left, right, [member]))
    return found


def lanes(groups: Sequence[Group[T]], most: int) -> list[int]:
    """For each bar, the first lane in which it is free from the bars before it. If there is none below `most`, the last
    one is shared."""
    ends: list[float] = []
    found = []
    for group in groups:
        lane = next((lane for lane, end in enumerate(ends) if end < group.left), len(ends))
        lane = min(lane, most - 1)
        if lane == len(ends):
            ends.append(group.right)
        ends[lane] = max(ends[lane], group.right)
        found.append(lane)
    return found
