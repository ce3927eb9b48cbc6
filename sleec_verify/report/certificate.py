"""The output of `certify`, for people and for programs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.manifest import FORMULAS, Uncertified
from sleec_verify.report.escape import as_text
from sleec_verify.results.finding import Refuted
from sleec_verify.results.json_values import VERDICTS, Json, dump
from sleec_verify.wording.phrases import counted, listed

if TYPE_CHECKING:
    from sleec_runtime.errors import CertificateRefused
    from sleec_runtime.model import Ruleset
    from sleec_verify.certificates.checker import Checker
    from sleec_verify.certificates.manifest import Evidence
    from sleec_verify.certificates.trace_replay import Replayed
    from sleec_verify.certificates.verdict_binding import VerdictBinding
    from sleec_verify.results.finding import Verdict

SHOWN_BY = {
    "trivial": "no question to refute",
    "witnesses": "witnesses",
    "situations": "situations, recomputed by --check",
    "traces": "traces",
    "text": "from the text of the rules",
    "none": "no proof, because there is no verdict",
}


def render(
    form: str,
    ruleset: Ruleset,
    folder: str,
    manifest: Mapping[str, Any],
    shown: Sequence[Evidence],
    judge: Checker | None,
    tied: Sequence[VerdictBinding] = (),
    replayed: Replayed | None = None,
) -> Iterator[str]:
    """That a certificate that says `manifest` was written, or (`judge`) that it holds, and how its verdicts are tied to
    the rules."""
    if form == "json":
        yield dump(_json(ruleset, folder, manifest, shown, judge, tied, replayed))
    else:
        yield from _in_words(ruleset, folder, manifest, shown, judge, tied, replayed)


@as_text
def _in_words(
    ruleset: Ruleset,
    folder: str,
    manifest: Mapping[str, Any],
    shown: Sequence[Evidence],
    judge: Checker | None,
    tied: Sequence[VerdictBinding],
    replayed: Replayed | None,
) -> Iterator[str]:
    made = "a certificate" if judge is None else "valid certificate"
    yield f"{folder}: {made} of {ruleset.source.path} ({scope_text(manifest)})"
    widest = max(len(one.result.name) for one in shown)
    for one in shown:
        yield f"  {one.result.name:{widest}}  {VERDICTS[type(one.result.verdict)]:8}  {_shown_by(one)}"
    if replayed is not None and replayed.traces:
        yield from _replayed(replayed)
    if judge is not None:
        yield from _uncertified(shown, tied)
        if judge is IN_PYTHON:
            more = "; `make -C proofs/checker` builds a checker that is proved correct"
        else:
            more = ", which is proved correct" if judge.proved else ""
        yield f"proofs checked by {judge.name}{more}"
    verdicts = {one.result.name: one.result.verdict for one in shown}
    for one_tied in tied:
        yield _tied(one_tied, verdicts[one_tied.check])


def scope_json(manifest: Mapping[str, Any]) -> dict[str, Json]:
    """What a certificate is for, for programs."""
    return {key: manifest[key] for key in ("reading", "domain", "untimed", "chains", "required")}


def scope_text(manifest: Mapping[str, Any]) -> str:
    """What a certificate is for."""
    words = [f"reading {manifest['reading']}"]
    domains = manifest["ruleset"]["domains"] if manifest["domain"] is None else [manifest["domain"]]
    if domains:
        words.append(f"each of the domains {', '.join(domains)}" if len(domains) > 1 else f"domain {domains[0]}")
    if manifest["untimed"] is not None:
        words.append(f"untimed {manifest['untimed']}")
    words.append("with chains" if manifest["chains"] else "without chains")
    words += [f"required: {name}" for name, required in manifest["required"].items() if required]
    return "; ".join(words)


def _tied(tied: VerdictBinding, verdict: Verdict) -> str:
    if not tied.proved:
        return f"{tied.check}: not proved that the formula is the one of the rules: {tied.reason}"
    if isinstance(verdict, Refuted):
        what = f"{counted(len(verdict.findings), 'finding')} proved"
    elif tied.check == "vacuous-conflict":
        what = "proved that the other rules are never triggered"
    else:
        what = "proved"
    return f"{tied.check}: {what} for the parsed rules, by the program extracted from the theory in Coq"


def _replayed(replayed: Replayed) -> Iterator[str]:
    by_oracle = "" if replayed.reasons else ", and by the one extracted from the theory in Coq"
    yield f"{counted(replayed.traces, 'trace')} confirmed by the evaluator in Python{by_oracle}"
    for reason, number in replayed.reasons.items():
        yield f"{counted(number, 'trace')} not replayed by the evaluator extracted from the theory in Coq: {reason}"


def _uncertified(shown: Sequence[Evidence], tied: Sequence[VerdictBinding]) -> Iterator[str]:
    """What is not certified, each with its checks, except what `_tied` says."""
    known = {one.check for one in tied}
    found: dict[Uncertified, list[str]] = {}
    for one in shown:
        for missing in one.uncertified:
            if missing.what != FORMULAS or one.result.name not in known:
                found.setdefault(missing, []).append(one.result.name)
    for missing, names in found.items():
        yield f"not certified for {listed(names)}: {missing.what}: {missing.why}"


def _uncertified_json(shown: Sequence[Evidence], tied: Sequence[VerdictBinding]) -> Json:
    """For each check, what is not certified and why."""
    found: dict[str, Json] = {}
    for one in shown:
        missing = list(one.uncertified)
        if all(known.what != FORMULAS for known in missing):
            missing += (
                Uncertified(FORMULAS, str(t.reason)) for t in tied if t.check == one.result.name and not t.proved
            )
        if missing:
            found[one.result.name] = [{"what": known.what, "why": known.why} for known in missing]
    return found


def _shown_by(one: Evidence) -> str:
    traces = f"; {counted(one.traces, 'trace')}" if one.traces else ""
    if one.evidence != "proof":
        return f"{SHOWN_BY[one.evidence]}{traces}"
    return f"{counted(one.refuted, 'question')} refuted: {', '.join(one.files)}{traces}"


def _json(
    ruleset: Ruleset,
    folder: str,
    manifest: Mapping[str, Any],
    shown: Sequence[Evidence],
    judge: Checker | None,
    tied: Sequence[VerdictBinding],
    replayed: Replayed | None,
) -> Json:
    checks: list[Json] = [
        {
            "name": one.result.name,
            "verdict": VERDICTS[type(one.result.verdict)],
            "evidence": one.evidence,
            "files": list(one.files),
            "traces": one.traces,
        }
        for one in shown
    ]
    return {
        "certificate": folder,
        "path": ruleset.source.path,
        "sha256": ruleset.source.sha256,
        **scope_json(manifest),
        **({} if judge is None else {"holds": True, "checker": {"name": judge.name, "proved": judge.proved}}),
        **({} if judge is None else {"theory": {t.check: {"proved": t.proved, "reason": t.reason} for t in tied}}),
        **({} if replayed is None else {"traces": _replayed_json(replayed)}),
        "uncertified": _uncertified_json(shown, tied),
        "checks": checks,
    }


def _replayed_json(replayed: Replayed) -> Json:
    """The number of traces, the number that the evaluator extracted from Coq replayed, and the reasons for the others,
    each with its number."""
    return {"found": replayed.traces, "by_oracle": replayed.by_oracle, "not_by_oracle": dict(replayed.reasons)}


def render_refusal(folder: str, refusal: CertificateRefused) -> Iterator[str]:
    """Why a certificate is rejected, for programs."""
    problems: list[Json] = [{"reason": reason, "message": message} for reason, message in refusal.problems]
    yield dump({"certificate": folder, "holds": False, "problems": problems})
