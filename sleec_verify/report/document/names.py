"""The names of a ruleset, and the rules that use them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import Atom, Rule, Ruleset, formulas_of, leaves, literals, measures_of
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import kind_words


class UsedName(NamedTuple):
    """A name, its words and kind, and the labels of the rules that use it as this kind."""

    name: str
    words: str
    kind: str
    rules: tuple[str, ...]


def names(ruleset: Ruleset) -> Iterator[UsedName]:
    """Every name by kind: triggers, conditions, measures and obligations, each in the order of the alphabet.

    An event that rules require or forbid, and that triggers none, is not a trigger here.
    """
    users: dict[tuple[str, str], dict[str, None]] = {}
    for rule in ruleset.rules:
        for use in _uses(rule):
            users.setdefault(use, {})[rule.label] = None
    for kind, every in (
        ("trigger", ruleset.triggers),
        ("condition", ruleset.conditions),
        ("measure", frozenset(ruleset.measures)),
        ("obligation", ruleset.obligations),
    ):
        for name in sorted(every):
            if kind != "trigger" or (kind, name) in users or name not in ruleset.obligations:
                yield UsedName(name, spoken(name), kind_words(kind), tuple(users.get((kind, name), ())))


def _uses(rule: Rule) -> Iterator[tuple[str, str]]:
    yield "trigger", rule.trigger
    for formula in formulas_of(rule):
        for leaf in leaves(formula):
            if isinstance(leaf, Atom):
                yield leaf.kind, leaf.name
            else:
                yield from (("measure", name) for name in measures_of(leaf))
    for clause in rule.clauses():
        for one in literals(clause):
            yield "obligation", one.name
            window = None if one.timing is None else one.timing.window
            for length in () if window is None else (window.start, window.end):
                yield from (("measure", name) for name in (() if length is None else length.measures))
