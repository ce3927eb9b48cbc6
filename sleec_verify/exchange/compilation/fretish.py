"""Rules as sentences of FRETish, the requirements language of NASA's FRET (D. Giannakopoulou, T. Pressburger, A.
Mavridou, J. Schumann, "Automated formalization of structured natural language requirements", 2021).

A time point of FRET is one second. An event is a signal that is true at the seconds at which the event occurs.
Conditions and measures keep their values between two instants.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor
from typing import NamedTuple

from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Comparison,
    Formula,
    Length,
    MeasureRef,
    Not,
    Number,
    Or,
    Ruleset,
    ScaleValue,
    Statement,
    Term,
    Truth,
    leaves,
)
from sleec_verify.encoding.three_valued import value_of
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.temporal_logic import (
    AllOf,
    Always,
    Before,
    Bound,
    Eventually,
    Holds,
    Implies,
    OneOf,
    Temporal,
    WeakUntil,
    Window,
    claims_of,
    requirements,
)

_RESERVED = frozenset(
    re.findall(
        r"\w+",
        # prose: allow upon, because it is a word of FRET
        "after always and at before during eventually except false finally first for hour hours if "
        "immediately in init initially is last max microsecond microseconds millisecond milliseconds min "
        "minute minutes mod mode never next not occurred occurrence occurs of only or persisted persists "
        "prebool preint prereal previous probability robot same satisfy sec second seconds secs shall the "
        "then tick ticks timepoint true unless until upon when whenever where while with within xor a e f g h "
        "o s t u v x y z af ag ax bu ef eg ex si ui abf abg ebf ebg ftp",
    )
)
"""The words of the grammar and the names that FRET's formulas use, in lower case."""


class FretRequirement(NamedTuple):
    """The sentences for one clause, relation or constraint. Without sentences, `reason` says why there are none."""

    title: str
    statement: Statement
    sentences: tuple[str, ...]
    reason: str | None


class _NoTemplate(Exception):
    """FRETish has no sentence with this meaning."""


