"""The output of `explain`: the clause of each rule that decides in a situation, the reasons, and the consequences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.entailment import caveats, once_done, scheduled
from sleec_verify.report.escape import as_text
from sleec_verify.report.full import finding_lines
from sleec_verify.results.phrases import context_text, counted, exception, listed, quoted, value_text

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Formula, Rule, Ruleset, Span
    from sleec_verify.entailment.answer import ActiveClause, ConditionValue, Consequence, Entailment
    from sleec_verify.report.palette import Palette


@as_text
def render(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    """The situation, a paragraph for each triggered rule, and the result."""
    source = ruleset.source
    size = counted(len(ruleset.rules), "rule")
    yield f"{context_text(context)}, according to the {size} in {source.path} (reading {ruleset.reading}):"
    yield ""
    decided = {because.rule: because for because in answer.because}
    triggered = [rule for rule in ruleset.rules if rule.trigger in context.triggers]
    for rule in triggered:
        if rule.label in decided:
            yield from _decided(ruleset, context, decided[rule.label], palette)
        else:
            assert rule.guard is not None, "a rule without a guard decides whenever it is triggered"
            yield from _guarded(ruleset, context, rule, rule.guard, palette)
    if not triggered:
        yield from ("No rule is triggered.", "")
    for finding in answer.conflicts:
        yield from finding_lines(finding, source, palette)
        yield ""
    if answer.consequences:
        yield "From the constraints alone (no rule says so, so the robot does not act on it):"
        yield from (_consequence(ruleset, consequence) for consequence in answer.consequences)
        yield ""
    yield from once_done(answer, palette)
    yield from scheduled(answer, context, palette)
    yield from caveats(ruleset, answer, palette)
    yield _in_all(answer, palette)


def _decided(ruleset: Ruleset, context: Context, because: ActiveClause, palette: Palette) -> Iterator[str]:
    rule = ruleset.by_label[because.rule]
    head = f"{quoted(rule.trigger)} triggers rule {palette('strong', quoted(rule.label))}"
    if because.clause:
        hedge = list(rule.clauses())[because.clause]
        head = f"{head}, and {exception(hedge)} ({because.layer}) applies"
    elif rule.hedges or rule.default.hedges:
        head = f"{head}, and no exception applies"
    yield f"{head}: {_due(because.in_words())} ({_at(ruleset, because.span)})."
    for position, decision in enumerate(because.decisions):
        yield f"    {'because' if position == 0 else 'and'} {_truth(ruleset, context, decision)}"
    yield ""


def _due(obligations: tuple[str, ...]) -> str:
    due = [quoted(name) for name in obligations if not name.startswith("NOT ")]
    forbidden = [quoted(name[4:]) for name in obligations if name.startswith("NOT ")]
    parts = []
    if due:
        parts.append(f"{listed(due)} {'is' if len(due) == 1 else 'are'} required")
    if forbidden:
        parts.append(f"{listed(forbidden)} {'is' if len(forbidden) == 1 else 'are'} forbidden")
    return " and ".join(parts) or "nothing is required"


def _truth(ruleset: Ruleset, context: Context, decision: ConditionValue) -> str:
    value = "true" if decision.truth else "false"
    return (
        f"{_spelled(decision.formula)} is {value}"
        f"{_values(ruleset, context, decision.formula)} ({_at(ruleset, decision.span)})"
    )


def _guarded(ruleset: Ruleset, context: Context, rule: Rule, guard: Formula, palette: Palette) -> Iterator[str]:
    name = palette("strong", quoted(rule.label))
    yield f"{quoted(rule.trigger)} triggers rule {name}, but its condition is false: nothing is required."
    values = _values(ruleset, context, guard)
    yield f"    because {_spelled(guard)} is false{values} ({_at(ruleset, guard.span)})"
    yield ""


def _spelled(formula: Formula) -> str:
    from sleec_runtime.language import print_formula

    return quoted(print_formula(formula))


def _values(ruleset: Ruleset, context: Context, formula: Formula) -> str:
    """The values of the names in a formula; empty for a single condition."""
    from sleec_runtime.model import Atom, Comparison, leaves, measures_of

    if isinstance(formula, Atom):
        return ""
    worth: dict[str, str] = {}
    for leaf in leaves(formula):
        if isinstance(leaf, Comparison):
            for measure in measures_of(leaf):
                given = context.conditions.get(measure)
                worth[measure] = "is not given" if given is None else f"is {value_text(given)}"
        else:
            worth[leaf.name] = f"is {value_text(context.conditions.get(leaf.name, False))}"
    said = [f"{quoted(name)} {what}" for name, what in worth.items()]
    return f", as {listed(said)}" if said else ""


def _consequence(ruleset: Ruleset, consequence: Consequence) -> str:
    literal = consequence.literal
    role = "forbidden" if literal.negated else "required"
    origins = [f"{quoted(_text(ruleset, origin.span))} ({_at(ruleset, origin.span)})" for origin in consequence.origins]
    return f"    {quoted(literal.name)} is {role} by {listed(origins)}"


def _text(ruleset: Ruleset, span: Span) -> str:
    return " ".join(ruleset.source.text[span.start : span.end].split())


def _at(ruleset: Ruleset, span: Span) -> str:
    return f"line {ruleset.source.place(span).line}"


def _in_all(answer: Entailment, palette: Palette) -> str:
    if not answer.consistent:
        conflicts = counted(len(answer.conflicts), "conflict")
        where = palette("error", "The rules contradict each other here")
        return f"{where} ({conflicts}), so no obligations are listed."
    forbidden = f"; forbidden: {', '.join(answer.prohibitions)}" if answer.prohibitions else ""
    return f"{palette('strong', 'Required')}: {', '.join(answer.obligations) or 'nothing'}{forbidden}"
