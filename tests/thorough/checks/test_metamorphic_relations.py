"""Names, order, and relations about other things do not change what is dead, redundant, vacuous, or a claim."""

from __future__ import annotations

import random
import re

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Unknown

CHECKS = (
    "dead-rule",
    "dead-hedge",
    "redundant-rule",
    "redundant-hedge",
    "vacuous-conflict",
    "concern",
    "purpose",
    "required-input",
    "forbidden-input",
)
EVENTS = ("anna", "bert", "carl", "dora", "emil")
LAWS = (
    "RELATION anna EXCLUDES carl",
    "RELATION dora FORBIDS night",
    "RELATION ALWAYS night IMPLIES heat > 3",
    "RELATION anna WITNESSES bert",
    "EXCLUSIVE carl, dora",
    "NEVER emil AND night",
    "ASSUME NOT (anna AND bert)",
    "ASSUME heat >= 0",
)
UNRELATED = ("RELATION Zoo EXCLUDES Zebra", "ASSUME snow OR NOT snow", "RELATION ALWAYS snow IMPLIES snow")


def statements(seed: int) -> list[str]:
    """Rules over few events, claims, and laws that exclude some of their situations."""
    chance = random.Random(seed)
    conditions = ("night", "NOT night", "heat > 5", "heat < 3", "anna", "carl", "day")

    def response() -> str:
        window = chance.choice(("", "", " WITHIN 2 minutes", " WITHIN 5 minutes"))
        return f"{'NOT ' if chance.random() < 0.3 else ''}{chance.choice(EVENTS[2:])}{window}"

    found = ["CONDITION night, day, snow", "MEASURE heat: number", "EVENT Zoo, Zebra", f"EVENT {', '.join(EVENTS)}"]
    found += chance.sample(LAWS, chance.randint(1, 3))
    for number in range(4):
        rule = f"RULE r{number} WHEN {chance.choice(EVENTS[:3])}"
        rule += f" AND {chance.choice(conditions)}" if chance.random() < 0.5 else ""
        rule += f" THEN {response()}"
        rule += f" UNLESS {chance.choice(conditions)} IN WHICH CASE ({response()})" if chance.random() < 0.5 else ""
        found.append(rule)
    found.append(f"CONCERN worry EXISTS {chance.choice(EVENTS)} WHILE {chance.choice(EVENTS)}")
    found.append(f"PURPOSE wish EXISTS {chance.choice(EVENTS)} WHILE {chance.choice(EVENTS)}")
    return found


def verdicts(lines: list[str], back: dict[str, str] | None = None) -> dict[str, set[tuple[object, ...]] | None]:
    """What each check finds, by rule, clause and obligation. None if it is undecided."""
    found: dict[str, set[tuple[object, ...]] | None] = {}
    for result in run_checks(parse("\n".join(lines) + "\n"), CHECKS):
        names = back or {}
        found[result.name] = {
            (f.code, f.rules[:1], f.clauses, tuple(sorted(names.get(o, o) for o in f.obligations)))
            for f in result.findings
            if f.rules or f.obligations
        }
        if result.name in ("concern", "purpose"):
            found[result.name] = {(f.code, f.obligations) for f in result.findings}
        if isinstance(result.verdict, Unknown):
            found[result.name] = None
    return found


SEEDS = [pytest.param(seed, marks=[pytest.mark.long] if seed >= 12 else []) for seed in range(150)]


@pytest.mark.parametrize("seed", SEEDS)
def test_what_has_nothing_to_do_with_rules_changes_nothing(seed: int) -> None:
    lines = statements(seed)
    before = verdicts(lines)
    for more in UNRELATED:
        assert verdicts([*lines, more]) == before, more


@pytest.mark.parametrize("seed", SEEDS)
def test_order_changes_nothing(seed: int) -> None:
    lines = statements(seed)
    head, tail = lines[:4], lines[4:]
    random.Random(seed).shuffle(tail)
    assert verdicts([*head, *tail]) == verdicts(lines)


@pytest.mark.parametrize("seed", SEEDS)
def test_names_change_nothing(seed: int) -> None:
    lines = statements(seed)
    new = dict(zip(EVENTS, ("zeta", "yara", "xeno", "wilma", "vera")))
    renamed = [re.sub(r"\b(\w+)\b", lambda m: new.get(m.group(1), m.group(1)), line) for line in lines]
    assert verdicts(renamed, {new: old for old, new in new.items()}) == verdicts(lines)
