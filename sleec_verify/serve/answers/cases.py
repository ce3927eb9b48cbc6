"""Answers about expected cases: those of the file, a new one, and whether the rules meet them."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Ruleset
from sleec_verify.conformance.cases.case import Case
from sleec_verify.conformance.cases.fields import obligations_of
from sleec_verify.conformance.cases.reader import UnfitCase, as_in_cases, read_each
from sleec_verify.conformance.scenarios.expectations import unexpected
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.entailment.entailment import entail
from sleec_verify.report.entailment import undecided_text
from sleec_verify.report.explanation import due_text
from sleec_verify.results.json_values import Json
from sleec_verify.serve.answers.situation import context_of
from sleec_verify.serve.answers.vocabulary import values_of_page
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.session import Session
from sleec_verify.wording.phrases import given, listed, occurring, quoted
from sleec_verify.wording.sentence import joined, plural, sentence


def cases(session: Session, body: Body) -> dict[str, Json]:
    """The cases of the file, for the rules of `text`, or those on disk. `problem` says why they cannot be read."""
    text = body.text_or_none("text")
    path = str(session.cases.path)
    if not session.cases.exists():
        return {"path": path, "cases": [], "problem": None}
    try:
        ruleset = session.ruleset(session.file.state().text or "" if text is None else text)
        _, found = read_each(session.cases.path, ruleset)
    except SleecError as error:
        return {"path": path, "cases": [], "problem": error.message}
    return {"path": path, "cases": [_case(case) for case in found], "problem": None}


def _case(case: Case | Scenario | UnfitCase) -> Json:
    if isinstance(case, UnfitCase):
        return {"name": case.name, "situation": None, "sentence": _unfit(case)}
    if isinstance(case, Scenario):
        number = len(case.steps)
        said = plural(number, "a sequence of events with {number} step", "a sequence of events with {number} steps")
        return {"name": case.name, "situation": None, "sentence": said}
    return {
        "name": case.name,
        "situation": {"triggers": list(case.triggers), "conditions": values_of_page(case.conditions)},
        "sentence": _in_words(case),
        "obligations": list(case.obligations),
        "prohibitions": None if case.prohibitions is None else list(case.prohibitions),
        "conflict": case.conflict,
        "domain": case.domain,
    }


def _in_words(case: Case) -> str:
    """What happens in a case, and what it expects then."""
    events = [occurring(case.triggers)] if case.triggers else []
    situation = listed([*events, *given(case.conditions)] or [sentence("nothing occurs")])
    if case.conflict:
        return sentence("{situation}. Expected: the rules contradict each other.", situation=situation)
    expected = due_text((*case.obligations, *(f"NOT {name}" for name in case.prohibitions or ())))
    return sentence("{situation}. Expected: {expected}.", situation=situation, expected=expected)


def _unfit(case: UnfitCase) -> str:
    return sentence("The case does not fit the rules: {why}", why=case.why)


def add_case(session: Session, body: Body) -> dict[str, Json]:
    """Add a case to the file. Its names are those of `text`, or of the file on disk, whose rules must meet it."""
    text = body.text_or_none("text")
    ruleset = session.ruleset(session.file.state().text or "" if text is None else text)
    name, domain = body.text("name"), body.text_or_none("domain")
    if not name.strip():
        raise BadRequest("the case has no name", "say in a few words what it shows")
    if domain is not None and domain not in ruleset.domains:
        raise BadRequest("the rules have no domain of this name")
    context = context_of(ruleset, body.texts("triggers"), body.values("conditions"))
    due, forbidden = (obligations_of([*body.texts(field)], ruleset) for field in ("obligations", "prohibitions"))
    conflict = body.flag("conflict")
    case = Case(
        name, tuple(sorted(context.triggers)), dict(context.conditions), due, forbidden or None, conflict, domain
    )
    read = as_in_cases(session.cases.path, ruleset) if session.cases.exists() else ruleset
    differences = joined("; ", [*_differences(read if domain is None else read.in_domain(domain), case)])
    if differences:
        other = (body.text_or_none("reading") or ruleset.reading) != read.reading
        hint = f"the cases use the reading {read.reading}" if other else None
        raise BadRequest(f"the rules do not meet this case: {differences}", hint)
    session.cases.add(case)
    return {"path": str(session.cases.path)}


def run_cases(session: Session, body: Body) -> dict[str, Json]:
    """Whether the rules of the text require what each case expects. `digest` is that of the file of cases."""
    ruleset = session.ruleset(body.text("text"))
    digest = session.cases.digest()
    if not session.cases.exists():
        return {"results": [], "digest": digest}
    ruleset, found = read_each(session.cases.path, ruleset)
    return {"results": [_result(ruleset, case) for case in found], "digest": digest}


def _result(ruleset: Ruleset, case: Case | Scenario | UnfitCase) -> Json:
    if isinstance(case, UnfitCase):
        return {"name": case.name, "passed": False, "sentence": _unfit(case)}
    part = ruleset if case.domain is None else ruleset.in_domain(case.domain)
    differences = list(unexpected(part, case) if isinstance(case, Scenario) else _differences(part, case))
    said = joined("; ", differences) if differences else sentence("the rules require what the case expects")
    return {"name": case.name, "passed": not differences, "sentence": said}


def _differences(ruleset: Ruleset, case: Case) -> Iterator[str]:
    """The differences between a case and what the rules require, in words."""
    answer = entail(ruleset, case.context())
    if answer.broken_assumptions:
        yield sentence("an assumption or relation excludes the situation, so the rules say nothing about it")
    elif answer.undecided is not None:
        yield undecided_text(answer.undecided)
    elif not answer.consistent and not case.conflict:
        yield sentence("the rules contradict each other in the situation")
    elif answer.consistent and case.conflict:
        yield sentence("the rules do not contradict each other in the situation")
    elif answer.consistent:
        yield from _compared(case.obligations, answer.with_choices(case.obligations, negated=False), False)
        if case.prohibitions is not None:
            yield from _compared(case.prohibitions, answer.with_choices(case.prohibitions, negated=True), True)


def _compared(expected: tuple[str, ...], found: tuple[str, ...], forbidden: bool) -> Iterator[str]:
    missing, more = _only(expected, found), _only(found, expected)
    if missing:
        names = listed(map(quoted, missing))
        yield (
            sentence("the case expects a prohibition of {names}, but nothing forbids it", names=names)
            if forbidden
            else sentence("the case expects {names}, but no rule requires it", names=names)
        )
    if more:
        names = listed(map(quoted, more))
        yield (
            sentence("the rules forbid {names}, which the case does not expect", names=names)
            if forbidden
            else sentence("the rules require {names}, which the case does not expect", names=names)
        )


def _only(ones: tuple[str, ...], others: tuple[str, ...]) -> list[str]:
    return sorted(set(ones) - set(others))
