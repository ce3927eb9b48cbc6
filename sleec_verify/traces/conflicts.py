"""Conflicts: minimal sets of rules with a situation in which no response complies with them (docs/times.md).

Counterexample-guided refinement of "there is a situation that no continuation fits". The search proposes an abstract
situation. If a continuation complies with the selected rules, its template excludes all situations that it fits. If
none does, the rules are reduced to a minimal set, and the search looks for a lawful history that leads to the
situation. If there is none, the facts that no history produces are excluded.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import NamedTuple

from sleec_runtime.model import Obligation, Rule
from sleec_verify.encoding.budget import OutOfBudget, Undecided, as_far_as_decided, share
from sleec_verify.encoding.solver import Refutation
from sleec_verify.results.conflict_freedom import Example, UsedTemplate
from sleec_verify.traces.act_conditions import Variant, variants_of, without_named_acts
from sleec_verify.traces.act_decisions import Decisions, clause_at, decisions
from sleec_verify.traces.complying_responses import complying_responses
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.cores import drop_slots, minimal_rules, weakest_facts
from sleec_verify.traces.event_conditions import event_of, is_of_state
from sleec_verify.traces.histories import Histories
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.refinement import Refinement
from sleec_verify.traces.situations import Fact, Situations
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.traces.used_templates import PART, used_templates
from sleec_verify.traces.witness import needed_relations, needed_values
from sleec_verify.wording.phrases import listed, quoted

MOST_UNDECIDED = 4
"""The number of undecided situations after which the search stops."""

MOST_HIDDEN = 50
"""Situations that are looked at for conflicts whose rules contain those of another one."""

LATER = -1
"""In place of a clause, for a rule that the response triggers at a later instant."""


def _without_states(moment: TraceInstant) -> TraceInstant:
    """An instant without the states that stand for events."""
    return moment._replace(conditions={n: v for n, v in moment.conditions.items() if event_of(n) is None})


def _named(labels: Iterable[str]) -> str:
    return listed(map(quoted, labels))


class Pair(NamedTuple):
    """A rule and its clause that decides."""

    rule: str
    clause: int


class Conflict(NamedTuple):
    """The rules, each with the clauses that decide; a lawful history up to now; the inputs of now, with the conditions
    and measures that matter; the keys of the relations that matter; the rules that every response triggers now; the
    refutation of a response that complies with the rules; and, if there is a recorder, responses that comply with all
    rules but one. For the rules whose conditions name acts: their decisions now, and what is pending."""

    pairs: tuple[Pair, ...]
    history: tuple[TraceInstant, ...]
    now: TraceInstant
    relations: tuple[str, ...]
    forced: frozenset[str]
    refutation: Refutation
    responses: tuple[Example, ...]
    decisions: Mapping[str, Decisions] = MappingProxyType({})
    pending: frozenset[tuple[str, Obligation]] = frozenset()

    @property
    def rules(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(pair.rule for pair in self.pairs))


class ConflictSearch:
    """The conflicts of one component of a ruleset."""

    def __init__(self, index: TraceIndex, variants: Mapping[str, Sequence[Variant]] | None = None) -> None:
        """`variants` are those of the rules of a component from which the names of acts are gone already.

        Raises:
            Undecided: the conditions of a rule name too many acts.
        """
        if variants is None:
            index = index.stated
            variants = {rule.label: variants_of(rule) for rule in index.rules}
            index = without_named_acts(index, variants)
        self._index = index
        self._variants = variants
        self._found: list[Conflict] = []
        self._undecided: list[Undecided] = []
        self._conclusions: list[tuple[Refutation, str]] = []
        """What excluded situations, and what this shows."""
        self.templates: tuple[UsedTemplate, ...] | None = None
        """The templates that serve all situations, if there is no conflict and a recorder."""
        self.may_be_more = False
        """Whether there may be further conflicts whose rules do not contain the rules of a conflict found."""

    @cached_property
    def _situations(self) -> Situations:
        return Situations(self._index, self._variants)

    @cached_property
    def _refinement(self) -> Refinement:
        return Refinement(self._situations)

    def find(self) -> Iterator[Conflict]:
        """Every minimal conflict, by its pairs, and none whose pairs contain those of another one.

        Raises `Undecided` after the last conflict that could be decided.
        """
        try:
            while self._refinement.propose():
                self._examine()
        except Undecided as error:
            self._undecided.append(error)
        if not self._undecided and self.chained:
            self._find_hidden()
        self._record()
        by_pairs: dict[frozenset[Pair], Conflict] = {}
        for conflict in self._found:
            by_pairs.setdefault(frozenset(conflict.pairs), conflict)
        yield from (one for pairs, one in by_pairs.items() if not any(other < pairs for other in by_pairs))
        if self._undecided:
            raise self._undecided[0]

    def _conclude(self, model: TraceModel, what: str) -> None:
        """Note the last question of a model that was answered with no."""
        assert model.refutation is not None, "some question was answered with no"
        self._conclusions.append((model.refutation, what))

    def _record(self) -> None:
        """Record the evidence: for each conflict, that no response complies with its rules; if there is none, the last
        round of the refinement and everything that it rests on."""
        recorder = self._index.recorder
        if recorder is None or self._undecided:
            return
        for conflict in self._found:
            recorder.refuted(*conflict.refutation, f"no response complies with {_named(conflict.rules)}")
        if not self._found:
            for refutation, what in self._conclusions:
                recorder.refuted(*refutation, what)
            rules = _named(self._index.ruleset.by_label)
            recorder.refuted(*self._refinement.refutation, f"no situation of {rules} is left without a template")
            self.templates = used_templates(self._situations, self._refinement.templates())

    @property
    def chained(self) -> list[str]:
        """The rules of conflicts that a response can trigger later in another conflict, in the order of the text."""
        obliging, by_label = self._index.obliging, self._index.ruleset.by_label
        found = {pair.rule for conflict in self._found for pair in conflict.pairs}
        return [label for label, rule in by_label.items() if label in found and rule.trigger in obliging]

    def _find_hidden(self) -> None:
        """Look for the conflicts whose rules contain those of another one, but with other pairs."""
        search = ConflictSearch(self._index, self._variants)
        for conflict in self._found:
            search.exclude(conflict, conflict.forced)
        try:
            with share(1 / 4):
                for _ in range(MOST_HIDDEN):
                    if not search._refinement.propose(copies=0):
                        break
                    search._examine(hidden=True)
                else:
                    self.may_be_more = True
        except Undecided:
            self.may_be_more = True
        self.may_be_more |= bool(search._undecided)
        self._found += search._found

    def exclude(self, conflict: Conflict, forced: Collection[str]) -> None:
        """Exclude the situations of a conflict. A rule of `forced` counts even if it is not triggered now."""
        s = self._situations
        of_acts = {*conflict.decisions, *(label for label, _ in conflict.pending)}
        pairs = [
            (pair.rule, None if pair.clause == LATER else pair.clause)
            for pair in conflict.pairs
            if pair.rule not in of_acts
        ]
        decided = {label: one.allowed for label, one in conflict.decisions.items()}
        s.exclude_pairs(pairs, decided, conflict.pending, forced)

    def _examine(self, hidden: bool = False) -> None:
        """Note the conflict in the situation proposed, unless that is none. Not `hidden`: exclude also the situations
        in which its rules are not triggered now, which may hide conflicts with more rules."""
        try:
            conflict = self._look()
        except Undecided as error:
            self._leave_open(error)
            return
        if conflict is not None:
            self._found.append(conflict)
            self.exclude(conflict, conflict.forced if hidden else conflict.rules)

    def _leave_open(self, error: Undecided) -> None:
        """Continue without the situations that have the rules, inputs and slots of the undecided one."""
        if isinstance(error, OutOfBudget) or len(self._undecided) >= MOST_UNDECIDED:
            raise error
        self._undecided.append(error)
        self._situations.exclude([f for f in self._situations.facts() if f[0] in ("rule", "input", "slot") and f[-1]])

    # One situation --------------------------------------------------------------------------------------------

    def _look(self) -> Conflict | None:
        """The conflict in the proposed situation, if there is one. Otherwise it is excluded, with others like it."""
        s = self._situations
        facts = s.facts()
        rules = [str(fact[1]) for fact in facts if fact[0] == "rule"]
        continuations = Continuations(s, facts)
        if continuations.complies(rules):
            self._refinement.learn(continuations, facts)
            return None
        return self._stuck(continuations, rules, facts)

    def _stuck(self, continuations: Continuations, rules: list[str], facts: list[Fact]) -> Conflict | None:
        """The conflict in a situation in which no response complies with `rules`, if there is one. Otherwise the
        situation is excluded."""
        s = self._situations
        rules = minimal_rules(continuations, rules)
        if not rules:
            s.exclude(weakest_facts(continuations, continuations.core(), s))
            self._conclude(continuations.model, "the relations allow no response in some situations")
            return None
        core = continuations.core()
        given = {str(fact[1]) for fact in facts if fact[0] == "input" and fact[-1]}
        index = self._index
        concerned = {e: [*index.by_trigger.get(e, ()), *index.naming.get(e, ())] for e in given}
        foreign = {e for e in given if not any(rule.label in rules for rule in concerned[e])}
        if foreign:
            # With an input of other rules, it is not a situation of these rules, and not minimal for more rules.
            fewer: list[Fact] = [("input", f[1], False) if f[0] == "input" and f[1] in foreign else f for f in facts]
            without = Continuations(s, fewer)
            if without.complies([]) and not without.complies(rules):
                fewer_rules = minimal_rules(without, rules)
                if not any(fact[0] == "input" and fact[1] in foreign for fact in without.core()):
                    return self._stuck(without, fewer_rules, fewer)
            core = weakest_facts(continuations, core, s)
            self._conclude(continuations.model, f"no response complies with {_named(rules)}, whatever else occurs")
            for event in sorted(foreign):
                s.exclude(dict.fromkeys([*core, ("input", event, True)]))
            return None
        if not any(self._decides(label, given) for label in rules):
            core = weakest_facts(continuations, core, s)
            self._conclude(continuations.model, f"no response complies with what is pending of {_named(rules)}")
            return self._doomed(core, rules)
        facts, continuations, given = self._with_fewer_inputs(rules, facts, continuations, given)
        core = drop_slots(continuations, rules, facts)
        slots = {int(str(f[1])) for f in core if f[0] == "slot"}
        pairs, forced = self._pairs(continuations, rules, given, slots)
        return self._confirmed(rules, core, given, pairs, forced, continuations)

    def _doomed(self, core: list[Fact], rules: list[str]) -> Conflict | None:
        """The conflict of rules with pending demands that nothing can meet, although none of the rules decides now."""
        s = self._situations
        slots = [s.slots[int(str(f[1]))] for f in core if f[0] == "slot"]
        again = [
            s.formula.every([s.inputs[one.rule.trigger], s.guards[one.rule.label][one.pending.number]]) for one in slots
        ]
        others = [-given for event, given in s.inputs.items() if all(event != one.rule.trigger for one in slots)]
        if again and s.find(*(s.literal(fact) for fact in core), s.formula.any_of(again), *others):
            # A situation of these rules: the same is pending, and one of them is triggered again.
            facts = s.facts()
            continuations = Continuations(s, facts)
            stuck = not continuations.complies(rules)
            assert stuck, "the facts suffice"
            return self._stuck(continuations, rules, facts)
        needed = [s.formula.every(self._speaking(label)) for label in rules]
        s.add([*(-s.literal(fact) for fact in core), *needed])
        return None

    def _with_fewer_inputs(
        self, rules: list[str], facts: list[Fact], continuations: Continuations, given: set[str]
    ) -> tuple[list[Fact], Continuations, set[str]]:
        """A situation with fewer inputs in which the same rules are in conflict."""
        for event in sorted(given):
            fewer = given - {event}
            if any(self._decides(label, fewer) for label in rules):
                less: list[Fact] = [("input", event, False) if f[:2] == ("input", event) else f for f in facts]
                smaller = Continuations(self._situations, less)
                if not smaller.complies(rules) and minimal_rules(smaller, rules) == rules:
                    facts, continuations, given = less, smaller, fewer
        return facts, continuations, given

    def _decides(self, label: str, given: set[str]) -> bool:
        rule = self._index.ruleset.by_label[label]
        return rule.trigger in given and any(map(self._situations.holds, self._situations.guards[label]))

    def _speaking(self, label: str) -> list[int]:
        s = self._situations
        trigger = s.inputs[self._index.ruleset.by_label[label].trigger]
        return [trigger, s.formula.any_of(s.guards[label])]

    def _confirmed(
        self,
        rules: list[str],
        core: list[Fact],
        given: set[str],
        pairs: tuple[Pair, ...],
        forced: frozenset[str],
        continuations: Continuations,
    ) -> Conflict | None:
        """The conflict with a lawful history, if there is one."""
        s = self._situations
        slots = {int(str(f[1])) for f in core if f[0] == "slot"}
        core = [*core, *self._needed_occurrences(continuations, rules, core)]
        histories = Histories(s, self._about_past(core, slots), rules)
        if not histories.exist():
            # A history may leave more of these rules pending, and then the situation must contain it.
            own = {n for n, slot in enumerate(s.slots) if slot.rule.label in rules and s.holds(slot.active)}
            if not histories.exist(strict=False):
                s.exclude(weakest_facts(histories, histories.refuted(), s))
                self._conclude(histories, f"no lawful history leads to some situations of {_named(rules)}")
                return None
            histories = Histories(s, self._about_past(core, slots | own), rules)
            if not histories.exist():
                others = [slot for n, slot in enumerate(s.slots) if slot.rule.label in rules and n not in own]
                needed = [
                    *weakest_facts(histories, histories.refuted(), s),
                    *(("rule", label, True) for label in rules),
                ]
                s.add([*(-s.literal(fact) for fact in needed), *(slot.active for slot in others), s.more])
                self._conclude(histories, f"each history to some situations leaves more of {_named(rules)} pending")
                return None
        moments, time = histories.history()
        counting = set(core)
        left_out = [fact for fact in continuations.facts if fact not in counting and fact[0] != "state"]
        decided = self._decisions(continuations, rules, given, forced)
        other_acts = [
            ([other for other in rules if other != label], acts)
            for label, one in decided.items()
            for acts, clause in one.refused
            if one.clause is not None and clause != one.clause
        ]
        relations = needed_relations(continuations, rules, left_out, other_acts)
        refutation = continuations.model.refutation
        assert refutation is not None, "no response complies"
        pending = {Pair(s.slots[n].rule.label, s.slots[n].pending.number) for n in slots}
        deciding = [
            pair
            for pair in pairs
            if self._index.ruleset.by_label[pair.rule].trigger in given or pair not in pending
            if pair.clause != LATER and s.holds(s.guards[pair.rule][pair.clause])
        ]
        past = {event for moment in moments for event in moment.events}
        values = needed_values(s, continuations, rules, left_out, deciding, s.instant.values(s.holds), past)
        now = TraceInstant(time, frozenset(given), values)
        stated = tuple(key for key in relations if not is_of_state(self._index.relation_by_key[key]))
        history = tuple(map(_without_states, moments))
        responses: list[Example] = []
        if self._index.recorder is not None:
            with as_far_as_decided(), share(PART):
                responses += complying_responses(continuations, rules)
        shown = self._of_the_text(pairs, decided, slots, histories)
        pending_of_acts = frozenset(
            (slot.rule.label, slot.pending.obligation)
            for slot in (s.slots[number] for number in slots)
            if self._variants[slot.rule.label]
        )
        return Conflict(
            shown,
            history,
            _without_states(now),
            stated,
            forced,
            refutation,
            tuple(responses),
            decided,
            pending_of_acts,
        )

    def _needed_occurrences(
        self, continuations: Continuations, rules: list[str], core: Collection[Fact]
    ) -> Iterator[Fact]:
        """The facts that an event occurred before now, without which the relations or all rules but one would allow no
        response. Without these, the history could lead to another situation, which is none of these rules."""
        smaller = [[other for other in rules if other != label] for label in rules]
        for fact, literal in continuations.facts.items():
            is_left_out = fact[0] == "occurred" and fact[-1] and fact not in core
            if is_left_out and not all(continuations.complies(others, [fact], -literal) for others in smaller):
                yield fact

    def _about_past(self, core: list[Fact], slots: set[int]) -> list[Fact]:
        """The facts of a core about the past, with all facts about some slots. A relation that is not in force may be
        false now, so that also is a fact about the past."""
        s = self._situations
        nodes = {s.slots[number].node for number in slots}
        nodes |= {s.lasting[str(f[1])][2] for f in core if f[0] == "lasts" and f[-1]}
        known = set(core)
        return [
            f
            for f in s.facts()
            if f in known
            or (f[0] in ("slot", "came") and f[1] in slots)
            or (f[0] == "gap" and nodes & {*f[1:3]})
            or (f[0] == "lasts" and not f[-1])
        ]

    def _pairs(
        self, continuations: Continuations, rules: list[str], given: set[str], slots: set[int]
    ) -> tuple[tuple[Pair, ...], frozenset[str]]:
        """The rules with the clauses that decide, and those of the rules that every response triggers now."""
        s = self._situations
        found: set[Pair] = set()
        forced: set[str] = set()
        for label in rules:
            rule: Rule = self._index.ruleset.by_label[label]
            own = {Pair(label, s.slots[n].pending.number) for n in slots if s.slots[n].rule.label == label}
            if rule.trigger not in given and self._is_forced(continuations, rules, rule):
                forced.add(label)
            if rule.trigger in given or label in forced:
                own.update(Pair(label, n) for n, guard in enumerate(s.guards[label]) if s.holds(guard))
            # A rule that only a later instant triggers has no deciding clause yet.
            found |= own or {Pair(label, LATER)}
        return self._in_order(found), frozenset(forced)

    def _in_order(self, pairs: Iterable[Pair]) -> tuple[Pair, ...]:
        order = {label: place for place, label in enumerate(self._index.ruleset.by_label)}
        return tuple(sorted(pairs, key=lambda pair: (order[pair.rule], pair.clause)))

    def _decisions(
        self, continuations: Continuations, rules: list[str], given: set[str], forced: Collection[str]
    ) -> dict[str, Decisions]:
        """The decisions of the rules that are triggered now and whose conditions name acts."""
        return {
            label: decisions(continuations, [other for other in rules if other != label], label, self._variants[label])
            for label in rules
            if self._variants[label] and (self._index.ruleset.by_label[label].trigger in given or label in forced)
        }

    def _of_the_text(
        self, pairs: Iterable[Pair], decided: Mapping[str, Decisions], slots: Iterable[int], histories: Histories
    ) -> tuple[Pair, ...]:
        """The pairs with the clauses of the text. A rule whose conditions name acts has the clause that decides in
        every response that complies with the other rules, if that is one, and those of what is pending."""
        found = {pair for pair in pairs if pair.clause == LATER or not self._variants[pair.rule]}
        for number in slots:
            label = self._situations.slots[number].rule.label
            if self._variants[label]:
                ruleset = self._index.ruleset
                moment = histories.trigger_of[number]
                clause = clause_at(moment, self._variants[label], ruleset.reading, ruleset.measures)
                assert clause is not None, "some clause demands what is pending"
                found.add(Pair(label, clause))
        found |= {Pair(label, one.clause) for label, one in decided.items() if one.clause is not None}
        some = {pair.rule for pair in found}
        return self._in_order(found | {Pair(label, LATER) for label in decided if label not in some})

    @staticmethod
    def _is_forced(continuations: Continuations, rules: list[str], rule: Rule) -> bool:
        """Whether each response that complies with the other rules triggers a rule now."""
        others = [label for label in rules if label != rule.label]
        event = continuations.model.instants[continuations.now].event(rule.trigger)
        return not continuations.complies(others, (), -event)
