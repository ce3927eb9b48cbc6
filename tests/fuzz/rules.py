"""Texts of rules: structured English and the DSL, what `fmt` and `convert` make of them, and what `check` finds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING
from unittest.mock import patch
from zlib import crc32

from sleec_runtime.evaluation.due import due
from sleec_runtime.language import parse, parse_source, print_ruleset
from sleec_runtime.language.common.source import decode_source
from sleec_runtime.language.dsl.scanner import scan as scan_dsl
from sleec_runtime.language.english.scanner import scan
from sleec_runtime.model import Context
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.encoding.budget import for_file
from sleec_verify.encoding.trace_scope import speaks_of_traces
from sleec_verify.entailment.entailment import entail
from sleec_verify.exchange.compilation import FORMS, compile_to
from sleec_verify.exchange.conversion import TARGETS, convert, of_domain
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.finding import Unknown
from sleec_verify.results.suppressions import suppressions
from tests.fuzz.property import unless_refused

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Syntax


def read(data: bytes) -> Ruleset | None:
    """The ruleset that these bytes are, None where they are refused."""
    try:
        data.decode()
    except UnicodeDecodeError:
        unless_refused(decode_source, "fuzz.sleec", data)
        # So that one broken character does not make an input useless.
        data = data.decode(errors="replace").encode()
    source = unless_refused(decode_source, "fuzz.sleec", data)
    return None if source is None else unless_refused(parse_source, source)


def language(data: bytes, folder: Path) -> None:
    """What is read prints, with its comments, and is read again as the same; what is converted obliges the same."""
    ruleset = read(data)
    if ruleset is None:
        return
    printed = print_ruleset(ruleset)
    again = parse(printed)
    assert again == ruleset
    assert print_ruleset(again) == printed
    assert comments(printed, ruleset.syntax) == comments(ruleset.source.text, ruleset.syntax)
    suppressions(ruleset, CHECKS)
    for to in TARGETS:
        converted = unless_refused(convert, ruleset, to)
        if converted is not None and not (ruleset.is_timed or converted.ruleset.is_timed):
            assert_oblige_the_same(ruleset, converted.ruleset)
    for domain in ruleset.domains:
        part = unless_refused(of_domain, ruleset, domain)
        if part is not None:
            assert_oblige_the_same(part, convert(part, "english", "priority").ruleset)


def comments(text: str, syntax: Syntax) -> Counter[str]:
    """The comments of a text, whose blanks do not count."""
    tokens = scan_dsl(text) if syntax == "dsl" else scan(text)
    found = [one for each in tokens.comments.values() for one in (*each.above, each.behind or "")]
    return Counter(words for one in (*found, *tokens.closing) if (words := " ".join(one.split())))


def assert_oblige_the_same(one: Ruleset, other: Ruleset) -> None:
    """Both oblige the same in two situations: all conditions false, and all true."""
    for value in (False, True):
        context = Context(one.triggers, dict.fromkeys(one.conditions, value))
        before, after = due(one, context), due(other, context)
        assert set(before.obligations) == set(after.obligations)
        assert set(before.prohibitions) == set(after.prohibitions)


@contextmanager
def little_budget(data: bytes) -> Iterator[None]:
    """Let the work inside take few steps; how many depends on the input, and any number may be the one that fails."""
    with patch("sleec_verify.encoding.budget.FILE", crc32(data) % 30_000), for_file(0):
        yield


def check(data: bytes, folder: Path) -> None:
    """Rules are compiled. Those without times are checked and asked, and every format shows what came of it."""
    ruleset = read(data)
    if ruleset is None:
        return
    for form in FORMS:
        unless_refused(compile_to, ruleset, form)
    if speaks_of_traces(ruleset):
        return
    outcome = CheckedRuleset(ruleset, run_checks(ruleset))
    with little_budget(data):
        for little, result in zip(run_checks(ruleset), outcome.results, strict=True):
            # Less work never gives another answer, only none.
            assert isinstance(little.verdict, (Unknown, type(result.verdict)))
    for form in FORMATS:
        assert "".join(renderer(form)([outcome], PLAIN))
    context = Context(ruleset.triggers, dict.fromkeys(ruleset.conditions, True))
    answer = unless_refused(entail, ruleset, context)
    if answer is not None and answer.consistent:
        # Two roads to the same answer: by a solver, and by evaluation.
        assert set(answer.obligations) == set(due(ruleset, context).obligations)
