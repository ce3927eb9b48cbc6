"""A use is accepted if and only if the certificate covers it: every way to certify rules, and every way to use them."""

from __future__ import annotations

import itertools
import json
import shutil
import warnings
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import sleec_runtime
from sleec_runtime.certificate.coverage import Use
from sleec_runtime.errors import CertificateRefused, ConflictInContext, SleecError
from sleec_runtime.evaluation.due import due
from sleec_runtime.language import load, parse
from sleec_runtime.model import READINGS, Context, Reading, Ruleset
from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.encoding.trace_scope import Untimed
from tests.fast.certificates.test_refused import Manifest, rewrite
from tests.thorough.certificates.test_certificates import written

DSL = "def_start\n  event A\n  event B\n  event X\n  measure p: boolean\ndef_end\n"
TEXTS = {
    "plain": "RULE a WHEN A THEN X UNLESS C IN WHICH CASE Y\nRULE b WHEN A AND C THEN NOT X\n",
    "conflict": "RULE a WHEN A THEN X\nRULE b WHEN B THEN NOT X\n",
    "one domain": "DOMAIN day\nRULE a WHEN A THEN X\nRULE b WHEN A THEN X\n",
    "domains": "DOMAIN day\nRULE a WHEN A THEN X\nDOMAIN night\nRULE b WHEN A THEN NOT X\n",
    "a domain in conflict": "RULE a WHEN A THEN X\nDOMAIN day\nRULE b WHEN A THEN X\n"
    "DOMAIN night\nRULE c WHEN B THEN NOT X\n",
    # By priority, X and NOT X are due where D is true and C is not.
    "reading": "RULE a WHEN A THEN Y UNLESS C IN WHICH CASE Y UNLESS D IN WHICH CASE X\n"
    "RULE b WHEN A AND NOT C THEN NOT X\n",
    "assumptions": "ASSUME C\nASSUME NOT C\nRULE a WHEN A THEN X\nRULE b WHEN A THEN NOT X\n",
    "a domain without situations": "RULE a WHEN A THEN X\nDOMAIN day\nASSUME C\n"
    "ASSUME NOT C\nDOMAIN night\nRULE b WHEN A THEN X\n",
    # If X may come later, after the ten seconds, nothing is at odds.
    "untimed": "RULE a WHEN A THEN X\nRULE b WHEN B THEN NOT X WITHIN 10 seconds\n",
    "timed": "RULE a WHEN A THEN X WITHIN 5 seconds\nRULE b WHEN B THEN Y\n",
    # A and B never happen at once, unless doing B is that B happens.
    "chains without times": "ASSUME NOT (A AND B)\nRULE a WHEN A THEN B\n"
    "RULE b WHEN B THEN Y\nRULE c WHEN A THEN NOT Y\n",
    "a constraint on a trigger": "TRIGGER A, B\nEXCLUSIVE B, X\nRULE a WHEN A THEN X\n",
    # If B happens where A is, something forbidden has happened; if what is done is not what happens, nothing has.
    "chains": f"{DSL}rule_start\n  R1 when A then not B\n  R2 when B then X\n  R3 when A then not X\nrule_end\n",
    "no chains": f"{DSL}rule_start\n  R1 when A then X\n  R2 when B then X\nrule_end\n",
    "no traces": f"{DSL}relation_start\n  measure invariant {{p}}\n  measure invariant (not {{p}})\nrelation_end\n"
    "rule_start\n  R1 when A then X\n  R2 when A then not X\nrule_end\n",
    "a chain": f"{DSL}rule_start\n  R1 when A then B\n  R2 when B then X\nrule_end\n",
    "a rule against itself": f"{DSL}rule_start\n  R1 when A then not A\nrule_end\n",
}
CHAINED = {"chains without times", "chains", "a chain", "a rule against itself"}
"""Where what a rule obliges or forbids triggers a rule."""
CHAINED_AT_ALL = {*CHAINED, "a constraint on a trigger"}
"""And where anything that a constraint forbids is a trigger."""


class Made(NamedTuple):
    """How rules are certified."""

    domain: str | None
    reading: Reading
    untimed: Untimed
    chains: bool = True


def rules(name: str) -> Ruleset:
    return parse(TEXTS[name], name)


