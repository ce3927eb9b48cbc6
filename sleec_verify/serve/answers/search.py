"""The answer to "show me a situation in which ...": a situation for the switches, a proof that there is none, or
unknown."""

from __future__ import annotations

from sleec_runtime.model import Context
from sleec_verify.encoding.budget import Undecided, for_file
from sleec_verify.entailment.situation_search import (
    with_clause,
    with_different_readings,
    with_obligation,
    with_rules,
)
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.json_values import Json
from sleec_verify.serve.answers.situation import scoped
from sleec_verify.serve.answers.vocabulary import values_of_page
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.interest import require_interest
from sleec_verify.serve.session import Session
from sleec_verify.wording.phrases import clause_name, given, listed, occurring, quoted
from sleec_verify.wording.sentence import sentence


def search(session: Session, body: Body) -> dict[str, Json]:
    """A situation as the question asks for it. `none` means that the solver has excluded every situation."""
    ruleset = scoped(session.ruleset(body.text("text")), body)
    index = RulesetIndex(ruleset)
    with for_file(len(ruleset.source.text), require_interest):
        try:
            wanted, found = _asked(index, body.part("question"))
        except Undecided as error:
            return {"answer": "unknown", "situation": None, "sentence": error.message}
    if found is None:
        said = sentence("No situation exists in which {wanted}. This is proved.", wanted=wanted)
        return {"answer": "none", "situation": None, "sentence": said}
    return {
        "answer": "found",
        "situation": {"triggers": [*sorted(found.triggers)], "conditions": values_of_page(found.conditions)},
        "sentence": _found(found, wanted),
    }


def _found(found: Context, wanted: str) -> str:
    holding = {name: value for name, value in found.conditions.items() if value is not False}
    facts = listed([occurring(sorted(found.triggers)), *given(holding)])
    return sentence(
        "When {facts} (and nothing else), {wanted}. The switches show this situation.", facts=facts, wanted=wanted
    )


def _asked(index: RulesetIndex, question: Body) -> tuple[str, Context | None]:
    """What is asked, in words, and a situation. Raises `Undecided`, or `BadRequest` for unknown names."""
    kind = question.text("kind")
    if kind == "obligation":
        name = question.text("obligation")
        if name not in index.ruleset.obligations:
            raise BadRequest(f"no obligation is called {quoted(name)}")
        return _required(name), with_obligation(index, name)
    if kind == "together":
        labels = [_label(index, label) for label in question.texts("rules")]
        if not labels:
            raise BadRequest("the question names no rule")
        rules = listed(map(quoted, labels))
        return sentence("the rules {rules} apply together", rules=rules), with_rules(index, labels)
    if kind == "exception":
        label, number = _label(index, question.text("rule")), question.number("clause")
        rule = index.ruleset.by_label[label]
        if not 0 <= number < len(list(rule.clauses())):
            raise BadRequest(f"rule {quoted(label)} has no clause {number}")
        return sentence("{clause} applies", clause=clause_name(rule, number)), with_clause(index, label, number)
    if kind == "readings":
        found = with_different_readings(index)
        if found is None:
            return sentence("the readings differ"), None
        return sentence("the readings of rule {rule} differ", rule=quoted(found[0])), found[1]
    raise BadRequest(f"no question is called {quoted(kind)}", "ask obligation, together, exception or readings")


def _required(name: str) -> str:
    return sentence("{name} is required without a contradiction", name=quoted(name))


def _label(index: RulesetIndex, label: str) -> str:
    if label not in index.ruleset.by_label:
        raise BadRequest(f"no rule is called {quoted(label)}")
    return label
