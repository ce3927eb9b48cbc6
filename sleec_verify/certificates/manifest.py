"""What a certificate says: of which text, under which reading, what was found, and what shows it.

Nothing in it depends on when, where or how fast it was made: the same rules give the same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.certificate.manifest import FORMAT, Required
from sleec_verify import __version__
from sleec_verify.results.finding import Refuted, Unknown
from sleec_verify.results.json_values import VERDICTS, Json, finding_json

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.results.finding import CheckResult

LEFT_OUT = ("check", "note", "help", "related")
"""What a finding tells people and no certificate is about."""


class Evidence(NamedTuple):
    """A verdict, and what shows it: how many questions were refuted, how many answered with a situation (or a trace),
    and the names of the files with the proofs, formula and refutation by turns."""

    result: CheckResult
    refuted: int
    models: int
    files: tuple[str, ...]

    @property
    def evidence(self) -> str:
        """``proof``; ``trivial`` where no question was left to refute, so that the formula is the empty clause and says
        nothing; ``witnesses``; ``situations``, where what was looked for is nowhere because the opposite was found each
        time; ``text`` where nothing was asked of a solver; ``none`` where the verdict is unknown."""
        verdict = self.result.verdict
        if isinstance(verdict, Unknown):
            return "none"
        if self.files:
            return "proof" if self.refuted else "trivial"
        if isinstance(verdict, Refuted) and all(finding.witness for finding in verdict.findings):
            return "witnesses"
        return "situations" if self.models else "text"


def manifest(
    ruleset: Ruleset,
    domain: str | None,
    untimed: str | None,
    chains: bool,
    required: Required,
    shown: Sequence[Evidence],
    files: Mapping[str, str],
) -> dict[str, Json]:
    """The manifest. `untimed` is None for rules without time. `chains` is whether what is done triggers rules.
    `files` are the names of all other files with their SHA-256."""
    checks: list[Json] = [check_json(one, ruleset) for one in shown]
    return {
        "certificate": "sleec-verify",
        "format": FORMAT,
        "tool": {"name": "sleec-verify", "version": __version__},
        "ruleset": {
            "sha256": ruleset.source.sha256,
            "syntax": ruleset.syntax,
            "rules": len(ruleset.rules),
            "domains": list(ruleset.domains),
        },
        "reading": ruleset.reading,
        "domain": domain,
        "untimed": untimed,
        "chains": chains,
        "required": dict(required._asdict()),
        "checks": checks,
        "files": dict(files),
    }


def check_json(one: Evidence, ruleset: Ruleset) -> dict[str, Json]:
    """What the manifest says of one check."""
    result = one.result
    verdict = result.verdict
    return {
        "name": result.name,
        "verdict": VERDICTS[type(verdict)],
        "reason": verdict.why if isinstance(verdict, Unknown) else result.reason,
        "evidence": one.evidence,
        "refuted": one.refuted,
        "models": one.models,
        "files": list(one.files),
        "findings": [
            {
                key: value
                for key, value in finding_json(finding, finding.source or ruleset.source).items()
                if key not in LEFT_OUT
            }
            for finding in result.findings
        ],
    }
