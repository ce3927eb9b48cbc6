"""Metric temporal logic as text and as LaTeX: `G` always, `F` at some time, `W` weak until, `O` earlier.

Windows are in seconds, from the instant of the operator on. A length that a measure gives is written as a product.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Number,
    Or,
    Ruleset,
    Term,
    Truth,
)
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.symbols import bound_text, escaped
from sleec_verify.exchange.compilation.temporal_logic import (
    AllOf,
    Always,
    Before,
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


class Notation(NamedTuple):
    """The symbols of one form."""

    negation: str
    conjunction: str
    disjunction: str
    implication: str
    true: str
    false: str
    always: str
    eventually: str
    earlier: str
    until: str
    infinity: str
    open_interval: tuple[str, str]
    half_open: tuple[str, str]
    operators: dict[str, str]
    name: str
    """A format for names."""


_WORDS = {"G", "F", "O", "W", "true", "false", "inf"}
"""Words of the text form: names that are such a word, or no identifier, are quoted."""

TEXT = Notation("!", " & ", " | ", " -> ", "true", "false", "G", "F", "O", "W", "inf", ("[", "]"), ("[", ")"), {}, "{}")
LATEX = Notation(
    r"\lnot ",
    r" \land ",
    r" \lor ",
    r" \rightarrow ",
    r"\top",
    r"\bot",
    r"\Box",
    r"\Diamond",
    r"\blacklozenge",
    r"\mathbin{\mathcal{W}}",
    r"\infty",
    ("_{[", "]}"),
    ("_{[", ")}"),
    {"<=": r"\leq", ">=": r"\geq", "!=": r"\neq"},
    r"\mathit{{{}}}",
)


class _Writer:
    def __init__(self, notation: Notation) -> None:
        self.notation = self._n = notation

    def temporal(self, formula: Temporal, inside: bool = False) -> str:
        """The formula as text; `inside` another one, with parentheses where it needs them."""
        n = self._n
        if isinstance(formula, Holds):
            return self.state(formula.formula, inside)
        if isinstance(formula, (AllOf, OneOf)):
            sign = n.conjunction if isinstance(formula, AllOf) else n.disjunction
            return self._joined([self.temporal(part, True) for part in formula.parts], sign, inside)
        if isinstance(formula, Implies):
            if formula.condition == Truth(True):
                return self.temporal(formula.consequence, inside)
            parts = [self.state(formula.condition, True), self.temporal(formula.consequence, True)]
            return self._joined(parts, n.implication, inside)
        if isinstance(formula, (Eventually, Always)):
            if formula.window.is_now:
                return self.state(formula.part, True)
            sign = n.eventually if isinstance(formula, Eventually) else n.always
            return f"{sign}{self._window(formula.window)} {self.state(formula.part, True)}"
        if isinstance(formula, Before):
            return f"{n.earlier} {self.state(formula.part, True)}"
        return self._weak_until(formula, inside)

    def _weak_until(self, formula: WeakUntil, inside: bool) -> str:
        n = self._n
        interval = ""
        if formula.duration is not None:
            interval = f"{n.half_open[0]}0,{bound_text((formula.duration,), self._term)}{n.half_open[1]}"
        if formula.end is None:
            return f"{n.always}{interval} {self.state(formula.part, True)}"
        parts = [self.state(formula.part, True), self.state(formula.end, True)]
        return self._joined(parts, f" {n.until}{interval} ", inside)

    def _window(self, window: Window) -> str:
        if window.start == () and window.end is None:
            return ""
        end = self._n.infinity if window.end is None else bound_text(window.end, self._term)
        left, right = self._n.half_open if window.end is None else self._n.open_interval
        return f"{left}{bound_text(window.start, self._term)},{end}{right}"

    def state(self, formula: Formula, inside: bool) -> str:
        """A formula over one instant."""
        n = self._n
        if isinstance(formula, Atom):
            return self._name(formula.name)
        if isinstance(formula, Truth):
            return n.true if formula.value else n.false
        if isinstance(formula, Not):
            if isinstance(formula.operand, Not):
                return self.state(formula.operand.operand, inside)
            return f"{n.negation}{self.state(formula.operand, True)}"
        if isinstance(formula, (And, Or)):
            sign = n.conjunction if isinstance(formula, And) else n.disjunction
            return self._joined([self.state(operand, True) for operand in formula.operands], sign, inside)
        assert isinstance(formula, Comparison)
        operator = n.operators.get(formula.operator, formula.operator)
        return f"({self._term(formula.left)} {operator} {self._term(formula.right)})"

    def _term(self, term: Term) -> str:
        if isinstance(term, Number):
            return str(term.value)
        if isinstance(term, Calculation):
            return f"({term})" if self._n is TEXT else f"({self._name(str(term))})"
        return self._name(term.name if isinstance(term, MeasureRef) else term.value)

    def _name(self, name: str) -> str:
        if self._n is TEXT:
            return name if name.isidentifier() and name not in _WORDS else f'"{name}"'
        return self._n.name.format(escaped(name))

    def _joined(self, parts: Sequence[str], sign: str, inside: bool) -> str:
        if not parts:
            return self._n.true
        if len(parts) == 1:
            return parts[0]
        return f"({sign.join(parts)})" if inside else sign.join(parts)


def as_mtl(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One formula a line, each under a comment with its statement."""
    return "".join(f"# {title}\n{formula}\n" for title, formula in _lines(ruleset, untimed, _Writer(TEXT)))


def as_mtl_latex(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One aligned block, a line for each formula, for a document that loads amsmath and amssymb."""
    rows = [
        rf"  & {formula} && \text{{{escaped(title)}}} \\" for title, formula in _lines(ruleset, untimed, _Writer(LATEX))
    ]
    return "\n".join((r"\begin{align*}", *rows, r"\end{align*}")) + "\n"


def _lines(ruleset: Ruleset, untimed: Untimed, writer: _Writer) -> Iterator[tuple[str, str]]:
    notation = writer.notation
    for title, _, formula in requirements(ruleset, untimed):
        yield title, f"{notation.always} {writer.temporal(formula, True)}"
    for claim, parts in claims_of(ruleset, untimed):
        found = [f"{notation.eventually} {writer.temporal(part, True)}" for part in parts]
        yield f"{claim.kind} {claim.label}: it occurs in a trace if", notation.conjunction.join(found)
