"""Rules that, triggered at a bad moment, leave no way to go on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from sleec_runtime.model import Rule, Span
from sleec_verify.checks.base import listed
from sleec_verify.checks.conflict import CONFLICT as OF_SITUATIONS
from sleec_verify.checks.each import each
from sleec_verify.checks.timed.matter import in_words, laws_in, rules_in, traces
from sleec_verify.cone import Cones
from sleec_verify.finding import Finding, Witness
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.ruled import ruled
from sleec_verify.timed.traces import Traces

_BEFORE = "what it called for before"


def _conflicts(cones: Cones) -> Iterator[Finding]:
    """A finding for each rule that, triggered now after a history that breaks nothing, leaves no way to go on that
    keeps all, though without it there would be one."""
    known = traces(cones)

    def of(rule: Rule) -> Iterator[Finding]:
        history = conflict(known.program, rule)
        if history is None:
            return
        others = [name for name in history.matter if name != rule.label]
        words = in_words(known, others)
        if not others and sum(rule.trigger in moment.events for moment in history.timeline.moments) > 1:
            words = [_BEFORE]
        laws = laws_in(known, others)
        now = history.timeline.moments[-1]
        unasked = sorted(_unasked(known, history.matter) & (set(now.events) - {rule.trigger}))
        yield CONFLICT.finding(
            f"{rule.label} can be triggered where it cannot be kept"
            + (f" together with {listed(words)}" if words else ""),
            rule.label_span if rule.labelled else rule.span,
            rules=(rule.label, *rules_in(known, others)),
            obligations=tuple(sorted(_contested(known, history.matter))),
            witness=Witness(now.events, now.conditions),
            timeline=ruled(history.timeline, laws, known.ruleset.measures),
            help=_help(rule, words, rules_in(known, others), unasked),
            related=tuple((span, "with this one") for span in _places(known, others)),
        )

    yield from each(((rule.label, rule) for rule in known.rules), of)


def _places(cones: Traces, matter: Sequence[str]) -> list[Span]:
    """Where the rules and laws that matter stand."""
    rules = (cones.ruleset.by_label[label] for label in rules_in(cones, matter))
    return [
        *(rule.label_span if rule.labelled else rule.span for rule in rules),
        *(law.span for _, law in laws_in(cones, matter)),
    ]


def _help(rule: Rule, words: list[str], rules: tuple[str, ...], unasked: list[str]) -> str:
    if words and not rules and words != [_BEFORE]:
        mend = f"give {rule.label} a hedge for this case, or mend what it cannot be kept with"
    else:
        mend = "decide which should give way, and say so with a hedge" if words else "mend the response"
    if not unasked:
        return mend
    they = "it is" if len(unasked) == 1 else "they are"
    return f"none of these rules calls for {listed(unasked)}: see to it that {they} not done then; or {mend}"


def _unasked(cones: Cones, labels: tuple[str, ...]) -> set[str]:
    """The events that some of these rules forbid, and none calls for."""
    called, forbidden = _said(cones, labels)
    return forbidden - called


def _contested(cones: Cones, labels: tuple[str, ...]) -> set[str]:
    """The events that some of these rules call for and some forbid."""
    called, forbidden = _said(cones, labels)
    return called & forbidden


def _said(cones: Cones, labels: tuple[str, ...]) -> tuple[set[str], set[str]]:
    """The events that these rules call for, and those that they forbid."""
    from sleec_verify.timed.program import responses_of

    said: dict[bool, set[str]] = {False: set(), True: set()}
    for label in labels:
        if label in cones.ruleset.by_label:
            for obligation in responses_of(cones.ruleset.by_label[label]):
                said[obligation.negated].add(obligation.name)
    return said[False], said[True]


CONFLICT = replace(OF_SITUATIONS, run=_conflicts)
