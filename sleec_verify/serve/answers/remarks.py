"""What else a user should know about a situation: windows, consequences, assumptions, and values that are not given."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import Comparison, Context, Ruleset, formulas_of, leaves, measures_of
from sleec_verify.entailment.answer import ConsequenceStep, Entailment, ScheduledResponse
from sleec_verify.report.entailment import undecided_text
from sleec_verify.report.explanation import due_of
from sleec_verify.report.schedule import when_text
from sleec_verify.wording.phrases import given, listed, quoted
from sleec_verify.wording.sentence import plural, sentence


def remarks(ruleset: Ruleset, context: Context, answer: Entailment) -> Iterator[str]:
    """A sentence for each remark, the most important ones first."""
    if answer.undecided is not None:
        yield undecided_text(answer.undecided)
    yield from _exclusion(ruleset, answer)
    for event, forbidding in answer.at_odds:
        clauses = listed(map(quoted, forbidding))
        yield plural(
            len(forbidding),
            "{event} occurs, but {clauses} forbids it",
            "{event} occurs, but {clauses} forbid it",
            event=quoted(event),
            clauses=clauses,
        )
    yield from _windows(answer.schedule)
    if answer.has_windows:
        yield sentence("This supposes that no response from before is pending. The findings look at all histories.")
    yield from _consequences(answer.chain)
    missing = [quoted(name) for name in answer.missing if name in _measures(ruleset, context)]
    if missing:
        yield plural(
            len(missing),
            "{names} is not given, so every comparison with it counts as false",
            "{names} are not given, so every comparison with them counts as false",
            names=listed(missing),
        )


def _exclusion(ruleset: Ruleset, answer: Entailment) -> Iterator[str]:
    excluding = answer.broken_assumptions or answer.unsettled
    if not excluding:
        return
    lines = sorted({ruleset.source.place(one.span).line for one in excluding})
    where = plural(len(lines), "line {lines}", "lines {lines}", lines=listed(map(str, lines)))
    if answer.broken_assumptions:
        yield sentence("An assumption excludes this situation ({where}), so the checks ignore it.", where=where)
    else:
        yield sentence("An assumption excludes this situation ({where}), unless more values are given.", where=where)
    if answer.possible:
        yield sentence("It becomes possible if {facts}.", facts=listed(given(dict(answer.possible))))


def _windows(schedule: Sequence[ScheduledResponse]) -> Iterator[str]:
    """When each response of the triggered rules is due that is not due at once."""
    for entry in schedule:
        if entry.start == entry.end == 0 or entry.after is not None:
            continue
        event, when = quoted(entry.event), when_text(entry)
        due = (
            sentence("{event} is forbidden {when}", event=event, when=when)
            if entry.negated
            else sentence("{event} is due {when}", event=event, when=when)
        )
        yield due if entry.instead_of is None else _instead(due, entry.instead_of, entry.overdue)


def _instead(due: str, other: str, overdue: bool) -> str:
    name = quoted(other.removeprefix("NOT "))
    if not overdue:
        return sentence("{due}, instead of {response}", due=due, response=name)
    if other.startswith("NOT "):
        return sentence("{due}, if {response} was done", due=due, response=name)
    return sentence("{due}, if {response} was not done in time", due=due, response=name)


def _consequences(chain: Sequence[ConsequenceStep]) -> Iterator[str]:
    """What follows once the robot does what is required, because a response is a trigger of other rules."""
    for step in chain:
        for because, done in step.clauses:
            yield sentence(
                "once the robot does {event}, rule {rule} applies: {due}",
                event=quoted(step.name),
                rule=quoted(because.rule),
                due=due_of(because),
            )
            yield from _consequences([one for one in done if one.leads_on or one.forbidden])
        if step.forbidden:
            yield sentence(
                "{event} is forbidden by {clauses}",
                event=quoted(step.name),
                clauses=listed(map(quoted, step.forbidden)),
            )


def _measures(ruleset: Ruleset, context: Context) -> set[str]:
    """The measures in the conditions of the rules that are triggered."""
    triggered = (rule for rule in ruleset.rules if rule.trigger in context.triggers)
    formulas = (formula for rule in triggered for formula in formulas_of(rule))
    compared = (leaf for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Comparison))
    return {name for leaf in compared for name in measures_of(leaf)}
