"""The index of a ruleset: the rules of each trigger, the rules that mention each name, and groups of constraints."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from sleec_runtime.dispatch.decision_memo import RuleMemo, has_calculations
from sleec_runtime.errors import SleecError, UnknownCondition, UnknownDomain, WrongType
from sleec_runtime.evaluation.conflicts import Forbidding, forbidding, mentioned
from sleec_runtime.model import Measure, Never, Obligation, Rule, Ruleset, Value, fit, formulas_of, names_of
from sleec_runtime.support.chunked_sequence import Chunks
from sleec_runtime.support.messages import represent


class RuleIndex:
    """The index of the rules of one domain. Immutable, and built in O(size of the rules).

    `whole` is the ruleset with all domains, whose names can be reported and triggered in each domain. `by_trigger` has
    the rules of each trigger, in rule order, and `places` the place of its outcomes in a snapshot. `trigger_dependent`
    are the labels of the rules whose guards or hedges name triggers. `situational` are the conditions and measures in
    `NEVER` constraints, by number.
    """

    def __init__(self, whole: Ruleset, domain: str | None = None, strict: bool = False) -> None:
        if domain is not None and domain not in whole.domains:
            raise UnknownDomain(domain, whole.domains)
        self.whole = whole
        self.domain = domain
        self.strict = strict
        self.ruleset = ruleset = whole if domain is None else whole.in_domain(domain)
        self.measures: Mapping[str, Measure] = whole.measures
        self.vocabulary: dict[str, Measure | None] = {**dict.fromkeys(sorted(whole.conditions)), **whole.measures}
        self.numbers = {name: number for number, name in enumerate(self.vocabulary)}
        self.order = _in_order(ruleset.rules)

        by_trigger: dict[str, list[Rule]] = {trigger: [] for trigger in sorted(whole.triggers)}
        for rule in ruleset.rules:
            by_trigger[rule.trigger].append(rule)
        self.by_trigger = tuple(tuple(rules) for rules in by_trigger.values())
        self.number_of = {trigger: number for number, trigger in enumerate(by_trigger)}
        layout = Chunks.of(by_trigger)
        self.places = {trigger: layout.place(number) for trigger, number in self.number_of.items()}

        self.place_of: dict[str, tuple[int, int]] = {}
        mentions: defaultdict[str, list[tuple[int, int]]] = defaultdict(list)
        for number, rules in enumerate(self.by_trigger):
            for position, rule in enumerate(rules):
                self.place_of[rule.label] = number, position
                for name in {name for formula in formulas_of(rule) for name in names_of(formula)}:
                    mentions[name].append((number, position))
        self._mentions = {self.numbers[name]: places for name, places in mentions.items() if name in self.numbers}
        self.trigger_dependent = frozenset(
            self.by_trigger[number][position].label
            for trigger in self.number_of.keys() & mentions.keys()
            for number, position in mentions[trigger]
        )

        constraints = forbidding(ruleset)
        nevers = [c for c in constraints if isinstance(c, Never)]
        self._memos: dict[str, RuleMemo | None] = {}
        values = Chunks.of(self.numbers)
        self._value_places = {name: values.place(number) for name, number in self.numbers.items()}
        self.situational = frozenset(
            self.numbers[name] for c in nevers for name in names_of(c.formula) if name in self.numbers
        )
        self._groups, self._group_of = _grouped(constraints)
        self._always = tuple(c for group in self._groups if any(isinstance(c, Never) for c in group) for c in group)

    def memo(self, rule: Rule) -> RuleMemo | None:
        """The memo of a rule; None if it is interpreted each time: in strict mode, where values may be unknown, and for
        calculations."""
        try:
            return self._memos[rule.label]
        except KeyError:
            is_interpreted = self.strict or has_calculations(rule)
            found = None if is_interpreted else RuleMemo(rule, self._value_places, self.measures)
            return self._memos.setdefault(rule.label, found)

    def concerned(self, numbers: Iterable[int]) -> Iterable[tuple[int, int]]:
        """The rules that mention one of the conditions or measures with these numbers, as positions in `by_trigger`,
        each once."""
        found = [self._mentions.get(number, ()) for number in numbers]
        return found[0] if len(found) == 1 else dict.fromkeys(place for places in found for place in places)

    def checked(self, changes: Mapping[str, object]) -> dict[int, Value | None]:
        """The changes by number, each value as the rules compare it; None for a value that is no longer known.

        Raises UnknownCondition or WrongType for the first invalid change.
        """
        if not isinstance(changes, Mapping):
            raise WrongType(
                "a change of context", changes, "a mapping of names to values", 'give a dict: {"UserUndressed": True}'
            )
        checked: dict[int, Value | None] = {}
        for name, value in changes.items():
            if name not in self.numbers:
                is_trigger = name in self.whole.triggers
                hint = "it is a trigger: call trigger() when it occurs" if is_trigger else None
                raise UnknownCondition(name, self.vocabulary, hint)
            checked[self.numbers[name]] = None if value is None else fit(name, value, self.vocabulary[name])
        return checked

    def constraints_on(self, literals: Iterable[Obligation]) -> tuple[Forbidding, ...]:
        """The constraints that may contradict `literals`: those that share obligations with them, directly or not, and
        those that a situation may break by itself."""
        if not self._groups:
            return ()
        groups = dict.fromkeys(self._group_of[o.name] for o in literals if o.name in self._group_of)
        touched = tuple(c for number in groups for c in self._groups[number])
        return tuple(dict.fromkeys((*touched, *self._always))) if self._always else touched


def _in_order(rules: Iterable[Rule]) -> Mapping[str, int]:
    order: dict[str, int] = {}
    for number, rule in enumerate(rules):
        if rule.label in order:
            raise SleecError(f"two rules have the label {represent(rule.label)}", "give each rule its own label")
        order[rule.label] = number
    return order


def _grouped(constraints: Iterable[Forbidding]) -> tuple[list[list[Forbidding]], dict[str, int]]:
    """The constraints in groups that share no obligation, and the group of each obligation."""
    groups: list[list[Forbidding]] = []
    group_of: dict[str, int] = {}
    for constraint in constraints:
        names = mentioned(constraint)
        joined = sorted({group_of[name] for name in names if name in group_of})
        target = joined[0] if joined else len(groups)
        if not joined:
            groups.append([])
        for other in joined[1:]:
            groups[target] += groups[other]
            group_of.update((name, target) for c in groups[other] for name in mentioned(c))
            groups[other] = []
        groups[target].append(constraint)
        group_of.update(dict.fromkeys(names, target))
    return groups, group_of
