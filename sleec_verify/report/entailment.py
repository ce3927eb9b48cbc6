"""The output of `entail`: what is required and forbidden in a situation, and by which clauses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume
from sleec_verify.report.consequence_tree import lines
from sleec_verify.report.escape import as_text
from sleec_verify.report.full import finding_lines
from sleec_verify.results.phrases import listed, quoted, value_text

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
    if answer.consistent:
        yield f"{palette('strong', 'required')}: {', '.join(answer.obligations) or 'nothing'}"
        if answer.prohibitions:
            yield f"{palette('strong', 'forbidden')}: {', '.join(answer.prohibitions)}"
    else:
        yield f"{palette('error', 'The rules contradict each other here')}, so no obligations are listed."
    for because in answer.because:
        line = source.place(because.span).line
        says = " AND ".join(because.in_words()) or "nothing"
        yield f"  {because.layer or because.rule} ({source.path}:{line}): {says}"
    yield from once_done(answer, palette)
    yield from scheduled(answer, context, palette)
    yield from caveats(ruleset, answer, palette)
    yield f"reading: {ruleset.reading}"


def _concise(ruleset: Ruleset, context: Context, answer: Entailment, palette: Palette) -> Iterator[str]:
    del context  # the reader knows the question
    yield from answer.obligations
    yield from (f"NOT {name}" for name in answer.prohibitions)
    for finding in answer.conflicts:
        place = ruleset.source.place(finding.span)
        label = palette(finding.severity, f"{finding.severity}[{finding.code}]")
        yield f"{ruleset.source.path}:{place.line}:{place.column}: {label} {finding.message}"


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
            {"rule": b.rule, "clause": b.clause, "layer": b.layer, "obligations": list(b.obligations)}
            for b in answer.because
        ],
    }
    # Rare keys are present only if they have a value.
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


def once_done(answer: Entailment, palette: Palette) -> Iterator[str]:
    """The consequences of doing what is required, if there are any."""
    if answer.chain:
        yield f"{palette('strong', 'consequences')}:"
        yield from lines(answer.chain)


def scheduled(answer: Entailment, context: Context, palette: Palette) -> Iterator[str]:
    """The schedule, if any obligation is not immediate."""
    if not _has_times(answer):
        return
    from sleec_verify.report.schedule import chart, in_words

    yield f"{palette('strong', 'schedule')}:"
    yield from (f"  {line}" for line in in_words(answer.schedule))
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
                    "obligations": list(because.obligations),
                    "chain": _chain_json(done),
                }
                for because, done in step.clauses
            ],
        }
        for step in steps
    ]


def caveats(ruleset: Ruleset, answer: Entailment, palette: Palette) -> Iterator[str]:
    """Warnings about the situation: it is excluded by an assumption, or some of its values are not given."""
    with_these = listed(_as_given(answer)) if answer.possible else ""
    if answer.broken_assumptions:
        by = _named(ruleset, answer.broken_assumptions)
        yield f"{palette('warning', 'warning')}: this situation is excluded by {by}; checks ignore it"
        if answer.possible:
            yield f"{palette('help', 'help')}: names that are not given count as false; add {with_these}"
    elif answer.unsettled:
        names = [quoted(name) for name, _ in answer.possible]
        are, them = ("is", "it") if len(names) == 1 else ("are", "them")
        by = _named(ruleset, answer.unsettled)
        yield (
            f"{palette('warning', 'warning')}: {listed(names)} {are} not given; if every comparison with {them} is "
            f"false, this situation is excluded by {by}"
        )
        yield f"{palette('help', 'help')}: give {them}, for example {with_these}"
    for event, forbidding in answer.at_odds:
        by = listed(map(quoted, forbidding))
        yield f"{palette('warning', 'warning')}: {quoted(event)} occurs, but {by} {_forbids(forbidding)} it"
    if answer.timed:
        yield (
            f"{palette('note', 'note')}: `entail` does not look for conflicts at later times; `sleec-verify check` does"
        )
    if answer.missing:
        yield (
            f"{palette('note', 'note')}: {listed(map(quoted, answer.missing))} "
            f"{'is' if len(answer.missing) == 1 else 'are'} not given, so every comparison with "
            f"{'it' if len(answer.missing) == 1 else 'them'} counts as false"
        )


def _forbids(by: Sequence[str]) -> str:
    return "forbids" if len(by) == 1 else "forbid"


def _named(ruleset: Ruleset, said: Sequence[Assume | Relation]) -> str:
    """Assumptions and relations by their lines: ``ASSUME (line 3)``."""
    laws: dict[str, list[str]] = {}
    for law in said:
        kind = "ASSUME" if isinstance(law, Assume) else "RELATION"
        laws.setdefault(kind, []).append(str(ruleset.source.place(law.span).line))
    return listed(f"{kind} (line{'s' if len(lines) > 1 else ''} {listed(lines)})" for kind, lines in laws.items())


def _as_given(answer: Entailment) -> list[str]:
    """Values with which the situation is possible, as ``--given`` takes them."""
    return [name if value is True else f"{name}={value_text(value)}" for name, value in answer.possible]


RENDERERS: Mapping[str, Callable[[Ruleset, Context, Entailment, Palette], Iterator[str]]] = {
    "full": as_text(_full),
    "concise": as_text(_concise),
    "json": _json,
}
