"""The findings of the checks, tied to the rules by the theory: what a check finds is proved, and nothing else is."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest
from hypothesis import HealthCheck, given, settings

from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import parse
from sleec_runtime.model import NOWHERE, Ruleset
from sleec_verify.certificates import verdict_binding as tying
from sleec_verify.certificates.manifest import Evidence
from sleec_verify.certificates.theory.findings import FOUND, questions
from sleec_verify.certificates.theory.oracle import NotRefuted, answers
from sleec_verify.certificates.theory.theory_questions import Theory, not_modelled
from sleec_verify.certificates.verdict_binding import UnboundVerdict, VerdictBinding, bind_verdicts
from sleec_verify.checks import CHECKS, Check, run_checks
from sleec_verify.checks.dead import DEAD_RULE
from sleec_verify.cli import run
from sleec_verify.conformance.rulesets import rulesets
from sleec_verify.query.question import is_possible
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from tests.support.theory_cases import random_cases
from tests.thorough.proofs.test_tied import checked, program

pytestmark = pytest.mark.timeout(600)

BY_RULE = ("dead-rule", "redundant-rule", "vacuous-conflict")
BY_HEDGE = ("dead-hedge", "redundant-hedge")

RULES = """
ASSUME NOT (Gone AND Asleep)
RULE never
WHEN Call AND Gone AND Asleep THEN Leave
RULE help
WHEN Call THEN Help
UNLESS Gone AND Asleep IN WHICH CASE Leave
UNLESS Asleep IN WHICH CASE (Help UNLESS Busy IN WHICH CASE Wait)
UNLESS Asleep AND Busy AND Ill IN WHICH CASE Wait
RULE help_too
WHEN Call AND NOT Asleep THEN Help
RULE shout
WHEN Alarm THEN Shout
RULE hush
WHEN Alarm THEN NOT Shout
"""
"""Something for every check."""


def tied(oracle: Path, ruleset: Ruleset, checks: list[str]) -> dict[str, VerdictBinding | UnboundVerdict]:
    """How it goes with what these checks say, whatever it rests on."""
    shown = [Evidence(result, 1, 1, ("a.cnf", "a.lrat")) for result in run_checks(ruleset, checks, chains=False)]
    return {one.check: one for one in bind_verdicts(shown, ruleset, None, oracle, chains=False)}


def candidates(ruleset: Ruleset, check: str) -> Iterator[Finding]:
    """All that the check could find; the rules that are to suffice are all there are."""
    for rule in ruleset.rules:
        others = tuple(other.label for other in ruleset.rules if other is not rule)
        if check in BY_RULE:
            yield CHECKS[check].finding("", NOWHERE, rules=(rule.label, *others))
        else:
            for number in range(1, len(list(rule.clauses()))):
                refs = (ClauseRef(rule.label, number),)
                yield CHECKS[check].finding("", NOWHERE, rules=(rule.label,), clauses=refs)


def proves(theory: Theory, index: RulesetIndex, finding: Finding) -> bool:
    try:
        for question in questions(finding.check, [finding], "", index, theory.numbered):
            theory.prove(question)
    except NotRefuted:
        return False
    return True


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in range(1, 10))])
def test_what_is_found_is_proved_and_nothing_else(oracle: Path, seed: int) -> None:
    """Rule by rule and hedge by hedge: two roads to what is dead, redundant, or always in conflict."""
    proved, refused = Counter[str](), Counter[str]()
    for ruleset, _ in random_cases(100 + seed, 80, each=1):
        index = RulesetIndex(ruleset)
        if not is_possible(index):
            continue  # nothing but the contradiction of the assumptions is reported
        found = {result.name: result.findings for result in run_checks(ruleset, list(FOUND), chains=False)}
        dead = {finding.rules[0] for finding in found["dead-rule"]}
        with Theory(oracle, ruleset) as theory:
            for check in (*BY_RULE, *BY_HEDGE):
                known = {(finding.rules[0], finding.clauses) for finding in found[check]}
                for finding in candidates(ruleset, check):
                    expected = (finding.rules[0], finding.clauses) in known
                    # Of a rule that nothing triggers, it is true that it conflicts wherever it is triggered.
                    expected |= check == "vacuous-conflict" and finding.rules[0] in dead
                    assert proves(theory, index, finding) == expected, (finding, ruleset)
                    (proved if expected else refused)[check] += 1
    for check in (*BY_RULE, *BY_HEDGE):
        assert proved[check], check
        assert refused[check] > 5, check


def test_every_finding_of_random_rules_is_tied(oracle: Path) -> None:
    """With what the checks name as sufficient, all findings of a check in one question."""
    count = Counter[str]()
    for ruleset, _ in random_cases(11, 50, each=1):
        for check, one in tied(oracle, ruleset, list(FOUND)).items():
            assert one == VerdictBinding(check, True), ruleset
            count[check] += 1
    assert count.keys() >= FOUND.keys() - {"assumptions"}


@given(ruleset=rulesets())
@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_with_measures_and_domains_too(oracle: Path, ruleset: Ruleset) -> None:
    if not_modelled(ruleset, chains=False) is None:
        assert all(one == VerdictBinding(check, True) for check, one in tied(oracle, ruleset, list(FOUND)).items())


@pytest.mark.parametrize("check", FOUND)
def test_the_examples_of_the_checks(oracle: Path, check: str) -> None:
    for kind in CHECKS[check].kinds:
        assert tied(oracle, parse(kind.bad), [check]) == {check: VerdictBinding(check, True)}
        assert all(
            one.proved for one in tied(oracle, parse(kind.good), [check]).values() if isinstance(one, VerdictBinding)
        )


def test_numbers_that_leave_no_room(oracle: Path) -> None:
    rules = (
        "MEASURE Age: integer\nMEASURE Heat: number\nMEASURE Cold: number\n"
        "WHEN T AND Age > 2 AND Age < 3 THEN X\n"
        "WHEN T THEN X\nUNLESS Heat < Cold AND Cold < Heat IN WHICH CASE Y\n"
        "UNLESS Age > 4 AND Age <= 4 IN WHICH CASE Z\n"
    )
    found = tied(oracle, parse(rules), list(FOUND))
    assert found.keys() >= {"dead-rule", "dead-hedge", "redundant-rule"}
    assert all(one == VerdictBinding(check, True) for check, one in found.items())


def test_domains_each_by_itself(oracle: Path, tmp_path: Path) -> None:
    """What makes a rule redundant is another one in each domain."""
    rules = (
        "DOMAIN ward\nRULE here WHEN T THEN X\nDOMAIN home\nRULE there WHEN T THEN X AND Y\n"
        "DOMAIN ward, home\nRULE both WHEN T THEN X\nUNLESS c AND NOT c IN WHICH CASE Y\n"
    )
    ruleset = parse(rules)
    (finding, *_) = (f for r in run_checks(ruleset, ["redundant-rule"]) for f in r.findings if f.rules[0] == "both")
    assert set(finding.domains) == {"ward", "home"}
    found = {one.check: one for one in checked(tmp_path / "c", rules, oracle).tied}
    assert all(
        found[check] == VerdictBinding(check, True) for check in ("redundant-rule", "redundant-hedge", "dead-hedge")
    )


def test_a_certificate_of_everything(oracle: Path, tmp_path: Path) -> None:
    found = {one.check: one for one in checked(tmp_path / "c", RULES, oracle).tied}
    assert [check for check, one in found.items() if one.proved] == [
        "vacuous-conflict",
        "dead-rule",
        "dead-hedge",
        "redundant-rule",
        "redundant-hedge",
    ]


def test_rules_that_nothing_triggers_are_passed_over_where_they_are_proved_to_be(oracle: Path, tmp_path: Path) -> None:
    rules = (
        "WHEN Call AND Gone AND NOT Gone THEN Help\n"
        "WHEN Call THEN Help\nUNLESS Gone IN WHICH CASE NOT Help\n"
        "WHEN Call THEN Help\nUNLESS Gone IN WHICH CASE Wait\n"
    )
    found = {one.check: one for one in checked(tmp_path / "c", rules, oracle).tied}
    assert found["vacuous-conflict"] == VerdictBinding("vacuous-conflict", True)
    assert found["dead-rule"] == VerdictBinding("dead-rule", True)


def test_assumptions_that_leave_nothing(oracle: Path, tmp_path: Path) -> None:
    rules = "ASSUME Ill\nASSUME NOT Ill\nWHEN Call THEN Help\nUNLESS Ill IN WHICH CASE Wait\n"
    found = checked(tmp_path / "c", rules, oracle).tied
    # Nothing but the contradiction is reported.
    assert {one.check for one in found} == {"assumptions", "conflict"}
    assert all(one.proved for one in found)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_clauses_are_numbered_as_in_the_text(oracle: Path, number: int) -> None:
    """A default with a chain of its own is a hedge to the oracle, and moves the numbers of the others."""
    conditions = ["a", "b", "c"]
    conditions[number - 1] += " AND NOT " + conditions[number - 1]
    one, two, three = conditions
    ruleset = parse(
        f"READING priority\nRULE r\nWHEN T THEN (X UNLESS {one} IN WHICH CASE Y)\n"
        f"UNLESS {two} IN WHICH CASE (Z UNLESS {three} IN WHICH CASE X)\n"
    )
    (result,) = run_checks(ruleset, ["dead-hedge"])
    dead = {finding.clauses[0].clause for finding in result.findings}
    assert dead == ({2, 3} if number == 2 else {number})
    index = RulesetIndex(ruleset)
    with Theory(oracle, ruleset) as theory:
        proved = [f.clauses[0].clause for f in candidates(ruleset, "dead-hedge") if proves(theory, index, f)]
    assert set(proved) == dead


LIE = DEAD_RULE.finding("shout is active in no situation", NOWHERE, rules=("shout",))


def test_a_finding_that_is_false_is_refused(oracle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def lying(index: RulesetIndex) -> Iterator[Finding]:
        yield from DEAD_RULE.run(index)
        yield LIE

    monkeypatch.setitem(cast("dict[str, Check]", CHECKS), "dead-rule", replace(DEAD_RULE, run=lying))
    with pytest.raises(CertificateRefused) as refusal:
        checked(tmp_path / "c", RULES, oracle)
    assert [reason for reason, _ in refusal.value.problems] == ["theory"]
    assert "dead-rule" in refusal.value.problems[0][1]


def test_of_what_there_is_not_nothing_is_proved(oracle: Path) -> None:
    """That it is dead would be true of all."""
    asked = ["dead-rule 9", "dead-hedge 2 0", "dead-hedge 2 5", "redundant-hedge 2 5 0", "redundant-rule 9 0"]
    with Theory(oracle, parse(RULES)) as theory:
        for finding in asked:
            with pytest.raises(NotRefuted, match="not in the rules"):
                theory.prove(f"findings 1 {finding}")
        line = theory.numbered.line
    # Nor by what refutes everything.
    said = answers(oracle, [line, "formula findings 2 dead-rule 1 dead-rule 9", "refuted a 1 0 0", "refuted"])
    assert said[1:] == ["", "no", "no"]


def test_what_suffices_is_a_hint_and_no_more(oracle: Path) -> None:
    ruleset = parse(RULES)
    index = RulesetIndex(ruleset)
    (found,) = (one for one in run_checks(ruleset, ["redundant-rule"])[0].findings if one.rules[0] == "help_too")
    with Theory(oracle, ruleset) as theory:
        assert proves(theory, index, found)
        # Nor does a rule make up for itself.
        for others in ((), ("shout",), ("help_too",)):
            assert not proves(theory, index, replace(found, rules=("help_too", *others)))


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("while read word rest; do case $word in rules) echo ok;; *) exit 0;; esac; done", "exited with 0"),
        ("read line; echo ok; exec sleep 30", "did not answer in 0.3 s"),
    ],
)
def test_an_oracle_that_does_not_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: str, reason: str
) -> None:
    """Another one is asked about the next check."""
    monkeypatch.setattr(tying, "MOST_SECONDS", 0.3)
    found = checked(tmp_path / "c", RULES, program(tmp_path, body)).tied
    assert len(found) == 5
    assert all(not one.proved and reason in (one.reason or "") for one in found)


def test_parts_of_conditions_are_not_spoken_of(tmp_path: Path) -> None:
    rules = "MEASURE Heat: number\nWHEN T THEN X\nUNLESS Heat > 30 OR Heat < 40 IN WHICH CASE Y\n"
    found = {one.check: one for one in checked(tmp_path / "c", rules, tmp_path / "never run").tied}
    assert found["constant-condition"].reason == "the theory does not cover parts of conditions"


def test_the_command_says_so(oracle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rules, folder = tmp_path / "rules.sleec", str(tmp_path / "c")
    rules.write_text(RULES, encoding="utf-8")
    run(["certify", str(rules), "-o", folder])
    capsys.readouterr()
    run(["certify", "--check", folder, str(rules)])
    said = capsys.readouterr().out
    assert "dead-rule: 1 finding proved for the parsed rules, by the program extracted from" in said
    run(["certify", "--check", folder, str(rules), "--format", "json"])
    assert json.loads(capsys.readouterr().out)["theory"]["dead-rule"] == {"proved": True, "reason": None}
