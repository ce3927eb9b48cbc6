"""Files of a target that are made in memory, and what the check says of them."""

from __future__ import annotations

import ast

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset, Source
from sleec_verify.conformance.structure import check_structure
from sleec_verify.conformance.structure.kinds import KINDS
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.results.finding import CheckResult

CODES = {kind.code: name for name, kind in KINDS.items()}


def files(**texts: str) -> tuple[PythonFile, ...]:
    return tuple(
        PythonFile(Source(f"{name}.py", text), ast.parse(text), ("robot", name)) for name, text in texts.items()
    )


def checked(rules: Ruleset | str, **texts: str) -> CheckResult:
    return check_structure(parse(rules) if isinstance(rules, str) else rules, files(**texts))


def kinds(rules: Ruleset | str, **texts: str) -> list[str]:
    """The kinds of the findings, in their order."""
    return [CODES[finding.code] for finding in checked(rules, **texts).findings]
