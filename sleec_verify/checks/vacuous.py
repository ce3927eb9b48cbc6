"""Rules that can be triggered, but only in situations that conflict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from functools import partial
from typing import TYPE_CHECKING

from sleec_runtime.model import Atom, Never, Rule
from sleec_verify.checks.base import Check, FindingKind, literals_of
from sleec_verify.checks.dead import with_facts
from sleec_verify.checks.questions import ask_both_parts, ask_each
from sleec_verify.checks.relevant_rules import in_words, rules_in
from sleec_verify.encoding.budget import as_far_as_decided
from sleec_verify.encoding.equation import conjunction
from sleec_verify.query.cone import rules_active_with
from sleec_verify.query.inconsistent_sets import InconsistentSets
from sleec_verify.query.names import names_in, names_of_rule
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.traces.index import TraceIndex


def _vacuous(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each rule that is triggered only in situations that conflict."""
    yield from ask_both_parts(index, _in_situations, partial(_in_traces, index))


def _in_situations(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly if the rule is vacuous: it is triggered, and the obligations are consistent. A model is a
    situation in which the rule can be followed."""
    if not inconsistent_sets_of(index):
        return
    with ExitStack() as stack:
        kept: dict[str, _Kept | None] = {}

        def of(position: int) -> Iterator[Finding]:
            rule = index.rules[position]
            if rule.trigger not in kept:
                stack.close()
                kept.clear()
                kept[rule.trigger] = _Kept.of(index, rule.trigger, stack)
            peace = kept[rule.trigger]
            others = None if peace is None else peace.always_met(position)
            if others is not None:
                yield _finding(index, position, others)

        yield from ask_each(_by_trigger(index), of)


def _in_traces(index: RulesetIndex, traces: TraceIndex) -> Iterator[Finding]:
    """A finding for each rule that no trace triggers, although its condition can hold."""
    from sleec_verify.traces.questions import find_trigger

    def of(rule: Rule) -> Iterator[Finding]:
        answer = find_trigger(traces, rule)
        if answer.trace is not None or not _can_apply(index, traces, rule):
            return
        matter = [key for key in answer.matter if key != rule.label]
        others = in_words(traces, matter)
        yield VACUOUS_CONFLICT.finding(
            sentence("rule {rule} can be triggered, but never without a conflict", rule=quoted(rule.label)),
            rule.heading_span,
            rules=(rule.label, *rules_in(traces, matter)),
            note=sentence("it always conflicts with {rules}", rules=listed(others)) if others else _alone(traces, rule),
            help=sentence(
                "whenever it is triggered, some rule or relation must be broken: correct it, or what it conflicts with"
            ),
        )

    yield from ask_each(((quoted(rule.label), rule) for rule in traces.rules), of)


def _alone(traces: TraceIndex, rule: Rule) -> str:
    """Why a rule that conflicts with no other rule cannot be followed, in words."""
    from sleec_verify.traces.model import TraceModel

    model = TraceModel(traces.part([rule], ()))
    contradicts = False
    with as_far_as_decided():
        contradicts = not model.ask(model.instants[model.instant(model.formula.true)].event(rule.trigger))
    return sentence("it contradicts itself") if contradicts else sentence("its consequences never end")


def _can_apply(index: RulesetIndex, traces: TraceIndex, rule: Rule) -> bool:
    """Whether the rule applies somewhere, if only the relations count. Otherwise it is a dead rule."""
    from sleec_verify.traces.questions import find_application

    with Question(with_facts(index)) as question:
        if not question.ask(question.encoder.any_of(question.guards_of(rule))):
            return False
    return find_application(traces, rule).trace is not None


def _by_trigger(index: RulesetIndex) -> Iterator[tuple[str, int]]:
    """The quoted label of each rule, with its position, grouped by trigger."""
    return ((quoted(index.rules[position].label), position) for same in index.by_trigger.values() for position in same)


def _finding(index: RulesetIndex, position: int, others: Sequence[int]) -> Finding:
    rule = index.rules[position]
    labels = [index.rules[other].label for other in others]
    triggered = [Atom("trigger", rule.trigger), *([] if rule.guard is None else [rule.guard])]
    return VACUOUS_CONFLICT.finding(
        sentence("rule {rule} can be triggered, but never without a conflict", rule=quoted(rule.label)),
        rule.heading_span,
        rules=(rule.label, *labels),
        # There is a conflict for all values of the measures, but each needs a value.
        witness=smallest_situation(index, conjunction(triggered), _measures(index, [position, *others])),
        note=sentence("it always conflicts with {rules}", rules=listed(map(quoted, labels))) if labels else None,
        help=sentence("see the findings of the check `conflict`: whenever the rule is triggered, one of them applies"),
    )


def _measures(index: RulesetIndex, group: Sequence[int]) -> set[str]:
    """The measures that decide these rules, or the constraints."""
    named = {name for position in group for _, name in names_of_rule(index.rules[position])}
    named.update(n for c in index.constraints if isinstance(c, Never) for _, n in names_in(c.formula))
    return named & set(index.ruleset.measures)


class _Kept:
    """The formula "the obligations are consistent" over the rules that may be active with one trigger."""

    def __init__(self, index: RulesetIndex, trigger: str, group: Sequence[int], clashes: InconsistentSets) -> None:
        self._index = index
        self._question = Question(index)
        encoder = self._question.encoder
        # Each rule has a switch, so that the solver's core names the relevant rules.
        self._switches = {position: encoder.fresh() for position in group}
        pairs = []
        for position, switch in self._switches.items():
            guards = self._question.guards(position)
            pairs += [(c, encoder.both(guard, switch)) for c, guard in zip(index.clauses[position], guards)]
        due = encoder.due(pairs)
        for exclusion in clashes.exclusions:
            self._question.require(-encoder.at_least_two([due[literal] for literal in exclusion.literals]))
        for clash in clashes.listed:
            self._question.require(
                *(-due[literal] for literal in sorted(clash.literals, key=str)), -encoder.literal(clash.situation)
            )
        self._triggered = {
            position: encoder.any_of(self._question.guards(position)) for position in index.by_trigger[trigger]
        }

    @classmethod
    def of(cls, index: RulesetIndex, trigger: str, stack: ExitStack) -> _Kept | None:
        """None if the rules of this trigger, and those that may be active with them, have no inconsistent set.
        Otherwise `stack` closes the formula."""
        group = rules_active_with(index, trigger, satisfying=True)
        clashes = inconsistent_sets_of(index).among(
            {literal for other in group for literal in literals_of(index.clauses[other])}
        )
        if not clashes:
            return None
        part = clashes.literals()
        matter = [other for other in group if not part.isdisjoint(literals_of(index.clauses[other]))]
        found = cls(index, trigger, matter, clashes)
        stack.enter_context(found._question)
        return found

    def always_met(self, position: int) -> list[int] | None:
        """A minimal set of other rules with which the rule at `position` conflicts whenever it is triggered. None
        if it can be followed in some situation, or is never triggered."""
        question = self._question
        given = [self._triggered[position]]
        given += [switch for other, switch in self._switches.items() if other == position]
        others = {switch: other for other, switch in self._switches.items() if other != position}
        if question.ask(*given, *others):
            return None
        needed = question.core_among(others)
        for switch in needed:
            without = [one for one in needed if one != switch]
            if len(without) < len(needed) and not question.ask(*given, *without):
                needed = question.core_among(without)
        with Question(self._index) as find_trigger:
            triggered = find_trigger.encoder.any_of(find_trigger.guards(position))
            return [others[switch] for switch in needed] if find_trigger.ask(triggered) else None


VACUOUS_CONFLICT = Check(
    "vacuous-conflict",
    "Can every rule be followed in some situation?",
    (
        FindingKind(
            "SLEEC102",
            "error",
            "a rule that always leads to a conflict",
            "The rule can be triggered, but in every such situation the rules contradict each other. So nobody can "
            "ever follow it.",
            "Look at the conflicts that are reported with it: whenever the rule is triggered, one of them applies. "
            "Narrow the condition of this rule or of the other, or add an exception for the case in which both apply.",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nRULE shut\nWHEN UserAsks THEN NOT OpenDoor\n",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nUNLESS NightTime IN WHICH CASE NOT OpenDoor\n",
        ),
    ),
    _vacuous,
)
