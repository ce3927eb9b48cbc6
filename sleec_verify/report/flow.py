"""The steps that lead to a finding: events, conditions, the clauses that decide, and the finding."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Atom, Exclusive, formulas_of, leaves, measures_of
from sleec_verify.wording.phrases import clause_name, has_value, occurring, quoted
from sleec_verify.wording.sentence import joined, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Formula, Ruleset, Source, Span, Value
    from sleec_verify.results.finding import Finding
    from sleec_verify.results.strategy import Strategy
    from sleec_verify.results.timeline import Moment


class Step(NamedTuple):
    """One step: its place in a text, its description, the values that it adds, and the number of its moment."""

    source: Source
    span: Span
    words: str
    state: Mapping[str, Value]
    moment: int = 1


def steps(ruleset: Ruleset, finding: Finding) -> list[Step]:
    """The steps to a finding with a witness, or about code and a clause; the last step is the finding. Empty for other
    findings.

    O(size of the rules that the finding names), plus the constraints if only these contain a name.
    """
    source = finding.source or ruleset.source
    if finding.timeline is not None:
        before = [
            step
            for number, moment in enumerate(finding.timeline.moments, 1)
            for step in _of_moment(ruleset, finding, moment, number)
        ]
    elif finding.strategy is not None:
        before = list(_of_strategy(ruleset, finding, finding.strategy))
    elif finding.witness is not None:
        happening = _happening(ruleset, finding, finding.witness.triggers, finding.witness.conditions)
        before = [*happening, *_clauses(ruleset, finding)]
    elif finding.source is not None:
        before = list(_clauses(ruleset, finding))
    else:
        before = []
    if not before:
        return []
    last = before[-1].moment
    return [*before, Step(source, finding.span, finding.message, {}, last)]


def _of_moment(ruleset: Ruleset, finding: Finding, moment: Moment, number: int) -> Iterator[Step]:
    from sleec_verify.report.timeline import says
    from sleec_verify.wording.times import duration

    when = sentence("at first, ") if number == 1 else sentence("after {time}, ", time=duration(moment.time))
    told = {name: moment.conditions[name] for name in moment.telling}
    for step in _happening(ruleset, finding, moment.events, told):
        yield step._replace(words=joined("", [when, step.words]), moment=number)
    for due in moment.due:
        span = list(ruleset.by_label[due.rule].clauses())[due.clause].span
        if due.overdue:
            words = sentence(
                "after {time}, instead of {response}, {demand}",
                time=duration(due.start),
                response=quoted(due.instead_of or ""),
                demand=says(due),
            )
            yield Step(ruleset.source, span, words, {}, number)
        elif due.instead_of is None:
            yield Step(ruleset.source, span, joined("", [when, says(due)]), {}, number)


def _of_strategy(ruleset: Ruleset, finding: Finding, strategy: Strategy, number: int = 1) -> Iterator[Step]:
    """The acts of the environment, along the first branch of each."""
    from sleec_verify.wording.times import duration

    act = strategy.act
    when = sentence("at first, ") if number == 1 else sentence("after {time}, ", time=duration(act.time))
    for step in _happening(ruleset, finding, act.events, act.conditions):
        yield step._replace(words=joined("", [when, step.words]), moment=number)
    for branch in strategy.branches[:1]:
        yield from _of_strategy(ruleset, finding, branch.then, number + 1)


def _happening(
    ruleset: Ruleset, finding: Finding, triggers: Iterable[str], conditions: Mapping[str, Value]
) -> Iterator[Step]:
    """The events and conditions, each at its first place in the rules of the finding."""
    rules = [ruleset.by_label[label] for label in finding.rules if label in ruleset.by_label]
    told = _places(formula for rule in rules for formula in formulas_of(rule))
    for rule in rules:
        told.setdefault(rule.trigger, rule.trigger_span)
    if not told.keys() >= {*triggers, *conditions}:
        # Constraints and assumptions contain the other names.
        told = {**_places(c.formula for c in ruleset.constraints if not isinstance(c, Exclusive)), **told}
    for trigger in triggers:
        yield _step(ruleset, finding, told.get(trigger), occurring([trigger]), {trigger: True})
    for name, value in conditions.items():
        yield _step(
            ruleset,
            finding,
            told.get(name),
            has_value(name, value),
            {name: value},
        )


def _step(ruleset: Ruleset, finding: Finding, span: Span | None, words: str, state: Mapping[str, Value]) -> Step:
    """A step at `span` of the rules; without `span`, at the finding."""
    if span is None:
        return Step(finding.source or ruleset.source, finding.span, words, state)
    return Step(ruleset.source, span, words, state)


def _places(formulas: Iterable[Formula]) -> dict[str, Span]:
    """The first place of each name."""
    places: dict[str, Span] = {}
    for formula in formulas:
        for leaf in leaves(formula):
            for name in (leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf):
                places.setdefault(name, leaf.span)
    return places


def _clauses(ruleset: Ruleset, finding: Finding) -> Iterator[Step]:
    from sleec_runtime.model import obligation_text

    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        clause = list(rule.clauses())[number]
        due = (
            quoted(" AND ".join(map(obligation_text, clause.obligations)))
            if clause.obligations
            else sentence("nothing")
        )
        yield Step(ruleset.source, clause.span, joined(": ", [clause_name(rule, number), due]), {})
