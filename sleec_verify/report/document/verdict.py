"""Verdicts that people may quote: what was proved, for which text, under which reading and assumptions."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping
from hashlib import sha256
from typing import TYPE_CHECKING, Literal, NamedTuple

from sleec_runtime.model import RELATIONS, Assume, Relation
from sleec_verify import __version__
from sleec_verify.encoding.trace_scope import has_chains, speaks_of_traces
from sleec_verify.results.finding import Proved, Unknown
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.plain_language import condition_words
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.report.document.content import Content

Standing = Literal["proved", "refuted", "unknown"]


STANDING_WORDS: Mapping[Standing, str] = {
    "proved": sentence("✓ holds"),
    "refuted": sentence("✗ does not hold"),
    "unknown": sentence("? unknown"),
}


MOST_LINES = 5
"""The most assumptions whose lines a verdict names."""


class Verdict(NamedTuple):
    """A verdict on one question: the `statement` that was examined, and the `reason` if it is unknown."""

    check: str
    standing: Standing
    statement: str
    reason: str | None = None


def verdicts(content: Content) -> Iterator[Verdict]:
    """The verdict on each question, in the order of the checks."""
    for result in content.outcome.results:
        statement = STATEMENTS[result.name]
        if isinstance(result.verdict, Proved):
            yield Verdict(result.name, "proved", statement, result.reason)
        elif isinstance(result.verdict, Unknown) and not result.findings:
            yield Verdict(result.name, "unknown", statement, result.verdict.why)
        else:
            reason = result.verdict.why if isinstance(result.verdict, Unknown) else result.reason
            yield Verdict(result.name, "refuted", statement, reason)


def standing(content: Content) -> Standing:
    """Whether it is proved that the rules never contradict each other, in at least one situation."""
    found = {one.check: one.standing for one in verdicts(content)}
    return "refuted" if found.get("assumptions") == "refuted" else found["conflict"]


def headline(content: Content) -> str:
    """The verdict on contradictions in one sentence, which stands on its own."""
    ruleset = content.ruleset
    verdict = next(one.verdict for one in content.outcome.results if one.name == "conflict")
    values = {
        "version": __version__,
        "rules": plural(len(ruleset.rules), "the only rule", "the {number} rules"),
        "path": quoted(ruleset.source.path),
        "scope": scope_words(content),
    }
    if not ruleset.rules:
        return sentence(
            "{path} contains no rules and therefore no contradiction ({scope}).", **_only(values, "path", "scope")
        )
    found = len([finding for finding in content.outcome.deduplicated if finding.check == "conflict"])
    if found:
        contradictions = plural(
            found,
            "{number} contradiction, with a situation that shows it",
            "{number} contradictions, each with a situation that shows it",
        )
        if isinstance(verdict, Unknown):
            return sentence(
                "Refuted: sleec-verify {version} found {contradictions}, in {rules} of {path}, and could not decide "
                "whether there are more ({scope}).",
                contradictions=contradictions,
                **values,
            )
        return sentence(
            "Refuted: sleec-verify {version} found {contradictions}, in {rules} of {path} ({scope}).",
            contradictions=contradictions,
            **values,
        )
    if standing(content) == "refuted":
        return sentence(
            "Nothing is proved: the assumptions of {path} exclude every situation ({scope}).",
            **_only(values, "path", "scope"),
        )
    if isinstance(verdict, Unknown):
        return sentence(
            "Unknown: sleec-verify {version} could not decide whether a situation leads to a contradiction in {rules} "
            "of {path} ({scope}). The reason: {reason}.",
            reason=verdict.why,
            **values,
        )
    if speaks_of_traces(ruleset):
        return sentence(
            "Proved: no course of events leads to a contradiction in {rules} of {path}. sleec-verify {version} "
            "examined every course of events ({scope}).",
            **values,
        )
    return sentence(
        "Proved: no situation leads to a contradiction in {rules} of {path}. sleec-verify {version} examined every "
        "situation ({scope}).",
        **values,
    )


def _only(values: Mapping[str, str], *names: str) -> dict[str, str]:
    return {name: values[name] for name in names}


def scope_words(content: Content) -> str:
    """``exceptions read as a cascade; under the assumption in line 4; examined in each of the domains home and ward;
    SHA-256 of the text 85b0e45b31815e28…``"""
    ruleset, scope = content.ruleset, content.scope
    parts = [
        sentence("exceptions read as a cascade")
        if ruleset.reading == "cascade"
        else sentence("exceptions read by priority"),
        _assumptions_in_short(ruleset),
    ]
    if scope.domain is not None:
        parts.append(sentence("in the domain {domain}", domain=scope.domain))
    elif ruleset.domains:
        names = listed(ruleset.domains)
        number = len(ruleset.domains)
        parts.append(
            plural(number, "examined in the domain {names}", "examined in each of the domains {names}", names=names)
        )
    parts.append(sentence("SHA-256 of the text {fingerprint}…", fingerprint=fingerprint(ruleset)[:16]))
    return joined("; ", parts)


def _assumptions_in_short(ruleset: Ruleset) -> str:
    assumed = _assumptions(ruleset)
    if not assumed:
        return sentence("under no assumptions")
    if len(assumed) > MOST_LINES:
        return plural(len(assumed), "under {number} assumption", "under {number} assumptions")
    lines = listed(str(line) for line in dict.fromkeys(ruleset.source.place(one.span).line for one in assumed))
    return plural(
        len(assumed), "under the assumption in line {lines}", "under the assumptions in lines {lines}", lines=lines
    )


def conditions_of_validity(content: Content) -> Iterator[str]:
    """The sentences that say for what the verdicts hold."""
    ruleset, scope = content.ruleset, content.scope
    if ruleset.reading == "cascade":
        yield sentence(
            "Exceptions are read as a cascade: one exception after the other is examined, up to the first whose "
            "condition is false. The last one before it decides."
        )
    else:
        yield sentence("Exceptions are read by priority: the last exception whose condition is true decides.")
    for one in _assumptions(ruleset):
        line = ruleset.source.place(one.span).line
        if isinstance(one, Assume):
            condition = condition_words(one.formula)
            if one.domains is None or scope.domain is not None:
                yield sentence("It is assumed that {condition} (line {line}).", condition=condition, line=line)
            else:
                yield sentence(
                    "In {domains}, it is assumed that {condition} (line {line}).",
                    domains=listed(one.domains),
                    condition=condition,
                    line=line,
                )
        else:
            yield sentence(
                "It is assumed that this relation holds: {text} (line {line}).",
                text=quoted(ruleset.source.in_one_line(one.span)),
                line=line,
            )
    if not _assumptions(ruleset):
        yield sentence("No situation is excluded by an assumption.")
    if scope.domain is not None:
        yield sentence(
            "Only the rules of the domain {domain}, and those that apply everywhere, were examined.",
            domain=scope.domain,
        )
    elif ruleset.domains:
        yield sentence("The rules were examined in each of their domains: {domains}.", domains=listed(ruleset.domains))
    if content.outcome.untimed == "at":
        yield sentence("A response without a window is due at the instant of its trigger.")
    elif content.outcome.untimed == "eventually":
        yield sentence("A response without a window is due at some time after its trigger.")
    if has_chains(ruleset):
        if scope.chains or speaks_of_traces(ruleset):
            yield sentence("If a response is also a trigger, it triggers rules.")
        else:
            yield sentence("Responses trigger no rules.")
    yield sentence(
        "The verdicts are about the text of the rules. They do not say that the rules are right, or that a robot "
        "follows them."
    )


def fingerprint(ruleset: Ruleset) -> str:
    """The SHA-256 of the bytes of the text."""
    return ruleset.source.sha256 or sha256(ruleset.source.text.encode("utf-8", "surrogateescape")).hexdigest()


def repetition(content: Content) -> str:
    """The command that repeats the verdicts."""
    scope, ruleset = content.scope, content.ruleset
    words = ["sleec-verify", "check", "--reading", ruleset.reading]
    words += [] if scope.domain is None else ["--domain", scope.domain]
    words += [] if content.outcome.untimed is None else ["--untimed", content.outcome.untimed]
    words += [] if scope.chains else ["--no-chains"]
    return shlex.join([*words, "-" if ruleset.source.path == "<stdin>" else ruleset.source.path])


def _assumptions(ruleset: Ruleset) -> list[Assume | Relation]:
    """What excludes situations: the assumptions, and the relations."""
    return [one for one in ruleset.statements if isinstance(one, (Assume, *RELATIONS))]


STATEMENTS: Mapping[str, str] = {
    "conflict": sentence("The rules never contradict each other."),
    "vacuous-conflict": sentence("No rule always leads to a contradiction."),
    "assumptions": sentence("The assumptions do not contradict each other."),
    "dead-rule": sentence("Every rule applies in some situation."),
    "dead-hedge": sentence("Every exception applies in some situation."),
    "redundant-rule": sentence("Every rule has an effect."),
    "redundant-hedge": sentence("Every exception has an effect."),
    "reading": sentence("No rule depends on how several exceptions are read."),
    "unused-name": sentence("Every declared name, and every action of a constraint, is used."),
    "empty-hedge": sentence("Every exception says what to do."),
    "trigger-obligation": sentence("No name is both a trigger and an obligation."),
    "forbidden-input": sentence("No rule forbids an event of the environment."),
    "required-input": sentence("No rule requires an event of the environment."),
    "phrase-keyword": sentence("No phrase contains a keyword in lower case."),
    "confusable": sentence("No names look alike, and no character is invisible or changes the direction of a line."),
    "misread-name": sentence("No name is likely to be misread."),
    "defect": sentence("The text has no errors that other tools accept."),
    "duplicate-rule": sentence("No two rules say the same."),
    "stray-event": sentence("Every event of a concern, purpose or relation occurs in the rules."),
    "constant-condition": sentence("No condition is always true or always false."),
    "zero-window": sentence("Every window has a length."),
    "bare-prohibition": sentence("Every prohibition has a window."),
    "concern": sentence("No concern can happen if every rule is followed."),
    "purpose": sentence("The rules block no purpose."),
    "realizability": sentence("The robot can always follow the rules."),
}
