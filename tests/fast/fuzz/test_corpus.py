"""The kept inputs of the fuzzer, run once each, and that what breaks a property fails."""

from __future__ import annotations

from itertools import count
from pathlib import Path

import pytest

from sleec_runtime.errors import LanguageError, Problem, SleecError
from sleec_runtime.model import Source, Span
from tests.fuzz import property as fuzz_property
from tests.fuzz.property import TooSlow, check_error, cpu_limit, unless_refused
from tests.fuzz.targets import CORPUS, TARGETS, corpus, run

MAX_CORPUS_BYTES = 300_000


@pytest.mark.parametrize("name", TARGETS)
def test_properties_hold_of_seeds_and_corpus(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    errors: list[SleecError] = []

    def count_error(error: SleecError) -> None:
        errors.append(error)
        check_error(error)

    monkeypatch.setattr(fuzz_property, "check_error", count_error)
    for path in corpus(name):
        try:
            run(TARGETS[name], path.read_bytes(), tmp_path)
        except BaseException as error:
            raise AssertionError(f"python -m tests.fuzz.replay {name} {path}") from error
    refused = []
    for data in TARGETS[name].seeds():
        errors.clear()
        run(TARGETS[name], data, tmp_path)
        refused.append(bool(errors))
    assert not all(refused), "a fuzzer that starts from errors finds errors only"


def test_corpus_is_small() -> None:
    assert sum(path.stat().st_size for path in CORPUS.rglob("*") if path.is_file()) < MAX_CORPUS_BYTES


def test_corpus_belongs_to_targets() -> None:
    assert {path.name for path in CORPUS.iterdir()} <= TARGETS.keys()


def test_inputs_that_take_long_fail() -> None:
    with pytest.raises(TooSlow), cpu_limit(0.05):
        sum(1 for _ in count())


def test_typed_errors_are_no_failure_and_others_are() -> None:
    def refuse(error: Exception) -> None:
        raise error

    assert unless_refused(refuse, SleecError("it is wrong", "mend it")) is None
    with pytest.raises(ValueError, match="untyped"):
        unless_refused(refuse, ValueError("untyped"))


@pytest.mark.parametrize(
    "error",
    [
        SleecError(" "),
        SleecError("wrong", ""),
        LanguageError(Source("a.sleec", "WHEN"), []),
        LanguageError(Source("a.sleec", "WHEN"), [Problem("wrong", Span(2, 5))]),
        LanguageError(Source("a.sleec", "WHEN"), [Problem("x" * 2000, Span(0, 4))]),
    ],
)
def test_errors_that_help_nobody_fail(error: SleecError) -> None:
    with pytest.raises(AssertionError):
        check_error(error)
