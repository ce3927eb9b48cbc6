"""Names that are two things at once, although one excludes the other."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple

from sleec_runtime.model import Measure, Span

_EXCLUSIVE_KINDS = (
    ("condition", "measure"),
    ("trigger", "measure"),
    ("obligation", "measure"),
    ("condition", "constant"),
    ("trigger", "constant"),
    ("obligation", "constant"),
    ("condition", "obligation"),
    ("condition", "trigger"),
    ("condition", "event"),
    ("event", "measure"),
    ("event", "constant"),
)
"""A trigger may be an obligation of another rule: the event then occurs because the rule requires it."""


class Uses(NamedTuple):
    """The names of one kind."""

    spans: Mapping[str, Span]
    """Where each is declared or, if it is not, used first."""

    declared: Collection[str]


class NameConflict(NamedTuple):
    """A name of two kinds: what it is at `span`, and what it is at `other`."""

    name: str
    here: str
    span: Span
    there: str
    other: Span
    hint: str


def conflicts(
    uses: Mapping[str, Uses], events: Collection[str], measures: Mapping[str, Measure]
) -> Iterator[NameConflict]:
    """Each name with two exclusive kinds, once: at the use against a declaration, or else at the later of two uses."""
    reported: set[str] = set()
    for one, other in _EXCLUSIVE_KINDS:
        for name in uses[one].spans.keys() & uses[other].spans.keys():
            if name in reported:
                continue
            reported.add(name)
            kinds = [one, other]
            declared = [name in uses[kind].declared for kind in kinds]
            spans = [uses[kind].spans[name] for kind in kinds]
            at_first = spans[0] > spans[1] if declared[0] == declared[1] else declared[1]
            here, there = (0, 1) if at_first else (1, 0)
            roles = [_role(kind, is_declared, name in events) for kind, is_declared in zip(kinds, declared)]
            hint = _hint(name, {one, other}, measures)
            yield NameConflict(name, roles[here], spans[here], roles[there], spans[there], hint)


def _role(kind: str, is_declared: bool, is_event: bool) -> str:
    if is_declared and is_event and kind in ("trigger", "obligation"):
        return "declared as an event"
    article = "an" if kind in ("obligation", "event") else "a"
    if is_declared:
        return f"declared as {article} {kind}"
    return "compared as a measure" if kind == "measure" else f"used as {article} {kind}"


def _hint(name: str, kinds: set[str], measures: Mapping[str, Measure]) -> str:
    if kinds == {"condition", "measure"}:
        measure = measures.get(name)
        example = f">= {measure.values[-1]}" if measure and measure.values else "> 0"
        return f"compare a measure wherever you use it, for example: {name} {example}"
    if kinds == {"condition", "obligation"}:
        return "a condition describes the situation, an obligation what the robot must do: use two different names"
    if kinds in ({"condition", "trigger"}, {"condition", "event"}):
        return "a trigger is an event, a condition describes the situation at that time: use two different names"
    return "use two different names"
