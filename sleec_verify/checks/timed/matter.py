"""The rules and laws that an answer about traces rests on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sleec_runtime.model_time import RELATIONS
from sleec_verify.timed.program import Law, law_name
from sleec_verify.timed.traces import Traces

if TYPE_CHECKING:
    from sleec_verify.cone import Cones


def traces(cones: Cones) -> Traces:
    assert isinstance(cones, Traces), "the checks of rules with time are given traces"
    return cones


def in_words(cones: Traces, matter: Iterable[str]) -> list[str]:
    """Rules and laws as people call them."""
    matter = list(matter)
    laws = {law_name(law): words for words, law in laws_in(cones, matter)}
    return [laws.get(name, name) for name in matter]


def laws_in(cones: Traces, matter: Iterable[str]) -> list[tuple[str, Law]]:
    """The relations and constraints among what matters, each with what people call it, in the order of the text."""
    names = [name for name in matter if name not in cones.ruleset.by_label]
    laws = sorted((cones.program.law_named[name] for name in names), key=lambda law: law.span)
    source = cones.ruleset.source
    kinds = ("the relation" if isinstance(law, RELATIONS) else "the constraint" for law in laws)
    return [(f"{kind} in line {source.place(law.span).line}", law) for kind, law in zip(kinds, laws)]


def rules_in(cones: Traces, matter: Iterable[str], but: str | None = None) -> tuple[str, ...]:
    """The rules among what matters, in the order of the text."""
    rules = [cones.ruleset.by_label[name] for name in matter if name in cones.ruleset.by_label and name != but]
    return tuple(rule.label for rule in sorted(rules, key=lambda rule: rule.span))
