"""The pytest plugin: ``pytest rulesets/`` (docs/conformance-tests.md).

It imports nothing else of sleec until a ruleset, a file of cases, a fixture or an option needs it.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from sleec_runtime import Sleec
    from sleec_runtime.model import Ruleset
    from sleec_verify.pytest_plugin.coverage import ClauseCoverage
    from sleec_verify.pytest_plugin.summary import Summary

_COVERAGE: pytest.StashKey[ClauseCoverage] = pytest.StashKey()
_SUMMARIES: pytest.StashKey[list[Summary]] = pytest.StashKey()
_LARGEST = 16 * 1024 * 1024
_SENT = "sleec_coverage"
"""The key under which a process of pytest-xdist sends its coverage to the process that started it."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("sleec", "SLEEC rules")
    group.addoption("--sleec-ruleset", metavar="FILE", help="The ruleset of the target and the fixtures.")
    group.addoption(
        "--sleec-target",
        metavar="MODULE:NAME",
        help="The function that returns the Sleec of the robot to test: module:function or file.py:name.",
    )
    group.addoption("--sleec-cov", action="store_true", help="Report which clauses the tests activate.")
    group.addoption(
        "--sleec-cov-mcdc", action="store_true", help="Also report which conditions the tests show to decide (MC/DC)."
    )
    group.addoption(
        "--sleec-cov-fail-under",
        metavar="PERCENT",
        help="Fail if less than this percentage of the goals is covered (0 to 100).",
    )
    parser.addini("sleec_ruleset", "Like --sleec-ruleset, relative to the root folder.", default="")
    parser.addini("sleec_target", "Like --sleec-target, relative to the root folder.", default="")
    parser.addini("sleec_domain", "Test only the rules of this domain.", default="")
    parser.addini("sleec_reading", "The reading of several exceptions, whatever the files say.", default="")
    parser.addini("sleec_fail_level", "A check fails if it has findings of at least this severity.", default="error")
    parser.addini("sleec_cov", "Like --sleec-cov.", type="bool", default=False)
    parser.addini("sleec_cov_mcdc", "Like --sleec-cov-mcdc.", type="bool", default=False)
    parser.addini("sleec_cov_fail_under", "Like --sleec-cov-fail-under.", default="")


def pytest_configure(config: pytest.Config) -> None:
    _see_ruleset(config)
    mcdc = _on(config, "sleec_cov_mcdc")
    if mcdc or _on(config, "sleec_cov") or _fail_under(config) is not None:
        from sleec_verify.pytest_plugin.coverage import ClauseCoverage

        config.stash[_COVERAGE] = ClauseCoverage(mcdc)
        config.stash[_COVERAGE].start()


def pytest_unconfigure(config: pytest.Config) -> None:
    if _COVERAGE in config.stash:
        config.stash[_COVERAGE].stop()


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    name = file_path.name
    if name.endswith(".sleec"):
        from sleec_verify.pytest_plugin.items import RulesetFile

        return RulesetFile.from_parent(parent, path=file_path)
    if name.endswith(".cases.toml") and _are_cases(file_path):
        from sleec_verify.pytest_plugin.items import CasesFile

        return CasesFile.from_parent(parent, path=file_path)
    return None


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any, error: object) -> None:
    """A process of pytest-xdist has ended. A crashed process has sent nothing."""
    packed = getattr(node, "workeroutput", {}).get(_SENT)
    if packed is not None:
        node.config.stash[_COVERAGE].add(packed)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    config = session.config
    if _COVERAGE not in config.stash or config.getoption("collectonly"):
        return
    output = getattr(config, "workeroutput", None)
    if output is not None:  # the main process adds up the coverage and compares it with the threshold
        output[_SENT] = config.stash[_COVERAGE].packed()
        return
    config.stash[_SUMMARIES] = summaries = _summarised(config)
    least = _fail_under(config)
    passed = session.exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED)
    if least is not None and passed and (not summaries or _share(summaries) < least):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    found = config.stash.get(_SUMMARIES, None)
    if found is None:
        return
    terminalreporter.section("SLEEC clause coverage")
    if not found:
        terminalreporter.write_line("no ruleset was used")
    for summary in found:
        for line in summary.lines():
            terminalreporter.write_line(line)
    least = _fail_under(config)
    if least is not None and not found:
        terminalreporter.write_line(f"FAIL: {least:g} % of all goals are required, but there are no goals", red=True)
    elif least is not None and _share(found) < least:
        terminalreporter.write_line(f"FAIL: {_share(found):.1f} % of all goals is less than {least:g} %", red=True)


