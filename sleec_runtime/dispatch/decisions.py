"""What is due in a snapshot if triggers occur, and whether it conflicts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sleec_runtime.dispatch.decision_memo import TriggerOutcomes
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import ConflictInContext, UndeterminedDecision, UnknownTrigger
from sleec_runtime.evaluation.conflicts import find_conflict, missing_for
from sleec_runtime.evaluation.due import Due
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Decision, Outcome, Undetermined
from sleec_runtime.model import Obligation, Rule


def trigger_outcomes(snapshot: Snapshot, trigger: str) -> TriggerOutcomes:
    """The outcomes of the rules of `trigger` in this context. Raises UnknownTrigger."""
    try:
        number = snapshot.index.number_of.get(trigger)
    except TypeError:  # not hashable
        number = None
    if number is None:
        raise UnknownTrigger(trigger, snapshot.index.number_of)
    return snapshot.of_trigger(number)


def outcomes_of(snapshot: Snapshot, triggers: Sequence[str], others: Iterable[str] = ()) -> list[tuple[Rule, Outcome]]:
    """The outcome of each rule of `triggers`, in rule order, if `others` occur too. Raises UnknownTrigger."""
    index = snapshot.index
    occurring = frozenset(triggers).union(others)
    pairs = [
        (rule, outcome if rule.label not in index.trigger_dependent else snapshot.outcome(rule, occurring))
        for trigger in dict.fromkeys(triggers)
        for number in [index.number_of[trigger]]
        for rule, outcome in zip(index.by_trigger[number], snapshot.of_trigger(number).outcomes)
    ]
    return sorted(pairs, key=lambda pair: index.order[pair[0].label]) if len(triggers) > 1 else pairs


def decisions_of(snapshot: Snapshot, triggers: Sequence[str], others: Iterable[str] = ()) -> tuple[Decision, ...]:
    """The decisions of the rules of `triggers`, in rule order, if `others` occur too.

    O(rules of the triggers). Raises UnknownTrigger, and UndeterminedDecision in strict mode.
    """
    for trigger in triggers:
        trigger_outcomes(snapshot, trigger)
    outcomes = [outcome for _, outcome in outcomes_of(snapshot, triggers, others)]
    missing = [name for outcome in outcomes if isinstance(outcome, Undetermined) for name in outcome.missing]
    if missing:
        raise UndeterminedDecision(triggers, tuple(dict.fromkeys(missing)))
    return tuple(outcome for outcome in outcomes if isinstance(outcome, Decision))


def due_in(snapshot: Snapshot, triggers: Sequence[str]) -> Due:
    """What is due if `triggers` occur together in this context.

    O(rules of the triggers + constraints on their obligations). Raises UnknownTrigger, UndeterminedDecision (in strict
    mode), and ConflictInContext.
    """
    due = Due(decisions_of(snapshot, triggers))
    refuse_conflict(snapshot, triggers, due)
    return due


def refuse_conflict(
    snapshot: Snapshot, triggers: Sequence[str], due: Due, happening: tuple[Obligation, ...] = ()
) -> None:
    """Raises ConflictInContext if what is `due` and what is `happening` contradict each other in this context.

    Raises UndeterminedDecision if, in strict mode, this depends on unreported conditions.
    """
    index = snapshot.index
    literals = (*due.literals, *happening)
    constraints = index.constraints_on(literals)
    closed = Situation(snapshot.context(triggers), index.measures)
    cause = find_conflict(literals, constraints, closed)
    if cause is not None:
        # Imported here because it prints formulas, which few dispatches need.
        from sleec_runtime.evaluation.explanation import conflict_in_words

        raise ConflictInContext(conflict_in_words(cause, due.decisions), cause)
    if index.strict:
        open_world = Situation(closed.context, index.measures, absent=None)
        possible = find_conflict(literals, constraints, open_world)
        if possible is not None:
            raise UndeterminedDecision(triggers, missing_for(possible.constraints, open_world))
