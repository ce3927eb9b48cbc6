"""Executions in a course: from the start of the code of an obligation to its end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sleec_verify.conformance.scenarios.course import Course, Happening


@dataclass(frozen=True)
class Execution:
    """One execution: its start, and its end if there is one, each with its place in the course."""

    start: Happening
    place: int
    end: Happening | None = None
    end_place: int | None = None

    @property
    def name(self) -> str:
        return self.start.names[0]

    @property
    def done_at(self) -> int | None:
        """The time at which the obligation is completed."""
        return self.end.at if self.end is not None and self.end.kind == "done" else None

    def runs_at(self, place: int) -> bool:
        """Whether it has begun and not ended at a place of the course."""
        return self.place <= place and (self.end_place is None or self.end_place > place)


def executions(course: Course) -> Iterator[Execution]:
    """The executions of a course, by their starts. One completion ends all executions of its name that are under way;
    so does an exception for the last of them."""
    under_way: dict[str, list[tuple[int, Happening]]] = {}
    found: list[Execution] = []
    for place, one in enumerate(course.happenings):
        name = one.names[0]
        if one.kind == "starts":
            under_way.setdefault(name, []).append((place, one))
        elif one.kind == "fails" and under_way.get(name):
            begin, start = under_way[name].pop()
            found.append(Execution(start, begin, one, place))
        elif one.kind == "done":
            found += [Execution(start, begin, one, place) for begin, start in under_way.pop(name, ())]
    found += [Execution(start, begin) for starts in under_way.values() for begin, start in starts]
    return iter(sorted(found, key=lambda execution: execution.place))
