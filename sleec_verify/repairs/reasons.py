"""Why a finding has no repair, in one sentence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sleec_runtime.model import Claim, Ruleset, claims, literals
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.results.finding import Finding
from sleec_verify.wording.sentence import sentence


class Refused(NamedTuple):
    """A change that is not a repair, and why."""

    title: str
    why: str


def why_none(ruleset: Ruleset, finding: Finding, refused: Sequence[Refused]) -> str:
    """Why no change that was tried repairs a finding. `refused` are these changes, in the order of the operators."""
    if finding.check == "concern":
        concern = next((one for one in claims(ruleset, "concern") if one.label in finding.obligations), None)
        if concern is not None and _names_only_inputs(ruleset, concern):
            return sentence(
                "no rule can prevent this: it names only what happens around the robot; add a response or an ASSUME"
            )
        if not refused:
            return sentence("no single rule says the opposite of the concern: its responses have alternatives")
    if refused:
        title, why = refused[0]
        return sentence(
            "each change that was tried leaves this finding or leads to another one: if you {title}, {why}",
            title=title,
            why=why,
        )
    if finding.code in OPERATORS:
        return sentence("no change of the text that is tried for such findings applies here; the help says what to do")
    return sentence("no change is tried for such findings, because only you know what is meant; the help says more")


def _names_only_inputs(ruleset: Ruleset, concern: Claim) -> bool:
    """Whether no event of a concern is one that a rule requires or forbids."""
    done = {one.name for rule in ruleset.rules for clause in rule.clauses() for one in literals(clause)}
    responses = {one.name for response in concern.responses for one in literals(response)}
    within = concern.meanwhile is None or _names_only_inputs(ruleset, concern.meanwhile)
    return within and done.isdisjoint({concern.event, *responses})
