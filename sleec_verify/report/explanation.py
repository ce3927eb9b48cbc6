"""The output of `explain`: the clause of each rule that decides in a situation, the reasons, and the consequences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.entailment import caveats, once_done, scheduled, undecided_text
from sleec_verify.report.escape import as_text
from sleec_verify.report.full import finding_lines
from sleec_verify.wording.phrases import context_text, counted, exception, has_value, listed, quoted, value_words
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Formula, Rule, Ruleset, Span
    from sleec_verify.entailment.answer import ActiveClause, ConditionValue, Consequence, Entailment
    from sleec_verify.report.palette import Palette


@as_text
def render(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    """The situation, a paragraph for each triggered rule, and the result."""
    source = ruleset.source
    size = counted(len(ruleset.rules), "rule")
    yield sentence(
        "{situation}, according to the {size} in {path} (reading {reading}):",
        situation=context_text(context),
        size=size,
        path=source.path,
        reading=ruleset.reading,
    )
    yield ""
    decided = {because.rule: because for because in answer.because}
    triggered = [rule for rule in ruleset.rules if rule.trigger in context.triggers]
    for rule in triggered:
        if rule.label in decided:
            yield from decided_lines(ruleset, context, decided[rule.label], palette)
        else:
            assert rule.guard is not None, "a rule without a guard decides whenever it is triggered"
            yield from guarded_lines(ruleset, context, rule, rule.guard, palette)
    if not triggered:
        yield from (sentence("No rule is triggered."), "")
    for finding in answer.conflicts:
        yield from finding_lines(finding, source, palette)
        yield ""
    if answer.consequences:
        yield sentence("From the constraints alone (no rule says so, so the robot does not act on it):")
        yield from (_consequence(ruleset, consequence) for consequence in answer.consequences)
        yield ""
    yield from once_done(answer, palette)
    yield from scheduled(answer, context, palette)
    yield from caveats(ruleset, answer, palette)
    yield result_line(answer, palette)


def decided_lines(ruleset: Ruleset, context: Context, because: ActiveClause, palette: Palette) -> Iterator[str]:
    """The clause that decides in a rule, the reasons in a line each, and a blank line."""
    rule = ruleset.by_label[because.rule]
    head = sentence(
        "{trigger} triggers rule {rule}", trigger=quoted(rule.trigger), rule=palette("strong", quoted(rule.label))
    )
    if because.clause:
        hedge = list(rule.clauses())[because.clause]
        head = sentence(
            "{head}, and {exception} ({layer}) applies",
            head=head,
            exception=exception(hedge),
            layer=because.layer or "",
        )
    elif rule.hedges or rule.default.hedges:
        head = sentence("{head}, and no exception applies", head=head)
    yield sentence("{head}: {due} ({place}).", head=head, due=due_of(because), place=_at(ruleset, because.span))
    for position, decision in enumerate(because.decisions):
        truth = truth_text(ruleset, context, _spelled(decision.formula), decision)
        yield (
            sentence("    because {truth}", truth=truth) if position == 0 else sentence("    and {truth}", truth=truth)
        )
    yield ""


def due_of(because: ActiveClause) -> str:
    """What an active clause requires: ```Open` is required and `Wait` is forbidden``. An obligation with alternatives
    is required as a whole: ```Ring, or else Knock` is required``."""
    plain = tuple(words for words, choice in zip(because.in_words(), because.choices) if not choice)
    choices = [sentence("{names} is required", names=quoted(choice)) for choice in because.choices if choice]
    return listed([due_text(plain), *choices]) if plain or not choices else listed(choices)


def due_text(obligations: tuple[str, ...]) -> str:
    """```Open` is required and `Wait` is forbidden``"""
    due = [quoted(name) for name in obligations if not name.startswith("NOT ")]
    forbidden = [quoted(name[4:]) for name in obligations if name.startswith("NOT ")]
    parts = []
    if due:
        parts.append(plural(len(due), "{names} is required", "{names} are required", names=listed(due)))
    if forbidden:
        parts.append(plural(len(forbidden), "{names} is forbidden", "{names} are forbidden", names=listed(forbidden)))
    return listed(parts) if parts else sentence("nothing is required")


def truth_text(ruleset: Ruleset, context: Context, words: str, decision: ConditionValue) -> str:
    """The truth of a condition, with the values of its names and its line. `words` is the condition, as the reader sees
    it."""
    return sentence(
        "{formula} is {value}{values} ({place})",
        formula=words,
        value=value_words(decision.truth),
        values=_values(ruleset, context, decision.formula),
        place=_at(ruleset, decision.span),
    )


def guarded_lines(ruleset: Ruleset, context: Context, rule: Rule, guard: Formula, palette: Palette) -> Iterator[str]:
    """Why a rule whose guard is false requires nothing, and a blank line."""
    name = palette("strong", quoted(rule.label))
    yield sentence(
        "{trigger} triggers rule {rule}, but its condition is false: nothing is required.",
        trigger=quoted(rule.trigger),
        rule=name,
    )
    values = _values(ruleset, context, guard)
    yield sentence(
        "    because {guard} is false{values} ({place})",
        guard=_spelled(guard),
        values=values,
        place=_at(ruleset, guard.span),
    )
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
                worth[measure] = (
                    sentence("{name} is not given", name=quoted(measure))
                    if given is None
                    else has_value(measure, given)
                )
        else:
            worth[leaf.name] = has_value(leaf.name, context.conditions.get(leaf.name, False))
    return sentence(", as {facts}", facts=listed(worth.values())) if worth else ""


def _consequence(ruleset: Ruleset, consequence: Consequence) -> str:
    literal = consequence.literal
    name = quoted(literal.name)
    origins = [
        sentence(
            "{text} ({place})", text=quoted(ruleset.source.in_one_line(origin.span)), place=_at(ruleset, origin.span)
        )
        for origin in consequence.origins
    ]
    if literal.negated:
        return sentence("    {name} is forbidden by {origins}", name=name, origins=listed(origins))
    return sentence("    {name} is required by {origins}", name=name, origins=listed(origins))


def _at(ruleset: Ruleset, span: Span) -> str:
    return sentence("line {line}", line=ruleset.source.place(span).line)


def result_line(answer: Entailment, palette: Palette) -> str:
    """What all rules together require."""
    if answer.consistent is False:
        conflicts = counted(len(answer.conflicts), "conflict")
        where = palette("error", sentence("The rules contradict each other here"))
        return sentence("{where} ({conflicts}), so no obligations are listed.", where=where, conflicts=conflicts)
    forbidden = (
        sentence("; forbidden: {prohibitions}", prohibitions=joined(", ", answer.prohibitions))
        if answer.prohibitions
        else ""
    )
    required = [*answer.obligations, *(f"({one.words})" for one in answer.alternatives)]
    line = sentence(
        "{heading}: {obligations}{forbidden}",
        heading=palette("strong", sentence("Required")),
        obligations=joined(", ", required) if required else sentence("nothing"),
        forbidden=forbidden,
    )
    return line if answer.undecided is None else joined("; ", [line, undecided_text(answer.undecided)])
