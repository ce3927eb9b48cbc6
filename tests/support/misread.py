"""The findings about names that people misread, and the text with what they say to write instead."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.checks.misread_names import MISREAD_NAME, replacements
from sleec_verify.results.finding import Finding

NEGATION, MODAL, COMPARISON, OPPOSITES, KEYWORD, SIMILAR, SLIP = (kind.code for kind in MISREAD_NAME.kinds)


def misread(text: str) -> list[Finding]:
    (result,) = run_checks(parse(text), [MISREAD_NAME.name])
    return list(result.findings)


def codes(text: str) -> list[str]:
    return [finding.code for finding in misread(text)]


def corrected(text: str) -> str:
    """The text with every replacement of its findings, one finding after the other."""
    for _ in range(20):
        ruleset = parse(text)
        edits = next((e for finding in misread(text) if (e := replacements(ruleset, finding))), ())
        if not edits:
            return text
        for (start, end), new in sorted(edits, reverse=True):
            text = f"{text[:start]}{new}{text[end:]}"
    raise AssertionError(f"the findings of this text do not end:\n{text}")
