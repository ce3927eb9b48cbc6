"""What people ask of rules: situations and assertions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.language.source import source_of
from sleec_verify.assertions import Vocabulary, ask, read_assertions
from sleec_verify.entailment import entail
from sleec_verify.situation import parse_situation
from tests.fuzz.files import RULESET
from tests.fuzz.property import unless_refused


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
    source = unless_refused(source_of, "fuzz.txt", data)
    found = None if source is None else unless_refused(read_assertions, source, Vocabulary([RULESET]))
    for assertion in found or ():
        assert ask(RULESET, assertion)


def assertion_seeds() -> Iterator[bytes]:
    yield b"never Close when Ring and Age >= LegalAge # a comment\n"
    yield b"always Open, not Speak when (too warm or Risk < high) and not Steps = 3\n"
