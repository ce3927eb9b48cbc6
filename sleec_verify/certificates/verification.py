"""Verifies a certificate: computes its content again from the text of the rules, and compares."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from sleec_runtime.certificate.coverage import MANIFEST, Use, coverage_problems, read_manifest
from sleec_runtime.certificate.signature import SIGNATURE
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.support.files import read_file
from sleec_verify import __version__
from sleec_verify.certificates.certification import NOTHING_REQUIRED, rebuild
from sleec_verify.certificates.check_evidence import CheckEvidence
from sleec_verify.certificates.manifest import check_json, manifest
from sleec_verify.certificates.theory.trace_oracle import OracleEvaluator
from sleec_verify.certificates.trace_evidence import TEMPLATES, TRACES, Entry, changed_entries
from sleec_verify.certificates.trace_replay import Replayed, TraceReplay
from sleec_verify.certificates.verdict_binding import MOST_SECONDS, UnboundVerdict, VerdictBinding, bind_verdicts
from sleec_verify.certificates.witnesses import KEYS, Replay, same
from sleec_verify.encoding.trace_scope import speaks_of_traces

if TYPE_CHECKING:
    from sleec_runtime.certificate.manifest import Manifest, Required
    from sleec_runtime.model import Reading, Ruleset
    from sleec_verify.certificates.checker import Checker
    from sleec_verify.certificates.manifest import Evidence
    from sleec_verify.encoding.trace_scope import Untimed


class Problem(NamedTuple):
    """A reason for a rejection: its name from docs/certificates.md, and an explanation."""

    reason: str
    message: str


@dataclass(frozen=True)
class CheckedCertificate:
    """A valid certificate: its content, the ruleset in its reading, the checker of its refutations, and whether it is
    signed. `replayed` says which evaluators replayed its traces, and `tied`, for each check, whether the verdicts from
    refutations are tied to the rules.
    """

    ruleset: Ruleset
    manifest: Manifest
    shown: tuple[Evidence, ...]
    checker: Checker
    signed: bool
    replayed: Replayed
    tied: tuple[VerdictBinding, ...] = ()


def check_certificate(
    ruleset: Ruleset,
    folder: str,
    judge: Checker,
    use: Use | None = None,
    required: Required = NOTHING_REQUIRED,
    *,
    key: str | None = None,
    oracle: Path | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> CheckedCertificate:
    """Verify the certificate in `folder` against a ruleset.

    - The files must have the bytes that the manifest states.
    - The verdicts and the formulas are computed again and compared.
    - `judge` checks the refutations, and the evaluator replays the witnesses.
    - The certificate must cover the `use` of the rules: by default, the whole text in its own reading.
    - If there is a public `key`, the certificate must be signed with it.
    - If there is an `oracle`, it builds the formulas again and checks their refutations.
    - The requirements in `required`, and those of the manifest, must hold.

    Raises CertificateRefused with all reasons.
    """
    claimed = read_manifest(folder, key)
    _check_use(ruleset, claimed, Use(ruleset.reading) if use is None else use)
    read = ruleset.read_as(cast("Reading", claimed.reading))
    with ExitStack() as stack:
        evaluator = None if oracle is None else stack.enter_context(OracleEvaluator(oracle, MOST_SECONDS))
        examined = _Examined(read, claimed, Path(folder), judge, TraceReplay(evaluator))
        problems = [*examined.files(), *examined.contents(progress)]
    if (required.proved or claimed.required.proved) and not judge.proved:
        problems.append(Problem("not-proved", f"the proofs are checked by {judge.name}, which is not proved correct"))
    tied: list[VerdictBinding] = []
    for one in () if problems else bind_verdicts(examined.shown, read, claimed.domain, oracle, claimed.chains):
        if isinstance(one, UnboundVerdict):
            problems.append(Problem("theory", str(one)))
        elif not one.proved and (required.tied or claimed.required.tied):
            problems.append(
                Problem("not-tied", f"the verdict of {one.check} is not proved for the rules: {one.reason}")
            )
        else:
            tied.append(one)
    if problems:
        raise CertificateRefused(problems, _hint(claimed, problems))
    signed = (Path(folder) / SIGNATURE).exists()
    replayed = examined.traces.result()
    return CheckedCertificate(read, claimed, tuple(examined.shown), judge, signed, replayed, tuple(tied))


def _check_use(ruleset: Ruleset, claimed: Manifest, use: Use) -> None:
    """Checks that the certificate is about these rules, covers their use, and is not empty."""
    not_covered = list(coverage_problems(claimed, ruleset, use))
    problems = [Problem(one.reason, one.message) for one in not_covered]
    if not problems or problems[0].reason != "ruleset-changed":
        if claimed.domain is not None and claimed.domain not in ruleset.domains:
            problems.append(Problem("manifest", f"{MANIFEST} names a domain that the rules do not have"))
        if (claimed.untimed is None) == speaks_of_traces(ruleset):
            problems.append(Problem("manifest", f"{MANIFEST} does not define what a response without a window means"))
    if problems:
        raise CertificateRefused(problems, not_covered[0].hint if not_covered else None)


def _hint(claimed: Manifest, problems: Sequence[Problem]) -> str | None:
    version = claimed.whole["tool"]["version"]
    if version != __version__:
        return f"version {version} wrote it, and this is version {__version__}; certify the rules again"
    built = {"not-proved": "make -C proofs/checker", "not-tied": "make proofs"}
    needed = [command for reason, command in built.items() if any(one.reason == reason for one in problems)]
    return f"`{'` and `'.join(needed)}`, in a checkout of the sources, builds what is missing" if needed else None


class _Examined:
    """The comparison of a certificate with the text of the rules. It fills `shown` during the comparison."""

    def __init__(self, ruleset: Ruleset, claimed: Manifest, folder: Path, judge: Checker, traces: TraceReplay) -> None:
        self._ruleset = ruleset
        self._claimed = claimed
        self._folder = folder
        self._judge = judge
        self._replay = Replay(ruleset)
        self.traces = traces
        self.shown: list[Evidence] = []

    # Files ----------------------------------------------------------------------------------------------------

    def files(self) -> Iterator[Problem]:
        """Whether the folder has files that the manifest does not name."""
        try:
            there = set(os.listdir(self._folder))
        except OSError as error:
            yield Problem("file-missing", f"the files in {self._folder} cannot be listed: {error.strerror}")
            return
        for name in sorted(there - {MANIFEST, SIGNATURE, *self._claimed.files}):
            yield Problem("file-added", f"{name} is not in {MANIFEST}")

    def _read(self, name: str) -> bytes | Problem:
        """The content of a file. It is read only once, so that the same content is compared and checked."""
        try:
            return read_file(self._folder / name)
        except OSError as error:
            message = f"{name} cannot be read: {error.strerror}"
            return Problem("file-size", message) if error.errno == errno.EFBIG else Problem("file-missing", message)

    # Contents -------------------------------------------------------------------------------------------------

    def contents(self, progress: Callable[[str, int, int], None] | None) -> Iterator[Problem]:
        """Checks the verdicts, the refutations of the formulas, the witnesses and the traces."""
        stored: dict[str, list[Entry]] = {TRACES: [], TEMPLATES: []}
        claimed, ruleset = self._claimed, self._ruleset
        untimed = cast("Untimed", claimed.untimed or "at")
        said = {check["name"]: check for check in claimed.whole["checks"]}
        for rebuilt in rebuild(ruleset, claimed.domain, untimed, progress, examining=True, chains=claimed.chains):
            one = rebuilt.shown()
            self.shown.append(one)
            stored[TRACES] += rebuilt.traces
            stored[TEMPLATES] += rebuilt.templates
            yield from self._formulas(rebuilt)
            entry = said.get(one.result.name)
            if entry is None:
                yield Problem("verdict", f"{MANIFEST} has no verdict of the check {one.result.name}")
            else:
                yield from self._entry(one, entry)
        for name, entries in stored.items():
            yield from self._entries(name, entries)
        digests = {name: claimed.files.get(name, "") for one in self.shown for name in one.files}
        digests.update((name, claimed.files.get(name, "")) for name, entries in stored.items() if entries)
        use = (claimed.domain, claimed.untimed, claimed.chains)
        expected = manifest(ruleset, *use, claimed.required, self.shown, digests)
        for key in expected:
            if key not in ("checks", "tool") and not same(expected[key], claimed.whole[key]):
                yield Problem("manifest", f"the value of {key!r} in {MANIFEST} does not match the rules")
        if list(said) != [one.result.name for one in self.shown if one.result.name in said]:
            yield Problem("manifest", f"{MANIFEST} has unknown checks, or checks in another order")

    def _formulas(self, rebuilt: CheckEvidence) -> Iterator[Problem]:
        for name in rebuilt.formulas:
            formula, proof = f"{name}.cnf", f"{name}.lrat"
            if not {formula, proof} <= set(self._claimed.files):
                yield Problem("file-missing", f"the check {rebuilt.result.name} has no proof {name}")
                continue
            data: list[bytes] = []
            for file in (formula, proof):
                found = self._read(file)
                if isinstance(found, Problem):
                    yield found
                else:
                    data.append(found)
                    if sha256(found).hexdigest() != self._claimed.files[file]:
                        yield Problem("file-changed", f"the hash of {file} does not match {MANIFEST}")
            if len(data) < 2:
                continue
            if data[0] != rebuilt.dimacs(name).encode():
                yield Problem("clauses", f"{formula} is not the formula of the rules")
            else:
                reason = self._judge.refuses(*data)
                if reason is not None:
                    yield Problem("proof", f"{proof} does not refute {formula}: {reason}")

    def _entries(self, name: str, entries: Sequence[Entry]) -> Iterator[Problem]:
        """Checks that a file about traces has the entries that are found now, and replays their traces."""
        if entries and name not in self._claimed.files:
            yield Problem("file-missing", f"the certificate has no {name}")
        elif entries:
            data = self._read(name)
            if isinstance(data, Problem):
                yield data
            else:
                if sha256(data).hexdigest() != self._claimed.files[name]:
                    yield Problem("file-changed", f"the hash of {name} does not match {MANIFEST}")
                yield from (self._rejected(name, message) for message in changed_entries(name, data, entries))
        for entry in entries:
            refusing = self.traces.rejected(entry)
            if refusing is not None:
                yield self._rejected(name, f"{refusing} does not confirm {entry}")

    @staticmethod
    def _rejected(name: str, message: str) -> Problem:
        return Problem("template", message) if name == TEMPLATES else Problem("witness", message)

    def _entry(self, one: Evidence, entry: Mapping[str, Any]) -> Iterator[Problem]:
        """Checks the entry of a check in the manifest against the rules, and replays its witnesses."""
        name = one.result.name
        expected: Mapping[str, Any] = check_json(one, self._ruleset)
        if entry["verdict"] != expected["verdict"]:
            yield Problem(
                "verdict",
                f"the verdict of the check {name} is {expected['verdict']}, but {MANIFEST} says {entry['verdict']}",
            )
            return
        found, claims = expected["findings"], entry["findings"]
        if not same([_but_witness(c) for c in claims], [_but_witness(f) for f in found]):
            yield Problem("findings", f"the findings of the check {name} do not match the rules")
        else:
            for finding, computed, claim in zip(one.result.findings, found, claims):
                if not self._replay.shows(finding, computed, claim):
                    yield Problem(
                        "witness", f"a witness of the check {name} does not show the finding: {finding.message}"
                    )
        if not same({**entry, "findings": None}, {**expected, "findings": None}):
            yield Problem("manifest", f"the entry of the check {name} in {MANIFEST} does not match the rules")


def _but_witness(finding: Mapping[str, Any]) -> Mapping[str, Any]:
    return {key: value for key, value in finding.items() if key not in KEYS}
