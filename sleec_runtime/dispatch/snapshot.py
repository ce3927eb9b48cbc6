"""Snapshots: a context with the outcomes of all rules. A change makes a new snapshot and leaves the old one."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from sleec_runtime.dispatch.decision_memo import TriggerMemo, TriggerOutcomes
from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Outcome, walk
from sleec_runtime.model import Context, Rule, Value
from sleec_runtime.support.chunked_sequence import Chunks


class Conditions(Mapping[str, Value]):
    """The reported conditions and measures of a context, by name. Immutable."""

    __slots__ = ("_numbers", "_values")

    def __init__(self, numbers: Mapping[str, int], values: Chunks[Value | None]) -> None:
        self._numbers = numbers
        self._values = values

    def get(self, name: str, default: object = None) -> Value | None:  # type: ignore[override]
        number = self._numbers.get(name)
        value = None if number is None else self._values[number]
        return value if value is not None else default  # type: ignore[return-value]

    def __getitem__(self, name: str) -> Value:
        value = self.get(name)
        if value is None:
            raise KeyError(name)
        return value

    def __iter__(self) -> Iterator[str]:
        return (name for name, number in self._numbers.items() if self._values[number] is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"Conditions({dict(self)})"


class Snapshot:
    """A context χ without triggers, with the outcome of each rule if its trigger occurs.

    `number` counts the changes. `mark` is a new object if a change concerns a name in a `NEVER`: a plan is valid as
    long as the mark is the same. `rows` are the rows of `TriggerOutcomes`, for fast dispatch.
    `ready_plans` has the plans of rules without time that have passed all checks, by trigger.
    """

    __slots__ = ("_memos", "_outcomes", "_values", "index", "mark", "number", "ready_plans", "rows")

    def __init__(
        self,
        index: RuleIndex,
        values: Chunks[Value | None],
        outcomes: Chunks[TriggerOutcomes],
        mark: object,
        number: int,
        memos: dict[int, TriggerMemo],
    ) -> None:
        """`memos` are those of the triggers, by number, for the code that is bound now."""
        self.index = index
        self._values = values
        self._outcomes = outcomes
        self.rows = outcomes.rows
        self.mark = mark
        self.number = number
        self.ready_plans: dict[str, Plan] = {}
        self._memos = memos

    @classmethod
    def first(cls, index: RuleIndex, known: Mapping[str, object], number: int = 0) -> Snapshot:
        """The snapshot in which only `known` is reported. O(size of the rules). Raises as `RuleIndex.checked`."""
        initial: Chunks[Value | None] = Chunks.of([None] * len(index.numbers))
        values = initial.replaced(index.checked(known))
        reading = index.ruleset.reading
        by_trigger = []
        for trigger, rules in zip(index.number_of, index.by_trigger):
            situation = _situation(index, values, (trigger,))
            by_trigger.append(TriggerOutcomes(tuple(walk(rule, situation, reading) for rule in rules)))
        return cls(index, values, Chunks.of(by_trigger), object(), number, {})

    @property
    def conditions(self) -> Conditions:
        return Conditions(self.index.numbers, self._values)

    def context(self, triggers: Iterable[str] = ()) -> Context:
        """This context, with `triggers` occurring in it."""
        return Context(frozenset(triggers), self.conditions)

    def of_trigger(self, number: int) -> TriggerOutcomes:
        """The outcomes of the trigger with this number in the index."""
        return self._outcomes[number]

    def outcome(self, rule: Rule, triggers: Collection[str] = ()) -> Outcome:
        """The outcome of a rule if its trigger occurs, alone or together with other `triggers`."""
        index = self.index
        if len(triggers) > 1 and rule.label in index.trigger_dependent:
            return walk(rule, _situation(index, self._values, triggers), index.ruleset.reading)
        number, position = index.place_of[rule.label]
        return self._outcomes[number].outcomes[position]

    def changed(self, changes: Mapping[str, object]) -> tuple[Snapshot, tuple[Rule, ...]]:
        """The snapshot after `changes`, and the rules whose outcomes were computed again.

        O(changes + size of the rules that mention a changed name). Raises as `RuleIndex.checked`.
        """
        index = self.index
        checked = index.checked(changes)
        values = {number: value for number, value in checked.items() if self._values[number] != value}
        if not values:
            return self, ()
        after = self._values.replaced(values)
        concerned = index.concerned(values)
        changed: dict[int, list[Outcome]] = {}
        rules = []
        for number, position in concerned:
            if number not in changed:
                changed[number] = list(self._outcomes[number].outcomes)
            rule = index.by_trigger[number][position]
            changed[number][position] = _outcome(index, rule, after)
            rules.append(rule)
        outcomes = self._outcomes.replaced({number: self._memo(number).of(found) for number, found in changed.items()})
        mark = self.mark if index.situational.isdisjoint(values) else object()
        return Snapshot(index, after, outcomes, mark, self.number + 1, self._memos), tuple(rules)

    def _memo(self, number: int) -> TriggerMemo:
        try:
            return self._memos[number]
        except KeyError:
            return self._memos.setdefault(number, TriggerMemo())

    def without_plans(self, triggers: Iterable[str]) -> Snapshot:
        """The same context without the plans of `triggers`, because the code of their rules changed."""
        numbers = [self.index.number_of[trigger] for trigger in triggers if trigger in self.index.number_of]
        outcomes = self._outcomes.replaced({n: TriggerOutcomes(self._outcomes[n].outcomes) for n in numbers})
        memos = {number: memo for number, memo in self._memos.items() if number not in numbers}
        return Snapshot(self.index, self._values, outcomes, self.mark, self.number, memos)


def _situation(index: RuleIndex, values: Chunks[Value | None], triggers: Iterable[str]) -> Situation:
    """The situation if `triggers` occur."""
    context = Context(frozenset(triggers), Conditions(index.numbers, values))
    return Situation(context, index.measures, None if index.strict else False)


def _outcome(index: RuleIndex, rule: Rule, values: Chunks[Value | None]) -> Outcome:
    """The outcome of a rule if its trigger occurs alone."""

    def decide() -> Outcome:
        return walk(rule, _situation(index, values, (rule.trigger,)), index.ruleset.reading)

    memo = index.memo(rule)
    return decide() if memo is None else memo.outcome(values.rows, decide)
