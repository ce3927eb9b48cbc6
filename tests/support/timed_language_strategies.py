"""Random rulesets in structured English with times, concerns, purposes and relations, as values."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from sleec_runtime.model import (
    READINGS,
    Atom,
    Claim,
    Clause,
    Comparison,
    Constant,
    Declaration,
    Effect,
    EventRelation,
    Formula,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    Number,
    Obligation,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Timing,
    Window,
)
from sleec_verify.conformance.vocabulary import formulas
from tests.support.dsl_strategies import comments

EVENTS = ("Fire", "Alarm", "Call")
CONDITIONS = ("Asleep", "Alone")
SCALE = ("low", "middle", "high")
DEFINITIONS: tuple[Statement, ...] = (
    Declaration("event", ("Fire", "Call"), agent="environment"),
    Declaration("event", ("Alarm",)),
    Declaration("condition", CONDITIONS),
    Measure("Patience", "integer"),
    Measure("Risk", "scale", SCALE),
    Constant("Soon", 5),
    Constant("Later", 5, "Soon"),
)
PHRASED: tuple[Statement, ...] = (
    Declaration("event", ("the fire starts",), agent="system"),
    Measure("waiting time", "integer"),
    Constant("a while", 20),
)
"""Names that the DSL has not."""

_units = st.sampled_from(("seconds", "minutes", "hours", "days"))
_relations = ("witness", "equal", "mutualExclusive", "happenBefore")


class Words:
    """What the parts of one ruleset are made of; with `phrases`, names may have several words."""

    def __init__(self, phrases: bool) -> None:
        self.events = st.sampled_from(EVENTS + ("the fire starts",) * phrases)
        amounts = [Number(1), Number(60), Number(5, "Soon"), Number(5, "Later"), MeasureRef("Patience")]
        if phrases:
            amounts += [Number(20, "a while"), MeasureRef("waiting time")]
        self.lengths = st.builds(Length, st.sampled_from(amounts), _units)
        self.windows = st.one_of(
            st.just(Window(None)),
            st.builds(Window, self.lengths),
            st.builds(Window, st.just(Length(Number(9), "days")), st.just(Length(Number(1), "seconds"))),
            st.builds(
                lambda amount, unit: Window(Length(amount, unit), Length(Number(0), unit)),
                st.sampled_from(amounts),
                _units,
            ),
        )
        leaf: st.SearchStrategy[Formula] = st.one_of(
            st.sampled_from(CONDITIONS).map(lambda name: Atom("condition", name)),
            st.just(Comparison(MeasureRef("Patience"), ">=", Number(5, "Soon"))),
            st.just(Comparison(MeasureRef("Risk"), "<", ScaleValue("high", 2))),
        )
        self.states = formulas(leaf)
        event = self.events.map(lambda name: Atom("trigger", name))
        self.conditions = formulas(st.one_of(leaf, leaf, event))


@st.composite
def obligations_of(draw, words, depth):
    """One obligation, maybe with a time and alternatives."""
    alternatives = st.none() | clauses(words, depth=depth - 1) if depth else st.none()
    timing = Timing(draw(st.none() | words.windows), draw(alternatives), draw(alternatives))
    return Obligation(draw(words.events), draw(st.booleans()), timing=None if timing == Timing() else timing)


@st.composite
def clauses(draw, words, condition=None, depth=2, chain=True):
    """A clause with responses, and with hedges of its own if `chain`."""
    several = draw(st.lists(obligations_of(words, depth), min_size=1, max_size=2 if depth else 1))
    hedges = draw(st.lists(hedges_of(words, depth - 1), max_size=2)) if chain and depth else []
    return Clause(condition, tuple(several), tuple(hedges))


@st.composite
def hedges_of(draw, words, depth):
    condition = draw(words.conditions)
    clause = draw(st.just(Clause(condition, ())) | clauses(words, condition, max(depth, 0)))
    return replace(clause, comments=draw(comments))


@st.composite
def claims_of(draw, words, kind, label, depth=1):
    responses = draw(st.lists(clauses(words, depth=1), max_size=2))
    meanwhile = draw(st.none() | claims_of(words, kind, "", depth - 1)) if depth else None
    condition = draw(st.none() | words.conditions)
    form = draw(st.sampled_from(("exists", "when")))
    own = {"comments": draw(comments)} if label else {}
    return Claim(kind, label, form, draw(words.events), condition, tuple(responses), meanwhile, **own)


def relations_of(words: Words) -> st.SearchStrategy[Any]:
    events, conditions = words.events, words.states
    return st.one_of(
        st.builds(EventRelation, st.sampled_from(_relations), events, events),
        st.builds(
            MeasureRelation, st.sampled_from(("imply", "iff", "mutualExclusive", "opposite")), conditions, conditions
        ),
        st.builds(MeasureRelation, st.just("invariant"), conditions),
        st.builds(Effect, st.sampled_from(("causation", "includes", "forbid")), events, conditions),
        st.builds(Lasting, events, st.none() | conditions, conditions, events, st.none() | conditions),
        st.builds(Lasting, events, st.none() | conditions, conditions, duration=words.lengths),
    )


@st.composite
def timed_rulesets(draw, phrases=True, readings=READINGS):
    """Whole texts: declarations, then rules, concerns, purposes and relations in any order."""
    words = Words(phrases)
    rules: list[Any] = []
    for number in range(draw(st.integers(1, 3))):
        hedges = tuple(draw(st.lists(hedges_of(words, 1), max_size=2)))
        guard, default, own = draw(st.none() | words.conditions), draw(clauses(words)), draw(comments)
        rules.append(Rule(f"R{number}", draw(words.events), guard, default, hedges, comments=own))
    claims = [draw(claims_of(words, "concern", f"c{n}")) for n in range(draw(st.integers(0, 2)))]
    claims += [draw(claims_of(words, "purpose", f"p{n}")) for n in range(draw(st.integers(0, 1)))]
    beside = [replace(r, comments=draw(comments)) for r in draw(st.lists(relations_of(words), max_size=3))]
    mixed = draw(st.permutations([*rules, *claims, *beside]))
    return Ruleset((*DEFINITIONS, *PHRASED * phrases, *mixed), reading=draw(st.sampled_from(readings)))
