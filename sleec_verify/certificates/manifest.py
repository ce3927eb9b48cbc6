"""The manifest of a certificate: the text, the reading, the verdicts and their evidence.

It does not depend on the time, the machine or its speed: the same rules give the same bytes.
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
"""The parts of a finding for readers, which are not part of a certificate."""


FORMULAS = "that the formulas are those of the rules"
"""What the oracle certifies, for rules that the theory covers."""


class Uncertified(NamedTuple):
    """`what` is not certified, because of `why`."""

    what: str
    why: str


class Evidence(NamedTuple):
    """A verdict and its evidence: the number of refuted questions, the number of models (situations), the names of the
    files with the proofs, the number of traces in the file of traces, and what is not certified. The files alternate
    between formula and refutation."""

    result: CheckResult
    refuted: int
    models: int
    files: tuple[str, ...]
    traces: int = 0
    uncertified: tuple[Uncertified, ...] = ()

    @property
    def evidence(self) -> str:
        """The kind of evidence.

        - ``proof``: refutations of formulas.
        - ``trivial``: no question had to be refuted, so the formula is only the empty clause.
        - ``witnesses``: a witness for each finding.
        - ``situations``: every question had a model, so nothing was found.
        - ``traces``: the same, and each model is a trace in the file of traces.
        - ``text``: the check needs no solver.
        - ``none``: the verdict is unknown.
        """
        verdict = self.result.verdict
        if isinstance(verdict, Unknown):
            return "none"
        if self.files:
            return "proof" if self.refuted else "trivial"
        if isinstance(verdict, Refuted) and all(finding.witness for finding in verdict.findings):
            return "witnesses"
        if self.models:
            return "situations"
        return "traces" if self.traces else "text"


def manifest(
    ruleset: Ruleset,
    domain: str | None,
    untimed: str | None,
    chains: bool,
    required: Required,
    shown: Sequence[Evidence],
    files: Mapping[str, str],
) -> dict[str, Json]:
    """The manifest. `untimed` is None for rules without time. `chains` says whether responses trigger rules.
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
    """The entry of one check in the manifest."""
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
        "traces": one.traces,
        "uncertified": [{"what": missing.what, "why": missing.why} for missing in one.uncertified],
        "findings": [
            {
                key: value
                for key, value in finding_json(finding, finding.source or ruleset.source).items()
                if key not in LEFT_OUT
            }
            for finding in result.findings
        ],
    }
