"""What people ask of rules: situations and assertions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from sleec_runtime.language.common.source import decode_source
from sleec_runtime.model import Context
from sleec_verify.changes.assertions.parser import parse_assertions
from sleec_verify.changes.assertions.verification import verify
from sleec_verify.changes.assertions.vocabulary import Vocabulary
from sleec_verify.entailment.consequence_tree import chain
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.schedule import schedule
from sleec_verify.entailment.situation_text import parse_situation
from sleec_verify.report.entailment import RENDERERS
from sleec_verify.report.explanation import render as explanation
from sleec_verify.report.palette import PLAIN
from tests.fuzz.files import RULESET
from tests.fuzz.property import unless_refused
from tests.fuzz.rules import read


def entailment(data: bytes, folder: Path) -> None:
    """What any rules oblige when everything occurs, and why, can be shown."""
    ruleset = read(data)
    if ruleset is None:
        return
    for value in (False, True):
        context = Context(ruleset.triggers, dict.fromkeys(ruleset.conditions, value))
        answer = unless_refused(entail, ruleset, context)
        if answer is None:
            return
        steps, at_odds = chain(ruleset, context, answer)
        answer = replace(answer, chain=steps, at_odds=at_odds)
        answer = replace(answer, schedule=schedule(ruleset, context, answer, "at"))
        for render in (*RENDERERS.values(), explanation):
            "".join(render(ruleset, context, answer, PLAIN))


def situation(data: bytes, folder: Path) -> None:
    """The first line is what occurs, the others what is given."""
    when, _, given = data.decode(errors="replace").partition("\n")
    context = unless_refused(parse_situation, RULESET, when, given)
    if context is not None:
        assert unless_refused(entail, RULESET, context) is not None


def situation_seeds() -> Iterator[bytes]:
    yield b"Ring, the night begins\nAsleep, not too warm, Age=17.5, Steps=3, Risk=middle"


def assertions(data: bytes, folder: Path) -> None:
    """Each assertion that is read has an answer."""
    source = unless_refused(decode_source, "fuzz.txt", data)
    found = None if source is None else unless_refused(parse_assertions, source, Vocabulary([RULESET]))
    for assertion in found or ():
        assert verify(RULESET, assertion)


def assertion_seeds() -> Iterator[bytes]:
    yield b"never Close when Ring and Age >= LegalAge # a comment\n"
    yield b"always Open, not Speak when (too warm or Risk < high) and not Steps = 3\n"
