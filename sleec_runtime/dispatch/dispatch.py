"""From a trigger to what runs: everything that can be refused is refused first, then the variants run.

Definition 2 of the paper with one ε a rule: for every rule of the trigger, the variant of its method that is bound to
the layer that Algorithm 1 gives, and no other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import CoroutineType
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.dispatch.instance import Instance, Unfinished
from sleec_runtime.dispatch.layers import Variant, await_under, run_all
from sleec_runtime.dispatch.snapshot import Cell, Snapshot
from sleec_runtime.errors import (
    ConflictInContext,
    NeedsAwait,
    UndeterminedDecision,
    UnknownTrigger,
    VariantsFailed,
    WrongArguments,
)
from sleec_runtime.evaluation.conflicts import find_conflict, missing_for
from sleec_runtime.evaluation.evaluation import Decision, Due, Outcome, Situation, Undetermined
from sleec_runtime.model import Context, Obligation, Rule
from sleec_runtime.support.messages import represent, text_of

if TYPE_CHECKING:
    from sleec_runtime.timed.pending import Pending


class ActiveClause(NamedTuple):
    """A rule by its label, and the number of its active clause: 0 is the default, i is the layer ``label.hci``."""

    rule: str
    clause: int


class Plan:
    """What a dispatch will do in one context: checked, and nothing run yet. Immutable."""

    __slots__ = (
        "asynchronous",
        "clauses",
        "decisions",
        "fitting",
        "mark",
        "obligations",
        "prohibitions",
        "triggers",
        "variants",
    )

    def __init__(self, triggers: tuple[str, ...], due: Due, variants: tuple[Variant, ...], mark: object) -> None:
        self.triggers = triggers
        self.decisions = due.decisions
        self.variants = variants
        self.mark = mark
        self.obligations = due.obligations
        self.prohibitions = due.prohibitions
        self.clauses = tuple(ActiveClause(d.rule.label, d.clause) for d in due.decisions)
        self.asynchronous = any(variant.asynchronous for variant in variants)
        self.fitting: set[tuple[object, ...]] = set()
        """The shapes of arguments that all variants take: how many, and the names of those given by name."""

    def refuse_misfits(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        """Raises WrongArguments if the code of some rule does not take these. O(1) but for the first of a shape."""
        shape = (len(args), *kwargs)
        if shape in self.fitting:
            return
        for variant in self.variants:
            # Plans go with their context; variants stay.
            if shape not in variant.fitting:
                for function in variant.called:
                    refuse_misfit(variant.label, function, args, kwargs)
                variant.fitting.add(shape)
        self.fitting.add(shape)

    def refuse_coroutines(self) -> None:
        """Raises NeedsAwait if a variant is known to be a coroutine function."""
        if self.asynchronous:
            raise NeedsAwait(
                f"a variant of {' and '.join(self.triggers)} is a coroutine function", "await trigger_async(…) instead"
            )


class Done:
    """What one dispatch did, and why. It keeps the context that it was decided in."""

    __slots__ = ("_plan", "_results", "_snapshot")

    def __init__(self, plan: Plan, snapshot: Snapshot, results: Sequence[object]) -> None:
        self._plan = plan
        self._snapshot = snapshot
        self._results = results

    @property
    def triggers(self) -> tuple[str, ...]:
        return self._plan.triggers

    @property
    def obligations(self) -> tuple[str, ...]:
        """What was due, and is done unless `due` has it: each name once, in the order of rules and their clauses."""
        return self._plan.obligations

    @property
    def prohibitions(self) -> tuple[str, ...]:
        """What was not to be done."""
        return self._plan.prohibitions

    @property
    def clauses(self) -> tuple[ActiveClause, ...]:
        """The active clause of each rule that spoke, in the order of the rules."""
        return self._plan.clauses

    @property
    def decisions(self) -> tuple[Decision, ...]:
        """The same, with the conditions that decided."""
        return self._plan.decisions

    @property
    def results(self) -> Mapping[str, object]:
        """What the variants returned, by the label of the rule. A clause with nothing to run has no entry."""
        return {variant.label: result for variant, result in zip(self._plan.variants, self._results)}

    @property
    def context(self) -> Context:
        """The context χ that the dispatch was decided in."""
        return self._snapshot.context(self._plan.triggers)

    @property
    def change(self) -> int:
        """The number of the change of context that made it."""
        return self._snapshot.number

    @property
    def due(self) -> tuple[Pending, ...]:
        """What of it is not over yet, with its window: obligations that are still to be done, prohibitions that are
        still in force. Asked again later, there is less of it."""
        return ()

    def explain(self) -> str:
        """For every rule of the trigger: the active clause, what it obliges, and the conditions that decided."""
        from sleec_runtime.evaluation.explanation import outcome_in_words

        program = self._snapshot.program
        lines = [f"{' and '.join(self.triggers)}, in the context of change {self.change}:"]
        for rule, outcome in outcomes_of(self._snapshot, self.triggers):
            assert not isinstance(outcome, Undetermined), "refused before it ran"
            lines.append(outcome_in_words(rule, outcome, self.context))
        if len(lines) == 1:
            where = "" if program.domain is None else f" in the domain {program.domain}"
            lines.append(f"no rule has this trigger{where}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"Done(triggers={self.triggers}, obligations={self.obligations}, clauses={self.clauses})"


def cell_of(snapshot: Snapshot, trigger: str) -> Cell:
    """What the rules of `trigger` say in this context. Raises UnknownTrigger."""
    try:
        number = snapshot.program.number_of.get(trigger)
    except TypeError:  # not hashable, so no name
        number = None
    if number is None:
        raise UnknownTrigger(trigger, snapshot.program.number_of)
    return snapshot.cell(number)


def outcomes_of(snapshot: Snapshot, triggers: Sequence[str], others: Iterable[str] = ()) -> list[tuple[Rule, Outcome]]:
    """What every rule of `triggers` says, in the order of the rules, where `others` occur as well. Raises
    UnknownTrigger."""
    program = snapshot.program
    occurring = frozenset(triggers).union(others)
    pairs = [
        (rule, outcome if rule.label not in program.tied else snapshot.outcome(rule, occurring))
        for trigger in dict.fromkeys(triggers)
        for rule, outcome in zip(program.cells[program.number_of[trigger]], cell_of(snapshot, trigger).outcomes)
    ]
    return sorted(pairs, key=lambda pair: program.order[pair[0].label]) if len(triggers) > 1 else pairs


def due_in(snapshot: Snapshot, triggers: Sequence[str]) -> Due:
    """What is due if `triggers` occur together in this context.

    O(rules of the triggers + constraints on what they oblige). Raises UnknownTrigger, UndeterminedDecision (in strict
    mode), and ConflictInContext.
    """
    for trigger in triggers:
        cell_of(snapshot, trigger)
    outcomes = [outcome for _, outcome in outcomes_of(snapshot, triggers)]
    missing = [name for outcome in outcomes if isinstance(outcome, Undetermined) for name in outcome.missing]
    if missing:
        raise UndeterminedDecision(triggers, tuple(dict.fromkeys(missing)))
    due = Due(tuple(outcome for outcome in outcomes if isinstance(outcome, Decision)))
    refuse_conflict(snapshot, triggers, due)
    return due


def refuse_conflict(
    snapshot: Snapshot, triggers: Sequence[str], due: Due, happening: tuple[Obligation, ...] = ()
) -> None:
    """Raises ConflictInContext if what is due, and what happens besides, cannot all be together in this context, and
    UndeterminedDecision if, in strict mode, that depends on what nobody reported."""
    program = snapshot.program
    literals = (*due.literals, *happening)
    constraints = program.constraints_on(literals)
    closed = Situation(snapshot.context(triggers), program.measures)
    cause = find_conflict(literals, constraints, closed)
    if cause is not None:
        from sleec_runtime.evaluation.explanation import conflict_in_words

        raise ConflictInContext(conflict_in_words(cause, due.decisions), cause)
    if program.strict:
        open_world = Situation(closed.context, program.measures, absent=None)
        possible = find_conflict(literals, constraints, open_world)
        if possible is not None:
            raise UndeterminedDecision(triggers, missing_for(possible.constraints, open_world))


def plan(snapshot: Snapshot, triggers: tuple[str, ...], instance: Instance) -> Plan:
    """What a dispatch of `triggers` in this context will do. Raises as `due_in` does, and NotBound."""
    due = due_in(snapshot, triggers)
    variants = []
    for decision in due.decisions:
        clauses = list(decision.rule.clauses())
        variant = instance.variant(decision.rule, decision.clause, clauses[decision.clause])
        if variant is not None:
            variants.append(variant)
    return Plan(triggers, due, tuple(variants), snapshot.mark)


def run(plan: Plan, snapshot: Snapshot, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Done:
    """Runs the variants of a plan in order. Raises what a variant raised, after all have run."""
    plan.refuse_misfits(args, kwargs)
    plan.refuse_coroutines()
    results, errors = run_all(plan.variants, args, kwargs)
    for result in results:
        if type(result) is CoroutineType or type(result) is Unfinished:
            result.close()
            raise NeedsAwait(
                f"a variant of {' and '.join(plan.triggers)} returned a coroutine", "await trigger_async(…) instead"
            )
    if errors:
        raise one_of(errors)
    return Done(plan, snapshot, results)


async def run_async(plan: Plan, snapshot: Snapshot, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Done:
    """Runs the variants of a plan one after the other, awaiting those that are coroutines. Raises as `run` does."""
    plan.refuse_misfits(args, kwargs)
    results: list[object] = []
    errors: list[tuple[str, Exception]] = []
    for variant in plan.variants:
        try:
            results.append(await await_under(variant, args, kwargs))
        except Exception as error:  # noqa: BLE001 - raised again once all have run
            errors.append((variant.label, error))
    if errors:
        raise one_of(errors)
    return Done(plan, snapshot, results)


def refuse_misfit(label: str, function: Callable[..., Any], args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> None:
    """Raises WrongArguments if `function`, code of rule `label`, does not take these."""
    import inspect

    try:
        # Not what a decorator says that it wraps: it may take other arguments than that, and hand over others.
        signature = inspect.signature(function, follow_wrapped=False)
    except (TypeError, ValueError):
        # Built into the interpreter, with no signature to read: the call itself will tell.
        return
    try:
        signature.bind(*args, **kwargs)
    except TypeError as error:
        plain = getattr(function, "func", function)
        name = getattr(plain, "__name__", None) or represent(plain)
        raise WrongArguments(
            f"{name}, the code of rule {label}, cannot be called so: {error}",
            f"give the trigger what {name}{text_of(signature)} takes; nothing was run",
        ) from None


def one_of(errors: Sequence[tuple[str, BaseException]]) -> BaseException:
    """What one variant raised, as it raised it; of several, an error that holds them all."""
    if len(errors) == 1:
        return errors[0][1]
    several = VariantsFailed(errors)
    several.__cause__ = errors[0][1]
    return several
