"""The correct robots of other tests, of the guide and of the examples are accepted, and run as they should."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse
from sleec_verify.conformance.structure import check_structure
from sleec_verify.conformance.structure.target import python_files
from sleec_verify.results.finding import Proved, Unknown
from tests.fast.dispatch import test_instance
from tests.support import robots
from tests.support.paths import ROOT
from tests.support.structure import CODES, checked, files, kinds

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))
HEAD = "import contextpy3 as cop\nfrom robots import Log\n"


def source_of(thing: object) -> str:
    return textwrap.dedent(inspect.getsource(thing))  # type: ignore[arg-type]


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_generated_robots(path: Path) -> None:
    rules = load(path)
    robot = HEAD + "from rules import sleec\n" + robots.robot_source(rules)
    log = source_of(robots.Log)
    assert kinds(rules, robots="from sleec_runtime.dispatch.recording import recorded\n" + log, robot=robot) == []


def test_listing_2_of_the_instance_tests() -> None:
    robot = HEAD + source_of(test_instance.curtain_class)
    log = "from sleec_runtime.dispatch.recording import recorded\n" + source_of(robots.Log)
    assert kinds(robots.CURTAINS, robots=log, robot=robot) == []


def test_the_guide_of_the_runtime() -> None:
    guide = (ROOT / "docs" / "runtime.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
    rule, curtains = blocks[0], blocks[1]
    rules = re.search(r'RULES = """(.*?)"""', rule, re.DOTALL)
    assert rules
    assert kinds(rules.group(1), robot=rule + curtains) == []


def test_the_guide_of_deadlines() -> None:
    guide = (ROOT / "docs" / "deadlines.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
    rules = re.search(r'parse\("""(.*?)"""', blocks[0], re.DOTALL)
    assert rules
    head = "from sleec_runtime import Sleec\nfrom sleec_runtime.language import parse\n"
    assert kinds(rules.group(1), robot=head + "".join(blocks)) == []


def test_the_example() -> None:
    code = python_files(str(ROOT / "examples" / "household_robot.py"))
    rules = load(ROOT / "rulesets" / "household.sleec")
    assert isinstance(check_structure(rules, code).verdict, Proved)
    done = subprocess.run(
        [sys.executable, "-m", "examples.household_robot"], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.split() == ["OpenCurtains", "RefuseRequest", "ExplainWhy"]


def test_only_the_rules_of_a_domain_need_code() -> None:
    rules = parse("RULE a WHEN A THEN Go\nDOMAIN ward\nRULE b WHEN B THEN Stay")
    robot = "from rules import sleec\n\nclass Robot:\n    @sleec.rule('a')\n    def a(self): self.go()\n"
    assert isinstance(check_structure(rules, files(robot=robot), "house").verdict, Proved)
    (finding,) = check_structure(rules, files(robot=robot), "ward").findings
    assert finding.rules == ("b",)
    assert finding.source is None


def test_what_is_nested_too_deeply_is_undecided() -> None:
    code = files(robot="x = " + " + ".join(["1"] * 900))
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + 300)
    try:
        result = check_structure(parse("RULE a WHEN A THEN Go"), code)
    finally:
        sys.setrecursionlimit(limit)
    assert isinstance(result.verdict, Unknown)


def test_findings_carry_the_place_in_the_code() -> None:
    robot = "from rules import sleec\n\nclass Röbot:\n    @sleec.rule('a')\n    def ä(self): self.ü('ö'); self.stay()\n"
    (finding,) = checked("RULE a WHEN A THEN Go UNLESS c IN WHICH CASE Stay", robot=robot).findings[:1]
    assert finding.source is not None
    text = finding.source.text[finding.span.start : finding.span.end]
    assert text in ("def ä", "self.stay()")


@pytest.mark.slow
@pytest.mark.parametrize("module", ["asyncio", "http", "sleec_runtime", "contextpy3"])
def test_any_code_is_read_to_its_end(module: str) -> None:
    code = python_files(module)
    findings = check_structure(parse(robots.CURTAINS), code).findings
    assert not {CODES[finding.code] for finding in findings} - {"missing-method", "undecided"}
