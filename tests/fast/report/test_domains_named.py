"""Every report of one line names the domains in which a finding holds, so that no two lines are the same."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.report import renderer
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from tests.support.cli import Cli
from tests.support.repository import Repository

OLD = """\
DOMAIN home, ward
RULE a
WHEN Bell THEN OpenDoor
RULE b
WHEN Bell AND Ding THEN LockDoor
RULE d
WHEN Fire THEN Leave AND Shout
"""
NEW = f"""\
DOMAIN home
EXCLUSIVE OpenDoor, LockDoor
{OLD}DOMAIN ward
RULE c
WHEN Bell AND Ding THEN LockDoor AND NOT OpenDoor
"""


def test_check_names_the_domain_of_each_finding(cli: Cli) -> None:
    lines = cli("check", "new.sleec", "--format", "concise", files={"new.sleec": NEW}).out.splitlines()[:-1]
    told = [line.rpartition("; ")[2] for line in lines if "`b` can be triggered" in line]
    assert told == [
        "domain home",
        "domain ward",
    ]
    assert len(set(lines)) == len(lines)


def test_diff_names_the_domains_of_each_change(cli: Cli) -> None:
    changed = NEW.replace(" AND Shout", "")
    ran = cli("diff", "a", "b", "--format", "concise", "--assert", "never LockDoor", files={"a": OLD, "b": changed})
    named = {line.split()[1]: line.rpartition("; ")[2] for line in ran.out.splitlines() if "; domain" in line}
    assert named == {"-": "domains home and ward", "+": "domain ward", "broken": "domain home"}
    assert "+ conflict LockDoor, OpenDoor [a/b] when Bell, Ding=true (1/2); domain home\n" in ran.out


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_gate_names_the_domains_of_what_blocks(cli: Cli, tmp_path: Path) -> None:
    repository = Repository(tmp_path)
    repository.commit(a_sleec=OLD)
    repository.put("a.sleec", NEW)
    ran = cli("gate", "--base", "main", "--summary", "summary.md")
    assert (
        "blocks: new-conflicts: a.sleec: a and b now contradict each other about LockDoor and OpenDoor; domain home\n"
        in ran.out
    )
    blocks = [line for line in ran.out.splitlines() if line.startswith("blocks: ")]
    assert len(set(blocks)) == len(blocks)
    assert "; domain home" in (tmp_path / "summary.md").read_text(encoding="utf-8")


_RULES = st.builds(
    "DOMAIN {}\nRULE r{}\nWHEN t THEN {}o{}\n".format,
    st.sampled_from(("home", "ward", "home, ward", "everywhere")),
    st.uuids().map(lambda uuid: uuid.hex),
    st.sampled_from(("", "NOT ")),
    st.sampled_from((1, 2)),
)


@settings(max_examples=60, deadline=None)
@given(st.lists(_RULES, min_size=2, max_size=5).map("".join), st.sampled_from(("", "DOMAIN home\nEXCLUSIVE o1, o2\n")))
def test_no_two_lines_are_the_same(rules: str, constraint: str) -> None:
    ruleset = parse(constraint + rules)
    checked = CheckedRuleset(ruleset, run_checks(ruleset))
    *lines, _ = "".join(renderer("concise")([checked], PLAIN)).splitlines()
    assert len(set(lines)) == len(lines)
