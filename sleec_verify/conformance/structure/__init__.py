"""Properly structured (paper, Section 3.2), checked by reading the robot's code: nothing of it is imported or run.

Each rule must have a method, with one variant for each clause, bound to the clause's layer, that calls what implements
the obligations of the clause, in their order, and nothing else that rules oblige; and nothing may reach those, the
method or its layers around the dispatch. What only running the program would tell is reported as undecided.

Entry points: `python_files` reads the target, `check_structure` gives the verdict. `KINDS` are the kinds of findings.
"""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING

from sleec_verify.conformance.structure.kinds import KINDS
from sleec_verify.conformance.structure.report import NAME
from sleec_verify.conformance.structure.target import python_files
from sleec_verify.results.finding import CheckResult, Proved, Refuted, Unknown

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.conformance.structure.target import PythonFile

__all__ = [
    "KINDS",
    "NAME",
    "QUESTION",
    "UNDECIDED",
    "check_structure",
    "python_files",
]

QUESTION = "Does the code do exactly what each clause of the rules requires?"
UNDECIDED = KINDS["undecided"].code


def check_structure(ruleset: Ruleset, files: tuple[PythonFile, ...], domain: str | None = None) -> CheckResult:
    """The verdict on the code in `files`: proved, refuted, or unknown where something could not be decided. With a
    domain, only its rules need code."""
    from sleec_verify.conformance.structure.check import findings_on

    started = perf_counter()
    try:
        findings = findings_on(ruleset, files, domain)
    except RecursionError:
        return CheckResult(NAME, Unknown("the code is nested too deeply to be analysed"), perf_counter() - started)
    seconds = perf_counter() - started
    undecided = sum(finding.code == UNDECIDED for finding in findings)
    if undecided:
        places = "one place" if undecided == 1 else f"{undecided} places"
        return CheckResult(NAME, Unknown(f"{places} cannot be decided without running the code", findings), seconds)
    return CheckResult(NAME, Refuted(findings) if findings else Proved(), seconds)
