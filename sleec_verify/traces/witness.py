"""The necessary parts of a conflict's situation: a minimal set of relations, conditions and measures."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from sleec_runtime import model
from sleec_runtime.model import Assume, Context, Formula, MeasureRelation, Rule, Value, names_of
from sleec_verify.encoding.budget import as_far_as_decided
from sleec_verify.encoding.cnf import Key
from sleec_verify.encoding.equation import guard
from sleec_verify.encoding.formula_truth import truth_in
from sleec_verify.encoding.relations import events_of, formula_at_one_instant
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.encoding.window_lengths import measures_of_lengths
from sleec_verify.traces.act_decisions import acts_now
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.instant import Instant, SharedClauses
from sleec_verify.traces.situations import Fact, Situations


def needed_relations(
    continuations: Continuations,
    rules: Collection[str],
    but: Collection[Fact],
    other_acts: Collection[tuple[Collection[str], Mapping[str, bool]]] = (),
) -> tuple[str, ...]:
    """The keys of a minimal set of relations with which no response complies with `rules`, and none that complies with
    the rules of `other_acts` has these acts."""
    others = [(counting, list(acts_now(continuations, acts))) for counting, acts in other_acts]
    kept: list[str] = []
    for counting, literals in others:
        stuck = not continuations.complies(counting, (), *literals)
        assert stuck, "no response has other acts"
        kept += continuations.relations_in_core()
    stuck = not continuations.complies(rules, but)
    assert stuck, "asked of a conflict"
    kept = list(dict.fromkeys([*continuations.relations_in_core(), *kept]))
    for key in list(kept):
        less = [other for other in kept if other != key]
        with as_far_as_decided():
            if any(continuations.complies(counting, (), *acts, relations=less) for counting, acts in others):
                continue
            if not continuations.complies(rules, but, relations=less):
                kept = less
    return tuple(kept)


def needed_values(
    situations: Situations,
    continuations: Continuations,
    rules: Collection[str],
    but: Collection[Fact],
    deciding: Iterable[tuple[str, int]],
    values: Mapping[str, Value],
    past: Collection[str],
) -> Mapping[str, Value]:
    """The `values` of a minimal set of conditions and measures with which no response complies with `rules`, and
    the clauses `deciding` decide, and those of the lengths of their windows. All other conditions may be false.

    `past` are the events of the history, which can begin relations that are in force now."""
    index = situations.index
    deciding = list(deciding)
    clauses = [list(index.ruleset.by_label[label].clauses())[number] for label, number in deciding]
    lengths = {name for clause in clauses for name in measures_of_lengths(clause)}
    facts = [fact for fact in continuations.facts if fact[0] == "state"]
    formula = SharedClauses()
    instant = Instant(formula, index.ruleset.measures, formula.true)
    guards = [
        instant.guards(index.ruleset.by_label[label], index.ruleset.reading, formula.true)[number]
        for label, number in deciding
    ]
    formula.clauses.append([-guard for guard in guards])
    named: dict[Fact, frozenset[str]] = {}
    literals: dict[Fact, int] = {}
    for fact in facts:
        key = fact[1]
        assert isinstance(key, tuple), "the key of a variable"
        named[fact] = names_of_key(instant, key)
        if key in instant.variables:
            literals[fact] = instant.variables[key] if fact[-1] else -instant.variables[key]
    instant.settle()
    with MiniSat(formula.clauses) as solver:

        def refuted(names: set[str]) -> set[str] | None:
            """The names that suffice, of these and those of lengths; None if they do not."""
            names = names | lengths
            left_out = [fact for fact in facts if not named[fact] <= names]
            still = [literal for fact, literal in literals.items() if named[fact] <= names]
            if solver.solve(still) is not False or continuations.complies(rules, [*but, *left_out]):
                return None
            core = {*continuations.core(), *(fact for fact, literal in literals.items() if literal in solver.core())}
            return {name for fact in facts if fact in core for name in named[fact]}

        kept = refuted({name for names in named.values() for name in names})
        assert kept is not None, "asked of a conflict"
        for name in sorted(kept - lengths):
            with as_far_as_decided():
                less = refuted(kept - {name}) if name in kept else None
                kept = kept if less is None else less
    # Which clause of a rule that names acts decides is a question of its own, and no fact of the refutation.
    naming = [index.ruleset.by_label[label] for label in rules if situations.variant_guards.get(label)]
    kept |= {name for rule in naming for formula in index.formulas(rule) for name in names_of(formula)} & values.keys()
    closed = _closed(situations, kept | lengths, values, past)
    # The values of further measures must satisfy the relations, too.
    closed = _closed(situations, _with_compared(situations.index, deciding, closed, values), values, past)
    return {name: value for name, value in values.items() if name in closed}


def _with_compared(
    index: TraceIndex, deciding: Iterable[tuple[str, int]], names: set[str], values: Mapping[str, Value]
) -> set[str]:
    """These names, with a minimal set of measures with which the clauses decide. A comparison of a measure without a
    value is false, also one that is true for all values."""
    measures = index.ruleset.measures

    def decides(rule: Rule, formula: Formula, known: set[str]) -> bool:
        context = Context(frozenset((rule.trigger,)), {n: value for n, value in values.items() if n in known})
        return truth_in(context, [formula], measures) == [True]

    found = set(names)
    for label, number in deciding:
        rule = index.ruleset.by_label[label]
        formula = guard(rule, index.ruleset.reading, number)
        if decides(rule, formula, found):
            continue
        compared = set(names_of(formula)) & measures.keys() - found
        found |= compared
        for name in sorted(compared):
            if decides(rule, formula, found - {name}):
                found.remove(name)
    return found


def names_of_key(instant: Instant, key: Key) -> frozenset[str]:
    """The conditions and measures that a variable is about."""
    found: set[str] = set()
    for name in key[1:2] if key[0] in ("condition", "below") else key[1:]:
        calculated = instant.measures.calculations.get(name)
        found.update([name] if calculated is None else calculated.measures)
    return frozenset(found)


def _closed(situations: Situations, names: set[str], values: Mapping[str, Value], past: Collection[str]) -> set[str]:
    """These names, with those that relations connect to them, or that a relation of the history requires."""
    found = set(names)
    formulas = list(_required(situations))
    lasting = [law for law, active, _ in situations.lasting.values() if situations.holds(active)]
    formulas += [law.formula for law in lasting]
    begun = [law.formula for law in lasting if law.event in past]
    measures = situations.index.ruleset.measures
    grew = True
    while grew:
        context = Context(frozenset(), {name: value for name, value in values.items() if name in found})
        related = [f for f in formulas if f in begun or not found.isdisjoint(names_of(f))]
        truths = truth_in(context, related, measures)
        tied = {name for formula, truth in zip(related, truths) if not truth for name in names_of(formula)}
        grew = not tied <= found
        found |= tied
    return found


def _required(situations: Situations) -> Iterator[model.Formula]:
    """The formulas that relations require of the conditions and measures of now, for all events."""
    for relation in situations.index.relations:
        if isinstance(relation, MeasureRelation):
            yield formula_at_one_instant(relation)
        elif isinstance(relation, Assume) and not any(events_of(relation)):
            yield relation.formula
