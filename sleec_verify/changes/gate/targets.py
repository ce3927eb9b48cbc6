"""Conformance of a target: whether the robot's code has the structure of its rules."""

from __future__ import annotations

import os

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load
from sleec_verify.changes.gate.baseline import KnownFindings
from sleec_verify.changes.gate.examination import Locate
from sleec_verify.changes.gate.keys import Target
from sleec_verify.changes.gate.result import TargetConformance
from sleec_verify.results.internal_error import internal_errors_of


def check_target(target: Target, locate: Locate, known: KnownFindings) -> TargetConformance:
    """The verdict on a target, and its findings that are not `known`."""
    from sleec_verify.conformance.structure import UNDECIDED, check_structure, python_files

    found = TargetConformance(target)
    try:
        with internal_errors_of(target.code):
            found.ruleset = load(locate(target.at(target.rules)))
            if target.domain is not None and target.domain not in found.ruleset.domains:
                named = ", ".join(found.ruleset.domains) or "none"
                raise SleecError(f"{target.rules} has no domain called `{target.domain}`", f"it has {named}")
            code = locate(target.at(target.code))
            if not os.path.lexists(code):  # what is not there might be a module from elsewhere
                raise SleecError(f"file or folder {code} does not exist", "check its name and folder")
            found.result = check_structure(found.ruleset, python_files(code), target.domain)
    except SleecError as error:
        found.error = error
        return found
    for finding in found.result.findings:
        if finding.code == UNDECIDED:
            continue
        (found.known if known.has(found.ruleset, finding, [target.code]) else found.findings).append(finding)
    return found
