"""Random rulesets in the DSL, with times, concerns, purposes and relations, as values."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from sleec_runtime.model import (
    And,
    Atom,
    Claim,
    Clause,
    Comments,
    Comparison,
    Constant,
    Declaration,
    Effect,
    EventRelation,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Timing,
    Truth,
    Window,
)

EVENTS = ("A", "B", "C")
BOOLEANS = ("m", "n")
SCALE = ("low", "middle", "high")
DEFINITIONS: tuple[Statement, ...] = (
    Declaration("event", ("A",)),
    Declaration("event", ("B",), agent="system"),
    Declaration("event", ("C",), agent="environment"),
    *(Declaration("condition", (name,)) for name in BOOLEANS),
    Measure("x", "integer"),
    Measure("risk", "scale", SCALE),
    Constant("K", 5),
    Constant("L", 5, "K"),
)

events = st.sampled_from(EVENTS)
remarks = st.text("abc /", max_size=5).map(str.strip).filter(bool)
comments = st.builds(Comments, st.lists(remarks, max_size=2).map(tuple), st.none() | remarks)
_operators = st.sampled_from(("<", "<=", "=", "!=", ">=", ">"))
_numbers = st.sampled_from((Number(-2), Number(7), Number(5, "K"), Number(5, "L")))
_leaves = st.one_of(
    st.sampled_from(BOOLEANS).map(lambda name: Atom("condition", name)),
    st.booleans().map(Truth),
    st.builds(Comparison, st.just(MeasureRef("x")), _operators, _numbers),
    st.builds(Comparison, st.just(ScaleValue("middle", 1)), _operators, st.just(MeasureRef("risk"))),
)


def _chain(kind):
    """As LEGOS writes them: the last operand of a chain is none of the same kind."""
    return lambda operands: kind((*operands[:-1], *_spliced(kind, operands[-1])))


def _spliced(kind, last):
    return last.operands if isinstance(last, kind) else (last,)


def _formulas(leaves):
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            inner.map(Not),
            st.lists(inner, min_size=2, max_size=3).map(_chain(And)),
            st.lists(inner, min_size=2, max_size=3).map(_chain(Or)),
        ),
        max_leaves=5,
    )


states = _formulas(_leaves)
"""What relations say of conditions and measures; rules and claims may name events besides."""
conditions = _formulas(st.one_of(_leaves, events.map(lambda name: Atom("trigger", name))))
_units = st.sampled_from(("seconds", "minutes", "hours", "days"))
_amounts = st.sampled_from((Number(1), Number(60), Number(5, "K"), MeasureRef("x")))
lengths = st.builds(Length, _amounts, _units)
windows = st.one_of(
    st.just(Window(None)),
    st.builds(Window, lengths),
    st.builds(Window, st.just(Length(Number(9), "days")), st.just(Length(Number(1), "seconds"))),
)


@st.composite
def clauses(draw, condition=None, depth=2, hedged=True):
    """A clause with one response, maybe with times, and with hedges of its own."""
    otherwise = draw(st.none() | clauses(depth=depth - 1)) if depth else None
    instead = draw(st.none() | clauses(depth=depth - 1)) if depth else None
    timing = Timing(draw(st.none() | windows), otherwise, instead)
    obligation = Obligation(draw(events), draw(st.booleans()), timing=None if timing == Timing() else timing)
    hedges = draw(st.lists(hedges_of(depth - 1), max_size=2)) if depth and hedged else []
    return Clause(condition, (obligation,), tuple(hedges))


@st.composite
def hedges_of(draw, depth):
    condition = draw(conditions)
    clause = draw(st.just(Clause(condition, ())) | clauses(condition, max(depth, 0)))
    return replace(clause, comments=draw(comments))


@st.composite
def claims_of(draw, kind, label, depth=1):
    responses = draw(st.lists(clauses(depth=1), max_size=2))
    meanwhile = draw(st.none() | claims_of(kind, "", depth - 1)) if depth else None
    form = draw(st.sampled_from(("exists", "when")))
    if form == "when" and not responses:
        responses = [Clause(None, (Obligation("A"),))]
    own = draw(comments) if label else Comments()
    return Claim(
        kind, label, form, draw(events), draw(st.none() | conditions), tuple(responses), meanwhile, comments=own
    )


relations: st.SearchStrategy[Any] = st.one_of(
    st.builds(EventRelation, st.sampled_from(("witness", "equal", "mutualExclusive", "happenBefore")), events, events),
    st.builds(MeasureRelation, st.sampled_from(("imply", "iff", "mutualExclusive", "opposite")), states, states),
    st.builds(MeasureRelation, st.just("invariant"), states),
    st.builds(Effect, st.sampled_from(("causation", "includes", "forbid")), events, states),
    st.builds(Lasting, events, st.none() | states, states, events, st.none() | states),
    st.builds(Lasting, events, st.none() | states, states, duration=lengths),
)


@st.composite
def dsl_rulesets(draw):
    """Whole texts: definitions, rules, and whatever else, in blocks."""
    rules = []
    for number in range(draw(st.integers(1, 3))):
        hedges = tuple(draw(st.lists(hedges_of(1), max_size=3)))
        rules.append(
            Rule(
                f"R{number}",
                draw(events),
                draw(st.none() | conditions),
                draw(clauses()),
                hedges,
                comments=draw(comments),
            )
        )
    concerns = [draw(claims_of("concern", f"c{n}")) for n in range(draw(st.integers(0, 2)))]
    purposes = [draw(claims_of("purpose", f"p{n}")) for n in range(draw(st.integers(0, 1)))]
    beside: list[Any] = [replace(r, comments=draw(comments)) for r in draw(st.lists(relations, max_size=3))]
    return Ruleset(
        (*DEFINITIONS, *rules, *concerns, *purposes, *beside), reading="priority", syntax="dsl", dialect="legos"
    )
