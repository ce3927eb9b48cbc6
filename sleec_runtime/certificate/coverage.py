"""Certificates (docs/certificates.md): whether one covers the way in which rules are to be used.

A robot reads its manifest to run only what was certified. It does not check the proofs again:
`sleec-verify certify --check` does so before, and a signature tells the robot that someone with the key has seen to it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.certificate.manifest import Manifest, Required, parse
from sleec_runtime.errors import CertificateRefused, SleecError
from sleec_runtime.support.files import read_file
from sleec_runtime.support.messages import listed

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset

MANIFEST = "manifest.json"
SIGNATURE = "manifest.sig"
"""Ed25519 over the bytes of the manifest, as base64."""

DEMANDED = ("conflict", "vacuous-conflict", "assumptions")
"""The checks that must be proved for rules to be free of conflict: without the last two, there may be no situation at
all, or none that triggers some rule, in which nothing conflicts."""


def read_manifest(folder: str | Path, key: str | Path | None = None) -> Manifest:
    """The manifest of the certificate in `folder`, whose signature fits the public `key` if one is given.

    Raises CertificateRefused where there is none, it is not exactly one of this format, or the signature does not fit.
    """
    path = Path(folder) / MANIFEST
    try:
        data = read_file(path)
    except OSError as error:
        raise CertificateRefused(
            [("no-certificate", f"{folder} is no certificate: its {MANIFEST} cannot be read: {error.strerror}")],
            "`sleec-verify certify FILE -o DIR` makes one",
        ) from None
    if key is not None:
        check_signature(folder, data, key)
    return parse(data, path)


class Use(NamedTuple):
    """How rules are used. `domain` is None where they are used in each of their domains by itself; `untimed` is when a
    response without a window is due, in rules with time. `chains` is whether what is done triggers rules."""

    reading: str
    domain: str | None = None
    untimed: str = "at"
    chains: bool = True


class Uncovered(NamedTuple):
    """Why a certificate does not cover a use: one of the reasons of docs/certificates.md, a sentence on it, and what
    to do about it."""

    reason: str
    message: str
    hint: str


def uncovered(manifest: Manifest, ruleset: Ruleset, use: Use) -> Iterator[Uncovered]:
    """In what a certificate does not cover the use of a ruleset: the text, the reading, the domain, the times."""
    if manifest.sha256 != ruleset.source.sha256:
        yield Uncovered(
            "ruleset-changed",
            f"the certificate is not of these rules: {ruleset.source.path} has other bytes",
            "certify the rules as they are now",
        )
        # Nothing that follows would mean anything.
        return
    if manifest.reading != use.reading:
        yield Uncovered(
            "reading",
            f"the certificate is for the reading {manifest.reading}, not for {use.reading}",
            f"certify the rules with --reading {use.reading}, or use them with the reading {manifest.reading}",
        )
    # Rules without domains are used in one that has no name.
    all_of_them = ruleset.domains or ("",)
    certified = all_of_them if manifest.domain is None else (manifest.domain,)
    used = all_of_them if use.domain is None else (use.domain,)
    if not set(used) <= set(certified):
        yield Uncovered(
            "domain",
            f"the certificate is for {_in_words(manifest.domain, ruleset)}, not for {_in_words(use.domain, ruleset)}",
            "certify the rules without --domain, or use them in the domain of the certificate",
        )
    if manifest.untimed not in (None, use.untimed):
        yield Uncovered(
            "untimed",
            f"the certificate is for --untimed {manifest.untimed}, not for {use.untimed}:"
            " a response without a window is due at another time",
            f"certify the rules with --untimed {use.untimed}, or use them with --untimed {manifest.untimed}",
        )
    if manifest.chains != use.chains and _chains_matter(ruleset, use.domain, use.chains):
        yield Uncovered(
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


class Demand:
    """What a runtime asks of rules before they are in force: the certificate in `folder`, signed by `key` if there is
    one, must cover how the runtime uses them, prove that they are free of conflict, and say that it was made with what
    is `required`. `chains` is whether what is done triggers rules there.

    Raises, when made, what `read_manifest` does.
    """

    def __init__(self, folder: str | Path, key: str | Path | None, chains: bool, required: Required) -> None:
        self._key = key
        self._chains = chains
        self._required = required
        self._manifest = read_manifest(folder, key)

    def of(self, folder: str | Path) -> Demand:
        """The same demand of another certificate."""
        return Demand(folder, self._key, self._chains, self._required)

    def check(self, ruleset: Ruleset, domain: str | None) -> None:
        """Refuse a ruleset that is to be in force in `domain` unless the certificate covers that.

        Raises CertificateRefused.
        """
        problems = list(self._problems(ruleset, domain))
        if problems:
            raise CertificateRefused([(one.reason, one.message) for one in problems], problems[0].hint)

    def _problems(self, ruleset: Ruleset, domain: str | None) -> Iterator[Uncovered]:
        # A response without a window is executed at its trigger.
        found = list(uncovered(self._manifest, ruleset, Use(ruleset.reading, domain, "at", self._chains)))
        yield from found
        if any(one.reason == "ruleset-changed" for one in found):
            return
        if not _is_its_text(ruleset):
            yield Uncovered(
                "ruleset-changed",
                f"the rules are not all and only those of the text of {ruleset.source.path}, which is certified",
                "use the ruleset as it was read, and choose the domain with domain=",
            )
        if domain is None and len(ruleset.domains) > 1 and self._manifest.domain is None:
            yield Uncovered(
                "domain",
                f"the certificate is for each of the domains {listed(ruleset.domains)} by itself",
                "load the rules with domain=",
            )
        verdicts = {name: self._manifest.verdicts.get(name, "missing") for name in DEMANDED}
        open_checks = [f"{name} is {verdict}" for name, verdict in verdicts.items() if verdict != "proved"]
        if open_checks:
            yield Uncovered(
                "conflict",
                f"the certificate does not prove that the rules are free of conflict: {', '.join(open_checks)}",
                "`sleec-verify check` shows the situations in which they are not",
            )
        for name, wanted in self._required._asdict().items():
            if wanted and not getattr(self._manifest.required, name):
                yield Uncovered(
                    f"not-{name}",
                    f"the certificate was made without --require-{name}",
                    f"certify the rules with --require-{name}",
                )


def _is_its_text(ruleset: Ruleset) -> bool:
    """Whether a ruleset says what its text says, whatever its reading: its rules may have been changed since."""
    from sleec_runtime.language import parse_source

    return parse_source(ruleset.source).read_as(ruleset.reading) == ruleset


def _chains_matter(ruleset: Ruleset, domain: str | None, chains: bool) -> bool:
    """Whether anything can be a trigger and be done. Without `chains`, events that trigger no rule are nothing."""
    in_force = ruleset if domain is None else ruleset.in_domain(domain)
    triggers = in_force.triggers if chains else {rule.trigger for rule in in_force.rules}
    return not triggers.isdisjoint(in_force.obligations)


def _refused(reason: str, message: str, hint: str | None = None) -> CertificateRefused:
    return CertificateRefused([(reason, message)], hint)


def check_signature(folder: str | Path, signed: bytes, key: str | Path) -> None:
    """Refuse a manifest of these bytes unless its signature was made with the private half of `key` (a PEM file).

    Raises CertificateRefused; SleecError if the key is none, or the library `cryptography` is not installed.
    """
    from base64 import b64decode

    ed25519, serialization, invalid = cryptography()
    try:
        public = serialization.load_pem_public_key(read_file(key))
    except OSError as error:
        raise SleecError(f"the key {key} cannot be read: {error.strerror}") from None
    except Exception:  # noqa: BLE001 - what a file that is no key raises depends on what it is
        public = None
    if not isinstance(public, ed25519.Ed25519PublicKey):
        raise SleecError(f"{key} is not a public Ed25519 key in PEM", "openssl pkey -in KEY.pem -pubout -out PUB.pem")
    try:
        written = read_file(Path(folder) / SIGNATURE)
    except OSError:
        raise _refused(
            "unsigned", "the certificate is not signed", "sign it: sleec-verify certify FILE -o DIR --sign KEY.pem"
        ) from None
    try:
        public.verify(b64decode(written.strip(), validate=True), signed)
    except (invalid, ValueError):
        raise _refused(
            "signature", "the signature does not fit: the manifest was changed, or signed with another key"
        ) from None


def cryptography() -> tuple[Any, Any, type[Exception]]:
    """What signatures are made and checked with: the modules `ed25519` and `serialization`, and the error of a
    signature that does not fit.

    Raises SleecError if it is not installed.
    """
    try:
        from cryptography.exceptions import InvalidSignature
        from cryptography.hazmat.primitives import serialization
        from cryptography.hazmat.primitives.asymmetric import ed25519
    except ImportError:
        raise SleecError(
            "signatures need the library `cryptography`, which is not installed", "pip install cryptography"
        ) from None
    return ed25519, serialization, InvalidSignature
