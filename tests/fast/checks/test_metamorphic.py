"""Metamorphic tests of all checks: what a change of the rules must not change in the findings, word by word."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import NOWHERE
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding, Unknown
from tests.support.realistic_rules import peoples_rules
from tests.support.timed_english import timed_english, untimed_english
from tests.support.timed_strategies import timed_ruleset


class Said(NamedTuple):
    """What one check says: why it is undecided, if it is, and its findings, with the text of their places."""

    why: str | None
    findings: tuple[str, ...]


def said(text: str) -> dict[str, Said]:
    """What each check says about a text, without line numbers. A check that says nothing is left out."""
    found = {}
    for result in run_checks(parse(text)):
        why = result.verdict.why if isinstance(result.verdict, Unknown) else None
        findings = tuple(told(finding, text) for finding in result.findings)
        if why or findings:
            found[result.name] = Said(why and without_lines(why), findings)
    return found


def told(finding: Finding, text: str) -> str:
    """All that a finding says. Places count as the text that stands there."""
    source = finding.source.text if finding.source is not None else text
    places = [source[span.start : span.end] for span in (finding.span, *(span for span, _ in finding.related))]
    return without_lines(f"{places} {replace(finding, span=NOWHERE, related=related_words(finding), source=None)}")


def related_words(finding: Finding) -> Any:
    return tuple((NOWHERE, words) for _, words in finding.related)


def without_lines(text: str) -> str:
    return re.sub(r"line \d+", "line #", text)


def timed_dsl(seed: int) -> str:
    return timed_ruleset(seed, rules=3, events=3, longest=2, relations=1, hedges=1).source.text


def named_dsl(seed: int) -> str:
    return timed_ruleset(seed, rules=3, events=3, longest=2, relations=1, hedges=1, named=True).source.text


TEXTS: Mapping[str, Callable[[int], str]] = {
    "structured English": timed_english,
    "structured English without time": untimed_english,
    "the DSL": timed_dsl,
    "conditions that name events": named_dsl,
    "rules as people write them": peoples_rules,
}


def texts(few: int, many: int) -> pytest.MarkDecorator:
    """Some of the texts of each kind; many in the long run."""
    return pytest.mark.parametrize(
        ("kind", "seed"),
        [
            pytest.param(kind, seed, marks=[pytest.mark.long] if seed >= few else [])
            for kind in TEXTS
            for seed in range(many)
        ],
    )


# Fresh names ----------------------------------------------------------------------------------------------

FRESH = re.compile(r"\bZ\w+\b")

ENGLISH_ADDED = (
    "EVENT ZA, ZB\nRULE ZR1 WHEN ZA THEN ZB WITHIN 5 minutes\n",
    "EVENT ZA, ZB\nRULE ZR1 WHEN ZA THEN ZB\nRULE ZR2 WHEN ZA THEN NOT ZB\n",
    (
        "EVENT ZA, ZB, ZC\nCONDITION Zm\nRULE ZR1 WHEN ZA THEN ZB WITHIN 5 minutes UNLESS Zm IN WHICH CASE ZC\n"
        "RULE ZR2 WHEN ZB THEN ZC WITHIN 1 minute\nRULE ZR3 WHEN ZC THEN NOT ZB WITHIN 10 minutes\n"
    ),
    (
        "EVENT ZA, ZB\nCONDITION Zm, Zn\nRELATION ZA PRECEDES ZB\nRELATION WHEN ZA THEN Zm FOR 3 seconds\n"
        "RELATION ALWAYS Zm IMPLIES Zn\nCONCERN Zc1 EXISTS ZA WHILE NOT ZB\n"
    ),
)

CHAIN = (
    "R1 when ZA then ZB within 5 minutes unless {Zm} then ZC\n ZR2 when ZB then ZC within 1 minutes\n"
    " ZR3 when ZC then not ZB within 9 minutes"
)
RELATIONS = (
    "relation_start\n happenBefore ZA ZC\n when ZA then {Zm} for 3 seconds\n measure imply {Zm} {Zn}\nrelation_end\n"
    "concern_start\n Zc1 exists ZA while not ZB\nconcern_end\n"
)
DSL_ADDED = (
    ("R1 when ZA then ZB within 5 minutes", ""),
    ("R1 when ZA then ZB\n ZR2 when ZA then not ZB", ""),
    (CHAIN, ""),
    ("R1 when ZA then ZB within 1 minutes", RELATIONS),
)


def with_more(text: str, number: int) -> str:
    if "def_start" not in text:
        return text + ENGLISH_ADDED[number % len(ENGLISH_ADDED)]
    rules, rest = DSL_ADDED[number % len(DSL_ADDED)]
    names = "event ZA\nevent ZB\nevent ZC\nmeasure Zm: boolean\nmeasure Zn: boolean\n"
    return text.replace("def_end", f"{names}def_end").replace("rule_end", f" Z{rules}\nrule_end") + rest


def about_others(results: Mapping[str, Said]) -> dict[str, Said]:
    """What is said about the rules without fresh names."""
    kept = {
        name: one._replace(findings=tuple(f for f in one.findings if not FRESH.search(f)))
        for name, one in results.items()
    }
    return {name: one for name, one in kept.items() if one.why or one.findings}


@texts(6, 150)
def test_more_rules_claims_and_relations_over_fresh_names_change_nothing(kind: str, seed: int) -> None:
    text = TEXTS[kind](seed)
    assert about_others(said(with_more(text, seed))) == said(text)


DOOR = """EXCLUSIVE lock the door, open the door
RULE fire
WHEN the fire alarm rings THEN open the door
RULE stranger
WHEN a stranger comes THEN lock the door
RULE night
WHEN night falls THEN lock the door UNLESS a child is outside IN WHICH CASE open the door
"""


def test_one_more_rule_with_a_window_leaves_the_conflicts_of_the_others_as_they_are() -> None:
    more = f"{DOOR}RULE coffee\nWHEN coffee is ready THEN bring coffee WITHIN 5 minutes\n"
    assert len(said(DOOR)["conflict"].findings) == 3
    assert said(more)["conflict"] == said(DOOR)["conflict"]


# Names ----------------------------------------------------------------------------------------------------

NAMES = re.compile(r"\b(?:[A-DRXYZ]\d*|E\d|[mnxys]\d*|risk|[cp]1)\b")


def renamed(text: str) -> str:
    """The same with longer names, which have the same order."""
    return NAMES.sub(lambda name: f"{name[0]}q", text)


@texts(4, 100)
def test_other_names_change_only_names(kind: str, seed: int) -> None:
    text = TEXTS[kind](seed)
    expected = {
        name: Said(one.why and renamed(one.why), tuple(map(renamed, one.findings))) for name, one in said(text).items()
    }
    assert said(renamed(text)) == expected


# Order ----------------------------------------------------------------------------------------------------


def what(text: str) -> dict[str, list[Any]]:
    """What the findings are about, whatever their words and their order.

    Without conflicts of rules of which one is triggered only later. A smaller conflict found first can hide these."""
    return {
        result.name: [
            isinstance(result.verdict, Unknown),
            sorted(subject(finding) for finding in result.findings if not triggers_later(finding)),
        ]
        for result in run_checks(parse(text))
        if result.findings or isinstance(result.verdict, Unknown)
    }


def subject(finding: Finding) -> tuple[Any, ...]:
    """What a finding is about. Which of several sets of rules explains it can depend on their order."""
    rules = finding.rules
    if finding.check in ("vacuous-conflict", "redundant-rule", "redundant-hedge"):
        rules = rules[:1]
    elif finding.check in ("concern", "purpose"):
        rules = ()
    return finding.code, sorted(rules), sorted(finding.clauses)


def triggers_later(finding: Finding) -> bool:
    return finding.check == "conflict" and set(finding.rules) > {clause.rule for clause in finding.clauses}


def reordered(text: str) -> str:
    """The text with its rules from the last to the first."""
    rules = re.findall(r"(?m)^ *(?:RULE )?R\d+ +(?:WHEN|when).*\n", text)
    for number, rule in enumerate(rules):
        text = text.replace(rule, f"<{number}>")
    for number, rule in enumerate(reversed(rules)):
        text = text.replace(f"<{number}>", rule)
    return text


@texts(4, 100)
def test_the_order_of_rules_changes_only_the_order(kind: str, seed: int) -> None:
    text = TEXTS[kind](seed)
    assert what(reordered(text)) == what(text)


# Windows --------------------------------------------------------------------------------------------------


@texts(4, 100)
def test_longer_windows_in_proportion_change_no_verdict(kind: str, seed: int) -> None:
    """From a minute on: a window of a second has room for no instant between its ends. An answer may stay open."""
    text = TEXTS[kind](seed)
    short, long = (what(text.replace("seconds", unit)) for unit in ("minutes", "hours"))
    undecided = {name for name, (unknown, _) in (*short.items(), *long.items()) if unknown}
    assert {n: one for n, one in long.items() if n not in undecided} == {
        n: one for n, one in short.items() if n not in undecided
    }
