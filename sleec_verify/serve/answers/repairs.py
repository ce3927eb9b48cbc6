"""The answer to "how can I repair this?": verified repairs with their effects and the changed text."""

from __future__ import annotations

from difflib import unified_diff

from sleec_verify.encoding.budget import limited
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.repair_phrases import effect_in_words
from sleec_verify.results.json_values import Json
from sleec_verify.serve.analysis import identified
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.interest import require_interest
from sleec_verify.serve.session import Session

_SECONDS = 30
"""The time for a search. Repairs that are not found by then are missing, and the answer says so."""


def repairs(session: Session, body: Body) -> dict[str, Json]:
    """The repairs of a finding, what takes away least first. `unknown` says why there may be more, or why there is
    none."""
    ruleset = session.ruleset(body.text("text"))
    results = session.check(ruleset)
    wanted = body.text("finding")
    for identifier, finding in identified(CheckedRuleset(ruleset, results).deduplicated):
        if identifier == wanted:
            with limited(_SECONDS, require_interest):
                search = RepairSearch(ruleset, results)
                found = search.repairs(finding)
                return {
                    "repairs": [_repair(ruleset.source.text, one) for one in found],
                    "unknown": search.undecided or search.reason,
                }
    raise BadRequest("the text has no such finding", "check it again")


def _repair(text: str, repair: Repair) -> Json:
    new = repair.repaired.source.text
    lines = unified_diff(text.splitlines(), new.splitlines(), lineterm="", n=1)
    return {
        "title": repair.candidate.title,
        "kind": repair.candidate.operator,
        "effect": [effect_in_words(repair)],
        "keeps_meaning": repair.effect.keeps_meaning,
        "text": new,
        "diff": "\n".join([*lines][2:]),
    }
