"""Big and deep texts: linear time, and never a crash."""

from __future__ import annotations

import time

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import And, Obligation
from tests.support.growth import grows_in_proportion


def many_rules(count: int) -> str:
    return "\n\n".join(
        f"RULE r{i}\nWHEN Trigger{i} THEN Do{i}\nUNLESS CondA{i} IN WHICH CASE (Other{i} AND Explain{i})\n"
        f"UNLESS CondB{i} AND x < 5 IN WHICH CASE Foo{i}\nUNLESS CondC{i} IN WHICH CASE Bar{i}"
        for i in range(count)
    )


@pytest.mark.speed
def test_time_grows_with_the_number_of_rules() -> None:
    small, large = many_rules(400), many_rules(4000)
    assert grows_in_proportion(lambda: parse(small), lambda: parse(large), 10)


def complaint(text: str) -> LanguageError:
    """The error that `text` gives. The bound on its time is for quadratic growth, not for slow machines."""
    start = time.perf_counter()
    with pytest.raises(LanguageError) as caught:
        parse(text)
    assert time.perf_counter() - start < 60
    assert len(str(caught.value)) < 100_000
    return caught.value


@pytest.mark.parametrize("count", [101, 5000, 1_000_000])
@pytest.mark.parametrize(
    ("before", "deep"), [("WHEN T THEN O UNLESS ", "("), ("WHEN T THEN O UNLESS ", "NOT "), ("WHEN T THEN ", "(")]
)
def test_too_deep(before: str, deep: str, count: int) -> None:
    (problem,) = complaint(before + deep * count + "a" + (")" * count if deep == "(" else "")).problems
    assert "nested too deeply" in problem.message


def test_deep_enough() -> None:
    deep = "(" * 99 + "a OR b" + ")" * 99
    (rule,) = parse(
        f"WHEN T AND c AND {deep} THEN O UNLESS {'NOT ' * 100} a IN WHICH CASE {'(' * 100}P{')' * 100}"
    ).rules
    assert rule.hedges[0].obligations == (Obligation("P"),)


def test_deep_chains_print_and_parse() -> None:
    levels = 99
    text = "WHEN T THEN O UNLESS c IN WHICH CASE " + "(P UNLESS c IN WHICH CASE " * levels + "P AND Q" + ")" * levels
    ruleset = parse(text)
    assert parse(print_ruleset(ruleset)) == ruleset
    complaint(text.replace("P AND Q", "(P UNLESS c IN WHICH CASE P AND Q)"))


def test_long_conjunctions() -> None:
    (rule,) = parse("WHEN T THEN O UNLESS " + " AND ".join(f"c{i}" for i in range(10_000))).rules
    assert isinstance(rule.hedges[0].condition, And)
    assert len(rule.hedges[0].condition.operands) == 10_000


@pytest.mark.parametrize(
    "line",
    [
        "x" * 10_000_000,
        "x " * 1_000_000,
        " " * 10_000_000,
        "$" * 1_000_000,
        "1" * 10_000_000,
        "a." * 5_000_000,
        "a-" * 5_000_000,
        "WHEN T THEN O " * 20_000 + "(",
        "UNLESS " * 100_000,
        ") " * 300_000,
        "IN\n" * 300_000,
    ],
    ids=lambda line: repr(line[:4]),
)
def test_huge_lines_are_refused_in_few_words(line: str) -> None:
    complaint("WHEN T THEN O UNLESS " + line + "\x00")


def test_many_mistakes_are_counted() -> None:
    problems = complaint("WHEN T\n" * 1000).problems
    assert len(problems) == 101
    assert problems[-1].message == "and 900 more problems"


def test_many_unknown_names_are_reported_soon() -> None:
    names = ", ".join(f"Condition{i}" for i in range(20_000))
    rules = "\n".join(f"WHEN T THEN O UNLESS Condition{i}x" for i in range(20_000))
    assert len(complaint(f"CONDITION {names}\n{rules}").problems) == 101


def test_garbage_collection_is_left_as_it_was() -> None:
    import gc

    gc.disable()
    try:
        parse("WHEN A THEN B")
        assert not gc.isenabled()
    finally:
        gc.enable()
    with pytest.raises(LanguageError):
        parse("WHEN")
    assert gc.isenabled()
