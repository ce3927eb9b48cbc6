"""Constructs of a ruleset that the runtime does not enforce. They are named when the rules are put in force."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator

from sleec_runtime.errors import NotEnforced, UnsupportedTimes
from sleec_runtime.model import (
    RELATIONS,
    Atom,
    Obligation,
    Rule,
    Ruleset,
    Span,
    formulas_of,
    leaves,
    literals,
    relation_name,
)
from sleec_runtime.support.messages import listed


def has_times(ruleset: Ruleset) -> bool:
    """Whether a response of the rules has a window or an alternative."""
    return any(
        obligation.timing is not None
        for rule in ruleset.rules
        for clause in rule.clauses()
        for obligation in clause.obligations
    )


def name_limits(ruleset: Ruleset, chains: bool, strict: bool) -> None:
    """Issues a NotEnforced warning for constructs that the runtime does not enforce; if `strict`, raises
    UnsupportedTimes instead.

    O(size of the rules).
    """
    found = [(name, ruleset.source.place(span).line) for name, span in not_enforced(ruleset, chains)]
    if not found:
        return
    message = "the runtime does not enforce: " + listed([f"{name}, line {line}" for name, line in found], "; ")
    if strict:
        raise UnsupportedTimes(
            message,
            [line for _, line in found],
            "leave them out, or load the ruleset without strict_times and enforce them yourself",
        )
    warnings.warn(NotEnforced(message, found), stacklevel=_outside())


def _outside() -> int:
    """The stack level of the code that uses the runtime, to which a warning should point."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "sleec_runtime":
        level, frame = level + 1, frame.f_back
    return level


def not_enforced(ruleset: Ruleset, chains: bool) -> Iterator[tuple[str, Span]]:
    """The constructs that the runtime does not enforce, each with its place, in text order."""
    triggers = {rule.trigger for rule in ruleset.rules} if has_times(ruleset) and not chains else set()
    done = {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause) if not o.negated}
    for statement in ruleset.statements:
        if isinstance(statement, RELATIONS):
            yield f"the relation {relation_name(statement)}", statement.span
        elif isinstance(statement, Rule):
            for leaf in (leaf for formula in formulas_of(statement) for leaf in leaves(formula)):
                if isinstance(leaf, Atom) and leaf.kind == "trigger" and leaf.name in done:
                    yield f"conditions of `{statement.label}` on `{leaf.name}` as a response", leaf.span
            for clause in statement.clauses():
                for obligation in literals(clause):
                    yield from _limits(obligation)
                    if not obligation.negated and obligation.name in triggers:
                        what = f"rules that `{obligation.name}` triggers as a response (chains=True enforces them)"
                        yield what, obligation.span


def _limits(obligation: Obligation) -> Iterator[tuple[str, Span]]:
    window = None if obligation.timing is None else obligation.timing.window
    if window is None:
        return
    if window.end is None and not obligation.negated:
        yield f"`{obligation.name}` eventually (it is started, without a deadline)", window.span
    for length in (window.start, window.end):
        for name in length.measures if length is not None else ():
            yield f"a window of length `{name}` while `{name}` has no value", window.span
