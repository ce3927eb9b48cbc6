"""Whether a certificate covers the use of rules (docs/certificates.md).

A robot reads the manifest of a certificate to run only certified rules. It does not check the proofs again:
`sleec-verify certify --check` does, and a signature tells the robot that the owner of the key has run it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from sleec_runtime.certificate.manifest import Manifest, parse
from sleec_runtime.certificate.signature import check_signature
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.model import Ruleset
from sleec_runtime.support.files import read_file
from sleec_runtime.support.messages import listed

MANIFEST = "manifest.json"
"""The file with the manifest."""


def read_manifest(folder: str | Path, key: str | Path | None = None) -> Manifest:
    """The manifest of the certificate in `folder`. With a public `key`, its signature is checked.

    Raises CertificateRefused if it is missing, malformed or of another format, or if the signature is wrong.
    """
    path = Path(folder) / MANIFEST
    try:
        data = read_file(path)
    except OSError as error:
        raise CertificateRefused(
            [("no-certificate", f"{folder} is not a certificate: its {MANIFEST} cannot be read: {error.strerror}")],
            "`sleec-verify certify FILE -o DIR` makes one",
        ) from None
    if key is not None:
        check_signature(folder, data, key)
    return parse(data, path)


class Use(NamedTuple):
    """How rules are used.

    `domain` is None if they are used in each of their domains separately. `untimed` says when a response without a
    window is due, in rules with time. `chains` tells whether responses trigger rules.
    """

    reading: str
    domain: str | None = None
    untimed: str = "at"
    chains: bool = True


class CoverageProblem(NamedTuple):
    """Why a certificate does not cover a use: one of the reasons in docs/certificates.md, a message, and a hint."""

    reason: str
    message: str
    hint: str


def coverage_problems(manifest: Manifest, ruleset: Ruleset, use: Use) -> Iterator[CoverageProblem]:
    """The reasons why a certificate does not cover the use of a ruleset: its text, reading, domain and times."""
    if manifest.sha256 != ruleset.source.sha256:
        yield CoverageProblem(
            "ruleset-changed",
            f"the certificate is not of these rules: {ruleset.source.path} has other bytes",
            "certify the rules as they are now",
        )
        # The other comparisons would be meaningless.
        return
    if manifest.reading != use.reading:
        yield CoverageProblem(
            "reading",
            f"the certificate is for the reading {manifest.reading}, not for {use.reading}",
            f"certify the rules with --reading {use.reading}, or use them with the reading {manifest.reading}",
        )
    # Rules without domains have one domain without a name.
    all_of_them = ruleset.domains or ("",)
    certified = all_of_them if manifest.domain is None else (manifest.domain,)
    used = all_of_them if use.domain is None else (use.domain,)
    if not set(used) <= set(certified):
        yield CoverageProblem(
            "domain",
            f"the certificate is for {_in_words(manifest.domain, ruleset)}, not for {_in_words(use.domain, ruleset)}",
            "certify the rules without --domain, or use them in the domain of the certificate",
        )
    if manifest.untimed not in (None, use.untimed):
        yield CoverageProblem(
            "untimed",
            f"the certificate is for --untimed {manifest.untimed}, not for {use.untimed}:"
            " a response without a window is due at another time",
            f"certify the rules with --untimed {use.untimed}, or use them with --untimed {manifest.untimed}",
        )
    if manifest.chains != use.chains and _chains_matter(ruleset, use.domain, use.chains):
        yield CoverageProblem(
            "chains",
            "the certificate counts chains (responses that trigger other rules), and this use does not"
            if manifest.chains
            else "the certificate does not count chains (responses that trigger other rules), and this use does",
            "load the rules with chains=True, leave out --no-chains, or certify them with --no-chains"
            if manifest.chains
            else "load the rules with chains=False, use --no-chains, or certify them without --no-chains",
        )


def _in_words(domain: str | None, ruleset: Ruleset) -> str:
    if domain is not None:
        return f"the domain {domain}"
    return f"each of the domains {listed(ruleset.domains)}" if ruleset.domains else "rules without domains"


def _chains_matter(ruleset: Ruleset, domain: str | None, chains: bool) -> bool:
    """Whether a response can be a trigger. Without `chains`, only triggers of rules count."""
    in_force = ruleset if domain is None else ruleset.in_domain(domain)
    triggers = in_force.triggers if chains else {rule.trigger for rule in in_force.rules}
    return not triggers.isdisjoint(in_force.obligations)
