"""Guards and hedges that name triggers: what witnesses say of them, and that random rulesets have them."""

from __future__ import annotations

from hypothesis import Phase, find, settings

from sleec_runtime.language import parse
from sleec_runtime.model import Atom, Ruleset, formulas_of, leaves
from sleec_verify.checks import run_checks
from sleec_verify.results.json_values import witness_json
from sleec_verify.wording.phrases import witness_text
from tests.support.small_rulesets import small_rulesets

RULES = "RULE s WHEN A THEN X UNLESS B IN WHICH CASE Y\nRULE b WHEN B THEN Z\nRULE t WHEN C THEN NOT X\n"

# Any example will do.
UNSHRUNK = settings(phases=[Phase.generate])


def test_a_witness_says_what_must_not_occur() -> None:
    (result,) = run_checks(parse(RULES), ["conflict"])
    (finding,) = result.findings
    assert finding.witness is not None
    assert witness_text(finding.witness) == "When `A` and `C` occur, `B` does not occur (whatever else holds)"
    assert witness_json(finding.witness) == {"triggers": ["A", "C"], "conditions": {}, "absent": ["B"]}


def test_a_rule_that_yields_is_in_no_conflict() -> None:
    (result,) = run_checks(parse(RULES.replace("RULE t WHEN C", "RULE t WHEN B")), ["conflict"])
    assert not result.findings


def names_events(ruleset: Ruleset) -> bool:
    found = (leaf for rule in ruleset.rules for formula in formulas_of(rule) for leaf in leaves(formula))
    return any(isinstance(leaf, Atom) and leaf.kind == "trigger" for leaf in found)


def test_small_random_rulesets_have_such_conditions() -> None:
    assert names_events(find(small_rulesets(), names_events, settings=UNSHRUNK))