def makings(name: str) -> Iterator[Made]:
    ruleset = rules(name)
    traces = ruleset.syntax == "dsl" or ruleset.is_timed
    times: tuple[Untimed, ...] = ("at", "eventually") if traces else ("at",)
    chains = (True, False) if name in CHAINED_AT_ALL and not traces else (True,)
    return itertools.starmap(Made, itertools.product((None, *ruleset.domains), READINGS, times, chains))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, Made], Path]:
    """The certificates, each beside its rules."""
    found = {}
    for name in TEXTS:
        folder = tmp_path_factory.mktemp("rules")
        (folder / "rules.sleec").write_text(TEXTS[name])
        ruleset = load(folder / "rules.sleec")
        for number, making in enumerate(makings(name)):
            at = folder / str(number)
            written(
                ruleset,
                at,
                certify(ruleset.read_as(making.reading), making.domain, making.untimed, chains=making.chains),
            )
            found[name, making] = at
    return found


ALL = [(name, making) for name in TEXTS for making in makings(name)]


@pytest.mark.parametrize(("name", "making"), ALL, ids=str)
def test_load_accepts_what_is_covered(made: dict[tuple[str, Made], Path], name: str, making: Made) -> None:
    folder = made[name, making]
    ruleset = load(folder.parent / "rules.sleec")
    for domain, reading, chains in itertools.product((None, *ruleset.domains), READINGS, (False, True)):
        manifest = json.loads((folder / "manifest.json").read_text())
        expected = (
            making.reading == reading
            and making.untimed == "at"
            and (domain is not None or len(ruleset.domains) < 2)
            and (making.domain in (None, domain) or (domain is None and ruleset.domains == (making.domain,)))
            and (manifest["chains"] == chains or name not in (CHAINED_AT_ALL if chains else CHAINED))
            and all(
                check["verdict"] == "proved"
                for check in manifest["checks"]
                if check["name"] in ("conflict", "vacuous-conflict", "assumptions")
            )
        )
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                sleec_runtime.load(folder.parent / "rules.sleec", domain, reading, chains=chains, certificate=folder)
            refusal = None
        except CertificateRefused as error:
            refusal = error
        assert (refusal is None) == expected, (domain, reading, chains)
        if refusal is not None:
            assert refusal.hint
        else:
            assert never_conflicts(name, domain, reading, chains), (domain, reading, chains)


@cache
def never_conflicts(name: str, domain: str | None, reading: Reading, chains: bool) -> bool:
    """Whether the runtime finds no conflict in any situation that the assumptions allow, asked in each."""
    ruleset = rules(name)
    triggers = sorted({rule.trigger for rule in ruleset.rules} | ruleset.declared["trigger"])
    conditions = sorted(ruleset.conditions)
    for bits in itertools.product((False, True), repeat=len(triggers) + len(conditions)):
        happening = [name for name, bit in zip(triggers, bits) if bit]
        given = dict(zip(conditions, bits[len(triggers) :]))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            clock = sleec_runtime.VirtualClock()
            sleec = sleec_runtime.Sleec(ruleset, domain, reading, chains=chains, clock=clock)
        sleec.implement({obligation: lambda: None for obligation in ruleset.obligations})
        sleec.update(given)
        if not happening or sleec.broken_assumptions(*happening):
            continue
        if chains and (forbids_what_happens(sleec, happening) or not triggers_of(ruleset).issuperset(happening)):
            # What happens breaks a rule, or triggers none, so this is no situation of which anything was proved.
            continue
        try:
            sleec.trigger_all(happening)
        except ConflictInContext:
            return False
    return True


def triggers_of(ruleset: Ruleset) -> set[str]:
    return {rule.trigger for rule in ruleset.rules}


def forbids_what_happens(sleec: sleec_runtime.Sleec, happening: list[str]) -> bool:
    decided = due(sleec.ruleset, Context(frozenset(happening), dict(sleec.conditions)))
    return not set(decided.prohibitions).isdisjoint(happening)


@pytest.mark.parametrize(("name", "making"), ALL, ids=str)
def test_check_accepts_what_is_covered(made: dict[tuple[str, Made], Path], name: str, making: Made) -> None:
    folder = made[name, making]
    ruleset = load(folder.parent / "rules.sleec")
    times: tuple[Untimed, ...] = ("at", "eventually")
    for domain, reading, untimed in itertools.product((None, *ruleset.domains, "elsewhere"), READINGS, times):
        certified = set(ruleset.domains or [None]) if making.domain is None else {making.domain}
        used = set(ruleset.domains or [None]) if domain is None else {domain}
        traces = ruleset.syntax == "dsl" or ruleset.is_timed
        expected = making.reading == reading and used <= certified and (not traces or making.untimed == untimed)
        try:
            confirmed = check_certificate(ruleset, str(folder), IN_PYTHON, Use(reading, domain, untimed, making.chains))
            assert confirmed.ruleset.reading == reading
            reasons = set()
        except CertificateRefused as refusal:
            reasons = {reason for reason, _ in refusal.problems}
        assert (not reasons) == expected, (domain, reading, untimed)
        assert reasons <= {"reading", "domain", "untimed"}


