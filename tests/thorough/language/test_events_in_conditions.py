"""Guards and hedges that name the trigger of a rule: it occurs at the same instant, or it does not."""

from __future__ import annotations

import pytest
from hypothesis import Phase, find, settings

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Atom, formulas_of, leaves
from tests.support.strategies import rulesets

# Any example will do.
UNSHRUNK = settings(phases=[Phase.generate])


def kinds(text: str) -> dict[str, str]:
    ruleset = parse(text)
    return {
        leaf.name: leaf.kind
        for rule in ruleset.rules
        for formula in formulas_of(rule)
        for leaf in leaves(formula)
        if isinstance(leaf, Atom)
    }


STRANGER = "RULE stranger WHEN a stranger comes THEN lock the door UNLESS the fire alarm rings\n"
FIRE = "RULE fire WHEN the fire alarm rings THEN open the door\n"
DSL = "def_start event A event B event X event Y measure c: boolean def_end\nrule_start\n{}\nrule_end"


@pytest.mark.parametrize("text", [STRANGER + FIRE, FIRE + STRANGER, FIRE.replace("WHEN", "IF") + STRANGER])
def test_a_hedge_may_name_the_trigger_of_any_rule(text: str) -> None:
    assert kinds(text) == {"the fire alarm rings": "trigger"}
    assert parse(text).triggers == {"a stranger comes", "the fire alarm rings"}
    assert not parse(text).conditions


@pytest.mark.parametrize("declaration", ["TRIGGER A, B", "EVENT A, B BY environment EVENT X", "EVENT A, B, X"])
def test_a_declared_trigger_needs_no_rule(declaration: str) -> None:
    assert kinds(f"{declaration} WHEN A AND NOT B THEN X UNLESS B OR c") == {"B": "trigger", "c": "condition"}


@pytest.mark.parametrize(
    "text",
    [
        "WHEN B THEN Y WHEN A AND c THEN X WITHIN 5 minutes OTHERWISE (Y UNLESS B)",
        "WHEN B THEN Y WHEN A AND c THEN (X UNLESS B IN WHICH CASE Y)",
        DSL.format("R1 when B then Y\nR2 when A and c then X unless B then Y"),
        DSL.format("R1 when B then Y\nR2 when A and (c and not B) then X"),
        DSL.format("R1 when A and ({c} and (not B)) then X within 3 minutes otherwise {Y unless B}"),
    ],
)
def test_wherever_a_condition_of_a_rule_stands(text: str) -> None:
    assert kinds(text) == {"B": "trigger", "c": "condition"}
    assert parse(print_ruleset(parse(text))) == parse(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "CONDITION B WHEN A THEN X UNLESS B WHEN B THEN Y",
            "`B` is used as a trigger here, and declared as a condition",
        ),
        ("WHEN A THEN X UNLESS B WHEN B THEN Y RELATION ALWAYS B IMPLIES c", "`B` is used as a condition here"),
        ("WHEN A THEN X UNLESS Y WHEN B THEN Y", "`Y` is used as an obligation here, and used as a condition"),
        (DSL.format("R1 when A then X unless {B}"), "`B` is an event (line 1), but a condition is needed here"),
        (DSL.format("R1 when A then X unless B = true"), "`B` is an event (line 1), but a condition is needed here"),
    ],
)
def test_what_is_no_event_in_a_condition_stays_refused(text: str, message: str) -> None:
    with pytest.raises(LanguageError) as caught:
        parse(text)
    assert message in str(caught.value)


def test_random_rulesets_have_such_conditions() -> None:
    found = find(rulesets(max_rules=2), lambda one: "trigger" in kinds(print_ruleset(one)).values(), settings=UNSHRUNK)
    assert parse(print_ruleset(found)).rules == found.rules
