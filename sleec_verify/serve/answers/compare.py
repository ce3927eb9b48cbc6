"""The answer to "what does this change do?": two versions compared by meaning."""

from __future__ import annotations

import json

from sleec_verify.changes.compare import compare as compared
from sleec_verify.encoding.budget import for_file
from sleec_verify.report.difference import RENDERERS
from sleec_verify.report.difference_report import DifferenceReport, RulesetDifference
from sleec_verify.report.document.changes import changes, summary
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.json_values import Json
from sleec_verify.serve.body import Body
from sleec_verify.serve.interest import require_interest
from sleec_verify.serve.session import Session


def compare(session: Session, body: Body) -> dict[str, Json]:
    """The output of `diff` for programs, and `sentences` for people. The first of them says how the versions relate."""
    old, new = (session.ruleset(body.text(side)) for side in ("old", "new"))
    with for_file(len(old.source.text) + len(new.source.text), require_interest):
        found = compared(old, new)
    difference = RulesetDifference(session.file.path, found)
    answer: dict[str, Json] = json.loads("".join(RENDERERS["json"](DifferenceReport((difference,)), PLAIN)))
    return {**answer, "sentences": [summary(difference), *changes(difference)]}