@pytest.mark.parametrize(
    ("name", "making", "chains"),
    [
        ("untimed", Made(None, "cascade", "eventually"), True),
        ("chains without times", Made(None, "cascade", "at", chains=False), True),
        ("no traces", Made(None, "priority", "at"), False),
    ],
)
def test_what_is_refused_would_conflict(
    made: dict[tuple[str, Made], Path], name: str, making: Made, chains: bool
) -> None:
    """Each certificate proves `conflict`, and the runtime meets one."""
    manifest = json.loads((made[name, making] / "manifest.json").read_text())
    assert manifest["checks"][0]["verdict"] == "proved"
    assert not never_conflicts(name, None, making.reading, chains)


# What else a runtime may do with rules ---------------------------------------------------------------------------


def refused(folder: Path, ruleset: Ruleset, **use: Any) -> set[str]:
    with pytest.raises(CertificateRefused) as refusal:
        sleec_runtime.Sleec(ruleset, certificate=folder, **use)
    return {reason for reason, _ in refusal.value.problems}


def test_rules_that_are_not_all_of_the_text(made: dict[tuple[str, Made], Path]) -> None:
    folder = made["plain", Made(None, "cascade", "at")]
    ruleset = load(folder.parent / "rules.sleec")
    sleec_runtime.Sleec(ruleset, certificate=folder)
    more = parse("RULE c WHEN A THEN Z").statements
    for statements in (ruleset.statements[1:], (*ruleset.statements, *more)):
        assert refused(folder, replace(ruleset, statements=statements)) == {"ruleset-changed"}
    other = parse(TEXTS["conflict"], sha256=ruleset.source.sha256)
    assert refused(folder, replace(ruleset, statements=other.statements)) == {"ruleset-changed"}
    domains = made["domains", Made(None, "cascade", "at")]
    both = load(domains.parent / "rules.sleec")
    sleec = sleec_runtime.Sleec(both, "day", certificate=domains)
    with pytest.raises(CertificateRefused, match="all and only those of the text"):
        sleec.replace(both.in_domain("day"))


def test_what_comes_later_is_as_it_was_loaded(made: dict[tuple[str, Made], Path]) -> None:
    """With chains, other rules are asked for chains as well, and in the domain that is entered."""
    plain = made["no chains", Made(None, "priority", "at")]
    chained = made["a chain", Made(None, "priority", "at")]
    for chains in (True, False):
        sleec = sleec_runtime.Sleec(load(plain.parent / "rules.sleec"), chains=chains, certificate=plain)
        code = {"X": lambda: None, "B": lambda: None}
        other = load(chained.parent / "rules.sleec")
        if chains:
            sleec.replace(other, implement=code, certificate=chained)
        else:
            with pytest.raises(CertificateRefused, match="counts chains"):
                sleec.replace(other, implement=code, certificate=chained)


def add_verdict(verdict: str, manifest: Manifest) -> None:
    manifest["checks"].append({**manifest["checks"][0], "verdict": verdict})


def drop_check(place: int, manifest: Manifest) -> None:
    del manifest["checks"][place]


def test_two_verdicts_of_one_check(made: dict[tuple[str, Made], Path], tmp_path: Path) -> None:
    """Whichever comes last."""
    for name, verdict in (("conflict", "proved"), ("plain", "refuted")):
        folder = Path(shutil.copytree(made[name, Made(None, "cascade", "at")].parent, tmp_path / name))
        (folder / "c").symlink_to("0")
        rewrite(folder, partial(add_verdict, verdict))
        assert refused(folder / "c", load(folder / "rules.sleec")) == {"manifest"}


def test_a_check_that_is_missing(made: dict[tuple[str, Made], Path], tmp_path: Path) -> None:
    folder = Path(shutil.copytree(made["plain", Made(None, "cascade", "at")].parent, tmp_path / "copy"))
    (folder / "c").symlink_to("0")
    for place in (2, 1, 0):
        rewrite(folder, partial(drop_check, place))
        assert refused(folder / "c", load(folder / "rules.sleec")) == {"conflict"}


def test_a_domain_that_there_is_not_is_no_matter_of_certificates(made: dict[tuple[str, Made], Path]) -> None:
    folder = made["domains", Made(None, "cascade", "at")]
    with pytest.raises(SleecError, match="kitchen") as error:
        sleec_runtime.load(folder.parent / "rules.sleec", "kitchen", certificate=folder)
    assert not isinstance(error.value, CertificateRefused)