@pytest.fixture(scope="session")
def sleec_ruleset(pytestconfig: pytest.Config) -> Ruleset:
    """The ruleset of ``--sleec-ruleset``, or of the ini value ``sleec_ruleset``."""
    from sleec_runtime.errors import SleecError
    from sleec_verify.pytest_plugin import settings

    try:
        found = settings.ruleset(pytestconfig)
    except SleecError as error:
        pytest.fail(str(error), pytrace=False)
    if found is None:
        pytest.fail("no ruleset: use --sleec-ruleset FILE, or set sleec_ruleset", pytrace=False)
    return found


@pytest.fixture
def sleec(request: pytest.FixtureRequest) -> Iterator[Sleec]:
    """A new instance: of ``--sleec-target``, or for `sleec_ruleset` with obligations that do nothing.
    `sleec_runtime.recording` sees these."""
    from sleec_runtime.errors import SleecError
    from sleec_verify.pytest_plugin import settings
    from sleec_verify.pytest_plugin.items import stand_in

    try:
        target = settings.target(request.config)
    except SleecError as error:
        pytest.fail(str(error), pytrace=False)
    if target is not None:
        yield target()
        return
    ruleset: Ruleset = request.getfixturevalue("sleec_ruleset")
    yield stand_in(ruleset, settings.domain(request.config, ruleset))


def _on(config: pytest.Config, name: str) -> bool:
    return bool(config.getoption(name) or config.getini(name))


def _fail_under(config: pytest.Config) -> float | None:
    value = config.getoption("sleec_cov_fail_under")
    written = str(config.getini("sleec_cov_fail_under") if value is None else value)
    if written == "":
        return None
    try:
        percent = float(written)
    except ValueError:
        percent = math.nan
    if not 0 <= percent <= 100:
        raise pytest.UsageError(f"sleec_cov_fail_under is {written!r}, not a number from 0 to 100")
    return percent


def _see_ruleset(config: pytest.Config) -> None:
    """Report a missing ruleset at once, not only when a test needs it."""
    if config.getoption("sleec_ruleset") or config.getini("sleec_ruleset"):
        from sleec_verify.pytest_plugin import settings

        path = settings.ruleset_path(config)
        if path is not None and not path.is_file():
            raise pytest.UsageError(f"sleec_ruleset: file {path} does not exist")


def _are_cases(path: Path) -> bool:
    """Whether a ``*.cases.toml`` file is about rules, because other tools have such files, too."""
    if path.with_name(path.name.removesuffix(".cases.toml") + ".sleec").is_file():
        return True
    toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    try:
        # As `sleec_runtime.support.files` does, which is not imported for the files of others.
        if not path.is_file() or path.stat().st_size > _LARGEST:
            return False
        return "ruleset" in toml.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return False


def _summarised(config: pytest.Config) -> list[Summary]:
    from sleec_runtime.errors import SleecError
    from sleec_verify.pytest_plugin import settings
    from sleec_verify.pytest_plugin.summary import Summary

    coverage = config.stash[_COVERAGE]
    try:
        named = settings.ruleset(config)
    except SleecError:
        named = None
    if named is not None:
        # Report all rules, even if nothing was triggered.
        return [Summary(coverage.about(named), coverage.mcdc)]
    return [Summary(covered, coverage.mcdc) for covered in coverage.all()]


def _share(found: list[Summary]) -> float:
    from sleec_verify.pytest_plugin.summary import share

    return share(sum(summary.reached for summary in found), sum(summary.goals for summary in found))
