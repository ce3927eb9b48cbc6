"""The output of `entail`: what is required and forbidden in a situation, and by which clauses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume
from sleec_verify.report.consequence_tree import lines
from sleec_verify.report.escape import as_text
from sleec_verify.report.full import finding_lines
from sleec_verify.wording.phrases import listed, quoted, value_text
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Relation, Ruleset
    from sleec_verify.entailment.answer import ConsequenceStep, Entailment
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.json_values import Json


def _full(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    source = ruleset.source
    for finding in answer.conflicts:
        yield from finding_lines(finding, source, palette)
        yield ""
    if answer.undecided is not None:
        yield joined(": ", [palette("warning", sentence("unknown")), undecided_text(answer.undecided)])
    if answer.consistent is not False:
        required = [joined(", ", answer.obligations)] if answer.obligations else []
        required += [alternative.words for alternative in answer.alternatives]
        for what in required or [sentence("nothing")]:
            yield joined(": ", [palette("strong", sentence("required")), what])
        if answer.prohibitions:
            forbidden = joined(", ", answer.prohibitions)
            yield joined(": ", [palette("strong", sentence("forbidden")), forbidden])
    else:
        where = palette("error", sentence("The rules contradict each other here"))
        yield sentence("{where}, so no obligations are listed.", where=where)
    for because in answer.because:
        line = source.place(because.span).line
        says = joined(" AND ", because.in_words()) or sentence("nothing")
        yield joined("", [f"  {because.layer or because.rule} ({source.path}:{line}): ", says])
    yield from once_done(answer, palette)
    yield from scheduled(answer, context, palette)
    yield from caveats(ruleset, answer, palette)
    yield sentence("reading: {reading}", reading=ruleset.reading)


def _concise(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    del context  # the reader knows the question
    yield from answer.obligations
    yield from (f"NOT {name}" for name in answer.prohibitions)
    yield from (alternative.words for alternative in answer.alternatives)
    if answer.undecided is not None:
        yield joined(": ", [sentence("unknown"), undecided_text(answer.undecided)])
    for finding in answer.conflicts:
        place = ruleset.source.place(finding.span)
        label = palette(finding.severity, f"{finding.severity}[{finding.code}]")
        yield joined(" ", [f"{ruleset.source.path}:{place.line}:{place.column}:", label, finding.message])


def _json(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    from sleec_verify.results.json_values import dump, finding_json, span_json, values_json

    del context, palette  # for programs, which know the question
    source = ruleset.source
    due: list[Json] = [*answer.obligations]
    forbidden: list[Json] = [*answer.prohibitions]
    said: dict[str, Json] = {
        "consistent": answer.consistent,
        "obligations": due,
        "prohibitions": forbidden,
        "because": [
            {
                "rule": b.rule,
                "clause": b.clause,
                "layer": b.layer,
                "obligations": list(b.without_choice),
                **({"alternatives": [one for one in b.choices if one]} if any(b.choices) else {}),
            }
            for b in answer.because
        ],
    }
    # Rare keys are present only if they have a value.
    if answer.undecided is not None:
        said["undecided"] = answer.undecided
    if answer.alternatives:
        said["alternatives"] = [
            {
                "rule": one.rule,
                "clause": one.clause,
                "text": one.words,
                "options": [
                    [
                        {"obligation": o.name, "negated": o.negated, "when": o.when or None, "overdue": o.overdue}
                        for o in option
                    ]
                    for option in one.options
                ],
            }
            for one in answer.alternatives
        ]
    if answer.conflicts:
        said["conflicts"] = [finding_json(finding, source) for finding in answer.conflicts]
    if answer.broken_assumptions:
        said["broken_assumptions"] = [span_json(assume.span, source) for assume in answer.broken_assumptions]
    if answer.unsettled:
        said["unsettled"] = [span_json(law.span, source) for law in answer.unsettled]
    if answer.possible:
        said["possible_with"] = values_json(dict(answer.possible))
    if answer.timed:
        said["timed"] = [{"obligation": o.name, "negated": o.negated, "when": str(o.timing)} for o in answer.timed]
    if answer.chain:
        said["chain"] = _chain_json(answer.chain)
    if answer.at_odds:
        said["at_odds"] = [{"event": event, "forbidden_by": list(by)} for event, by in answer.at_odds]
    if _has_times(answer):
        from sleec_verify.report.schedule import as_json

        said["schedule"] = as_json(answer.schedule)
    if answer.missing:
        said["missing"] = list(answer.missing)
    yield dump(said)


def undecided_text(reason: str) -> str:
    """Why it is not known whether the rules contradict each other."""
    return sentence("it is not known whether the rules contradict each other here: {reason}", reason=reason)


def once_done(answer: Entailment, palette: Palette) -> Iterator[str]:
    """The consequences of doing what is required, if there are any."""
    if answer.chain:
        yield joined("", [palette("strong", sentence("consequences")), ":"])
        yield from lines(answer.chain)


def scheduled(answer: Entailment, context: Context, palette: Palette) -> Iterator[str]:
    """The schedule, if any obligation is not immediate."""
    if not _has_times(answer):
        return
    from sleec_verify.report.schedule import chart, in_words

    yield joined("", [palette("strong", sentence("schedule")), ":"])
    yield from (joined("  ", ["", line]) for line in in_words(answer.schedule))
    yield from (f"    {line}" for line in chart(answer.schedule, context))


def _has_times(answer: Entailment) -> bool:
    return any(not entry.start == entry.end == 0 for entry in answer.schedule)


def _chain_json(steps: tuple[ConsequenceStep, ...]) -> Json:
    return [
        {
            "obligation": step.name,
            "cycle": step.cycle,
            "seen": step.seen,
            "forbidden_by": list(step.forbidden),
            "then": [
                {
                    "rule": because.rule,
                    "clause": because.clause,
                    "obligations": list(because.without_choice),
                    **({"alternatives": [one for one in because.choices if one]} if any(because.choices) else {}),
                    "chain": _chain_json(done),
                }
                for because, done in step.clauses
            ],
        }
        for step in steps
    ]


def caveats(ruleset: Ruleset, answer: Entailment, palette: Palette) -> Iterator[str]:
    """Warnings about the situation: it is excluded by an assumption, or some of its values are not given."""
    for role, text in _caveats(ruleset, answer):
        title = {"warning": sentence("warning"), "note": sentence("note"), "help": sentence("help")}[role]
        yield joined(": ", [palette(role, title), text])


def _caveats(ruleset: Ruleset, answer: Entailment) -> Iterator[tuple[str, str]]:
    with_these = listed(_as_given(answer)) if answer.possible else ""
    if answer.broken_assumptions:
        by = _named(ruleset, answer.broken_assumptions)
        yield "warning", sentence("this situation is excluded by {statements}; checks ignore it", statements=by)
        if answer.possible:
            yield "help", sentence("names that are not given count as false; add {values}", values=with_these)
    elif answer.unsettled:
        names = [quoted(name) for name, _ in answer.possible]
        yield (
            "warning",
            plural(
                len(names),
                "{names} is not given; if every comparison with it is false, this situation is excluded by "
                "{statements}",
                "{names} are not given; if every comparison with them is false, this situation is excluded by "
                "{statements}",
                names=listed(names),
                statements=_named(ruleset, answer.unsettled),
            ),
        )
        yield (
            "help",
            plural(len(names), "give it, for example {values}", "give them, for example {values}", values=with_these),
        )
    for event, forbidding in answer.at_odds:
        yield (
            "warning",
            plural(
                len(forbidding),
                "{event} occurs, but {clauses} forbids it",
                "{event} occurs, but {clauses} forbid it",
                event=quoted(event),
                clauses=listed(map(quoted, forbidding)),
            ),
        )
    if answer.has_windows:
        yield (
            "note",
            sentence(
                "this supposes that no response from before is pending; `sleec-verify check` looks at all histories"
            ),
        )
    if answer.missing:
        yield (
            "note",
            plural(
                len(answer.missing),
                "{names} is not given, so every comparison with it counts as false",
                "{names} are not given, so every comparison with them counts as false",
                names=listed(map(quoted, answer.missing)),
            ),
        )


def _named(ruleset: Ruleset, said: Sequence[Assume | Relation]) -> str:
    """Assumptions and relations by their lines: ``ASSUME (line 3)``."""
    laws: dict[str, list[str]] = {}
    for law in said:
        kind = "ASSUME" if isinstance(law, Assume) else "RELATION"
        laws.setdefault(kind, []).append(str(ruleset.source.place(law.span).line))
    return listed(
        plural(len(lines), "{keyword} (line {lines})", "{keyword} (lines {lines})", keyword=kind, lines=listed(lines))
        for kind, lines in laws.items()
    )


def _as_given(answer: Entailment) -> list[str]:
    """Values with which the situation is possible, as ``--given`` takes them."""
    return [name if value is True else f"{name}={value_text(value)}" for name, value in answer.possible]


RENDERERS: Mapping[str, Callable[[Ruleset, Context, Entailment, Palette], Iterator[str]]] = {
    "full": as_text(_full),
    "concise": as_text(_concise),
    "json": _json,
}
