"""One question for each of several items, so that an undecided one does not hide the others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, TypeVar

from sleec_verify.encoding.budget import Undecided, begin, share
from sleec_verify.query.rule_shape import shape_at
from sleec_verify.results.finding import Finding
from sleec_verify.traces.partition import partition_of
from sleec_verify.wording.phrases import first_of, quoted
from sleec_verify.wording.sentence import joined, sentence

if TYPE_CHECKING:
    from sleec_verify.query.ruleset_index import RulesetIndex
    from sleec_verify.traces.index import TraceIndex

_Asked = TypeVar("_Asked")


def ask_each(asked: Iterable[tuple[str, _Asked]], question: Callable[[_Asked], Iterable[Finding]]) -> Iterator[Finding]:
    """The findings of `question` for each item of `asked`, which is given with its name for messages.

    Each question but the last spends at most half of the remaining budget, so that hard questions leave some for the
    others. Findings come as soon as they are found, within the share of their question: close the iterator to end
    early. Raises Undecided after all questions, with the names of the undecided items.
    """
    why: dict[str, list[str]] = {}
    for (name, one), is_last in _with_last(asked):
        try:
            begin()
            with share(1 if is_last else 1 / 2):
                yield from question(one)
        except Undecided as error:
            why.setdefault(error.message, []).append(name)
    if why:
        raise Undecided(
            joined(
                "; ",
                (
                    sentence("{rules}: {why}", rules=first_of([*dict.fromkeys(names)]), why=reason)
                    for reason, names in why.items()
                ),
            )
        )


def ask_each_shape(
    index: RulesetIndex,
    question: Callable[[int], Iterable[Finding]],
    alone: Callable[[int], bool] = lambda position: True,
) -> Iterator[Finding]:
    """The findings of `question` for each rule, by position. A rule with the same shape as a rule without findings is
    skipped. `alone` says whether the answer depends only on the rule itself."""
    nothing_found: set[object] = set()

    def shape_of(position: int) -> object:
        shape = shape_at(index, position) if alone(position) else None
        return None if shape is None else shape.key

    def of(position: int) -> Iterator[Finding]:
        found = False
        for finding in question(position):
            found = True
            yield finding
        if not found:
            nothing_found.add(shape_of(position))

    def asked() -> Iterator[tuple[str, int]]:
        for label, position in index.labelled():
            key = shape_of(position)
            if key is None or key not in nothing_found:
                yield quoted(label), position

    return ask_each(asked(), of)


def ask_both_parts(
    index: RulesetIndex,
    situations: Callable[[RulesetIndex], Iterable[Finding]],
    traces: Callable[[TraceIndex], Iterable[Finding]],
) -> Iterator[Finding]:
    """The findings about both parts of a ruleset. Raises Undecided, after all findings, if one of the parts does."""
    parts = partition_of(index)
    why: list[str] = []
    try:
        yield from situations(parts.situations)
    except Undecided as error:
        why.append(error.message)
    if parts.traces is not None:
        try:
            yield from traces(parts.traces)
        except Undecided as error:
            why.append(error.message)
    if why:
        raise Undecided(joined("; ", why))


def _with_last(asked: Iterable[_Asked]) -> Iterator[tuple[_Asked, bool]]:
    """Each item, and whether it is the last one."""
    iterator = iter(asked)
    for one in iterator:
        for following in iterator:
            yield one, False
            one = following
        yield one, True
