"""The analysis of a text as JSON. A page that has an earlier analysis gets only the parts that are new."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from hashlib import sha256
from secrets import token_hex
from typing import NamedTuple

from sleec_runtime.model import Rule, Ruleset, Span
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.report.document.verdict import STATEMENTS
from sleec_verify.report.outcome import CheckedRuleset, severity_count, tally
from sleec_verify.results.finding import CheckResult, Finding, Unknown, Witness
from sleec_verify.results.json_values import VERDICTS, Json
from sleec_verify.results.timeline import Timeline
from sleec_verify.serve.answers.vocabulary import names_json, rule_json, values_of_page
from sleec_verify.wording.phrases import in_domains
from sleec_verify.wording.sentence import joined, sentence


class Part(NamedTuple):
    """A rule or a finding, its JSON without its place, and its place. Equal parts of two analyses share `content`."""

    of: Rule | Finding
    content: dict[str, Json]
    span: Span


class Analysis(NamedTuple):
    """The names, rules and findings of a text with the digest `of`. `version` is another one for each analysis."""

    of: str
    version: str
    about: dict[str, Json]
    names: dict[str, Json]
    rules: Mapping[str, Part]
    findings: Mapping[str, Part]

    def json(self, since: Analysis | None) -> dict[str, Json]:
        """The analysis for a page that has `since`. What that has, too, is left out: equal lists of names, and the
        content of rules and findings."""
        return {
            "of": self.of,
            **self.about,
            "names": {kind: names for kind, names in self.names.items() if since is None or since.names[kind] != names},
            "rules": list(_new("label", self.rules, {} if since is None else since.rules)),
            "findings": list(_new("id", self.findings, {} if since is None else since.findings)),
        }


def analysis_of(ruleset: Ruleset, results: Sequence[CheckResult], digest: str, before: Analysis | None) -> Analysis:
    """The analysis of a ruleset, which shares what is equal with the analysis `before`."""
    outcome = CheckedRuleset(ruleset, tuple(results))
    found = outcome.deduplicated
    about: dict[str, Json] = {
        "reading": ruleset.reading,
        "domains": list(ruleset.domains),
        "timed": ruleset.is_timed,
        "checks": [_check(result) for result in results],
        "verdict": _verdict(outcome, found),
    }
    rules = {} if before is None else before.rules
    findings = {} if before is None else before.findings
    return Analysis(
        digest,
        token_hex(8),
        about,
        names_json(ruleset),
        {rule.label: _rule(rule, rules.get(rule.label)) for rule in ruleset.rules},
        {name: _finding(name, one, findings.get(name)) for name, one in identified(found)},
    )


def identified(findings: Sequence[Finding]) -> list[tuple[str, Finding]]:
    """Each finding with an identifier that does not depend on its place in the text."""
    seen: Counter[str] = Counter()
    found = []
    for one in findings:
        identifier = _digest((one.code, one.message, one.rules, one.clauses, one.obligations, one.domains))
        seen[identifier] += 1
        found.append((f"{identifier}-{seen[identifier]}", one))
    return found


def finding_of_page(finding: Finding) -> dict[str, Json]:
    """What the page shows of a finding."""
    return {
        "code": finding.code,
        "severity": finding.severity,
        "sentence": joined("", [finding.message, in_domains(finding.domains)]),
        "domain": finding.domains[0] if finding.domains else None,
        "help": finding.help,
        "witness": None if finding.witness is None else _situation(finding.witness),
        "timeline": None if finding.timeline is None else _events(finding.timeline),
    }


def _situation(witness: Witness) -> Json:
    return {"triggers": list(witness.triggers), "conditions": values_of_page(witness.conditions)}


def _events(timeline: Timeline) -> Json:
    """The events up to the present instant, and the values that matter there. Those of a complete trace are only those
    on which the obligations depend."""
    fixed = timeline.moments if timeline.now is None else timeline.moments[: timeline.now + 1]
    return [
        {
            "time": moment.time,
            "events": list(moment.events),
            "conditions": values_of_page(
                moment.conditions
                if timeline.now is not None
                else {name: moment.conditions[name] for name in moment.telling}
            ),
        }
        for moment in fixed
    ]


def _new(name: str, parts: Mapping[str, Part], known: Mapping[str, Part]) -> Iterator[Json]:
    for key, (_, content, span) in parts.items():
        other = known.get(key)
        place: dict[str, Json] = {name: key, "start": span.start, "end": span.end}
        yield place if other is not None and other.content is content else {**content, **place}


def _rule(rule: Rule, before: Part | None) -> Part:
    return Part(rule, before.content if before is not None and before.of == rule else rule_json(rule), rule.span)


def _finding(identifier: str, finding: Finding, before: Part | None) -> Part:
    content = {"id": identifier, **finding_of_page(finding), "repairs": finding.code in OPERATORS}
    return Part(finding, before.content if before is not None and before.content == content else content, finding.span)


def _verdict(outcome: CheckedRuleset, findings: Sequence[Finding]) -> str:
    """Whether the rules contradict each other, and the number of findings."""
    found = [severity_count(number, severity) for severity, number in tally(findings).items() if number]
    counts = joined(", ", found) if found else sentence("none")
    verdict = next(one.verdict for one in outcome.results if one.name == "conflict")
    if any(finding.check == "conflict" for finding in findings):
        return sentence("The rules contradict each other. Findings: {counts}.", counts=counts)
    if isinstance(verdict, Unknown):
        return sentence("It is unknown whether the rules contradict each other. Findings: {counts}.", counts=counts)
    return sentence("Proved: the rules never contradict each other. Findings: {counts}.", counts=counts)


def _check(result: CheckResult) -> Json:
    verdict = result.verdict
    return {
        "name": result.name,
        "statement": STATEMENTS[result.name],
        "verdict": VERDICTS[type(verdict)],
        "reason": verdict.why if isinstance(verdict, Unknown) else result.reason,
    }


@lru_cache(maxsize=20_000)
def _digest(about: tuple[object, ...]) -> str:
    return sha256(ascii(about).encode()).hexdigest()[:12]