def as_fretish(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One sentence a line, below comments with its origin. Statements without a sentence are comments with the
    reason."""
    writer = FretWriter(ruleset, untimed)
    rows = []
    for requirement in writer.requirements():
        rows.append(f"# {requirement.title}" + (f": {requirement.reason}" if requirement.reason else ""))
        rows += requirement.sentences
    rows += (f"# {claim.kind} {claim.label}: not in FRETish: it is a question" for claim, _ in claims_of(ruleset))
    head = ["# one time point is one second; an event is a signal that is true when the event occurs"]
    head += (f"# {name} stands for: {meaning}" for meaning, name in writer.renamed())
    for measure in ruleset.measures.values():
        if measure.kind == "scale":
            ranks = ", ".join(f"{rank} = {value}" for rank, value in enumerate(measure.values))
            head.append(f"# {measure.name}: {ranks}")
    return "\n".join((*head, *rows)) + "\n"


class FretWriter:
    """Writes the sentences of a ruleset. `untimed` is the meaning of a response without a window."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at") -> None:
        self._ruleset = ruleset
        self._untimed = untimed
        self._names: dict[str, str] = {}

    def requirements(self) -> Iterator[FretRequirement]:
        """The requirements in the order of the text, each with its sentences or with the reason why it has none."""
        for title, statement, formula in requirements(self._ruleset, self._untimed):
            try:
                yield FretRequirement(title, statement, tuple(self._sentences(formula)), None)
            except _NoTemplate as problem:
                yield FretRequirement(title, statement, (), f"not in FRETish: {problem}")

    def renamed(self) -> list[tuple[str, str]]:
        """The names so far that are not the same in FRETish, each with its identifier there."""
        return [(meaning, name) for meaning, name in self._names.items() if meaning != name]

    def _sentences(self, formula: Temporal, when: Formula | None = None) -> Iterator[str]:
        if isinstance(formula, AllOf):
            for part in formula.parts:
                yield from self._sentences(part, when)
        elif isinstance(formula, Implies):
            yield from self._sentences(formula.consequence, formula.condition)
        elif isinstance(formula, Eventually):
            yield self._sentence(when, _timing(formula.window, "within", "eventually"), formula.part)
        elif isinstance(formula, Always):
            yield self._sentence(when, _timing(formula.window, "for", "always"), formula.part)
        elif isinstance(formula, Holds):
            _require_no_event_between_instants(formula.formula)
            yield self._sentence(when, "always", formula.formula)
        elif isinstance(formula, WeakUntil):
            yield self._sentence(when, self._lasting(formula), formula.part)
        elif isinstance(formula, Before):
            raise _NoTemplate("it requires an earlier event")
        else:
            yield self._sentence(when, "immediately", self._expression(formula))

    def _sentence(self, when: Formula | None, timing: str, response: Formula | str) -> str:
        text = response if isinstance(response, str) else self._state(response)
        start = "The" if when is None else f"Whenever {self._state(when)} the"
        return f"{start} robot shall {timing} satisfy {text}"

    def _lasting(self, formula: WeakUntil) -> str:
        if formula.end is not None:
            return f"until {self._state(formula.end)}"
        assert formula.duration is not None, "a condition lasts until an event, or for some time"
        # Not at the last second, which is not included.
        return _time("for", ceil(_seconds((formula.duration,))) - 1)

    def _expression(self, formula: Temporal) -> str:
        """A choice of responses. `occurs` and `persists` are the predicates of FRET for windows inside formulas."""
        if isinstance(formula, (AllOf, OneOf)):
            parts = [self._expression(part) for part in formula.parts]
            if not parts:
                return "true"
            return f"({(' & ' if isinstance(formula, AllOf) else ' | ').join(parts)})"
        if isinstance(formula, Implies):
            consequence = self._expression(formula.consequence)
            plain = formula.condition == Truth(True)
            return consequence if plain else f"({self._state(formula.condition)} -> {consequence})"
        assert isinstance(formula, (Eventually, Always)), "responses have no other formulas"
        last = _last_second(formula.window)
        if last is None:
            raise _NoTemplate("an alternative has no deadline")
        predicate = "occurs" if isinstance(formula, Eventually) else "persists"
        state = self._state(formula.part)
        return state if last == 0 else f"{predicate}({last}, {state})"

    def _state(self, formula: Formula) -> str:
        if isinstance(formula, Atom):
            return self._name(formula.name)
        if isinstance(formula, Truth):
            return "true" if formula.value else "false"
        if isinstance(formula, Not):
            return f"!{self._state(formula.operand)}"
        if isinstance(formula, (And, Or)):
            if not formula.operands:
                return "true" if isinstance(formula, And) else "false"
            sign = " & " if isinstance(formula, And) else " | "
            return f"({sign.join(map(self._state, formula.operands))})"
        assert isinstance(formula, Comparison)
        return f"({self._term(formula.left)} {formula.operator} {self._term(formula.right)})"

    def _term(self, term: Term) -> str:
        if isinstance(term, Number):
            return str(term.value)
        if isinstance(term, ScaleValue):
            return str(term.rank)
        if isinstance(term, Calculation):
            return term.written(self._name, str)
        assert isinstance(term, MeasureRef)
        return self._name(term.name)

    def _name(self, name: str) -> str:
        known = self._names.get(name)
        if known is None:
            plain = re.sub(r"[^a-zA-Z0-9_]", "_", name)
            if not plain[0].isalpha() or plain.lower() in _RESERVED:
                plain = f"is_{plain}"
            known, number, taken = plain, 2, set(self._names.values())
            while known in taken:
                known, number = f"{plain}_{number}", number + 1
            self._names[name] = known
        return known


def _require_no_event_between_instants(formula: Formula) -> None:
    """A formula that holds at every instant holds at every second if no event is necessary for it."""

    def without_events(leaf: Atom | Comparison) -> bool | None:
        return None if isinstance(leaf, Comparison) or leaf.kind == "condition" else False

    names_events = any(isinstance(leaf, Atom) and leaf.kind != "condition" for leaf in leaves(formula))
    if names_events and value_of(formula, without_events) is not True:
        raise _NoTemplate("it requires an event at each instant at which a condition is true")


def _timing(window: Window, bounded: str, unbounded: str) -> str:
    last = _last_second(window)
    return unbounded if last is None else _time(bounded, last)


def _time(word: str, seconds: int) -> str:
    """``within 5 seconds``. A duration in FRET is a positive number."""
    if seconds < 0:
        raise _NoTemplate("its window has no length")
    return "immediately" if seconds == 0 else f"{word} {seconds} second{'s' * (seconds != 1)}"


def _last_second(window: Window) -> int | None:
    """The last second of a window that opens at the trigger; None without an upper bound."""
    if ceil(_seconds(window.start)) > 0:
        raise _NoTemplate("a window opens after the trigger")
    if window.end is None:
        return None
    last = floor(_seconds(window.end))
    if last < 0:
        raise _NoTemplate("its window has no length")
    return last


def _seconds(bound: Bound) -> Fraction:
    return sum(map(_length, bound), Fraction(0))


def _length(length: Length) -> Fraction:
    if length.seconds is None:
        raise _NoTemplate("a measure gives the length of its window")
    return Fraction(length.seconds)
