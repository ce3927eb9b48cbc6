"""What a runtime requires of the certificate of its rules."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.certificate.coverage import CoverageProblem, Use, coverage_problems, read_manifest
from sleec_runtime.certificate.manifest import Required
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import parse_source
from sleec_runtime.model import Ruleset
from sleec_runtime.support.messages import listed

REQUIRED_CHECKS = ("conflict", "vacuous-conflict", "assumptions")
"""The checks that must be proved for rules to be free of conflict. Without the last two, there may be no situation, or
no situation that triggers some rule, without a conflict."""


class CertificateRequirement:
    """Requires a certificate for rules before they are in force.

    The certificate in `folder` must cover their use, prove that they are free of conflict, and meet the `required`
    options. With a `key`, it must be signed with it. `chains` tells whether responses trigger rules. The constructor
    raises as `read_manifest`.
    """

    def __init__(self, folder: str | Path, key: str | Path | None, chains: bool, required: Required) -> None:
        self._key = key
        self._chains = chains
        self._required = required
        self._manifest = read_manifest(folder, key)

    def of(self, folder: str | Path) -> CertificateRequirement:
        """The same requirement for another certificate."""
        return CertificateRequirement(folder, self._key, self._chains, self._required)

    def check(self, ruleset: Ruleset, domain: str | None) -> None:
        """Raises CertificateRefused unless the certificate covers `ruleset` in `domain`."""
        problems = list(self._problems(ruleset, domain))
        if problems:
            raise CertificateRefused([(one.reason, one.message) for one in problems], problems[0].hint)

    def _problems(self, ruleset: Ruleset, domain: str | None) -> Iterator[CoverageProblem]:
        # A response without a window is executed at its trigger.
        found = list(coverage_problems(self._manifest, ruleset, Use(ruleset.reading, domain, "at", self._chains)))
        yield from found
        if any(one.reason == "ruleset-changed" for one in found):
            return
        if not _is_its_text(ruleset):
            yield CoverageProblem(
                "ruleset-changed",
                f"the rules are not all and only those of the text of {ruleset.source.path}, which is certified",
                "use the ruleset as it was read, and choose the domain with domain=",
            )
        if domain is None and len(ruleset.domains) > 1 and self._manifest.domain is None:
            yield CoverageProblem(
                "domain",
                f"the certificate is for each of the domains {listed(ruleset.domains)} by itself",
                "load the rules with domain=",
            )
        verdicts = {name: self._manifest.verdicts.get(name, "missing") for name in REQUIRED_CHECKS}
        open_checks = [f"{name} is {verdict}" for name, verdict in verdicts.items() if verdict != "proved"]
        if open_checks:
            yield CoverageProblem(
                "conflict",
                f"the certificate does not prove that the rules are free of conflict: {', '.join(open_checks)}",
                "`sleec-verify check` shows the situations in which they are not",
            )
        for name, wanted in self._required._asdict().items():
            if wanted and not getattr(self._manifest.required, name):
                yield CoverageProblem(
                    f"not-{name}",
                    f"the certificate was made without --require-{name}",
                    f"certify the rules with --require-{name}",
                )


def _is_its_text(ruleset: Ruleset) -> bool:
    """Whether `ruleset` is what its text says, apart from the reading: a program may have changed its rules."""
    return parse_source(ruleset.source).read_as(ruleset.reading) == ruleset
