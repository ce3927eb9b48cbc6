"""Mutants that decide by other rules than they should: what comes of reading, translating or updating them wrongly."""

from __future__ import annotations

from sleec_runtime import Sleec
from tests.support.mutants.robot import mutant, reads


@mutant
def priority_for_cascade() -> Sleec:
    """The last true condition wins, whatever came before it."""
    return reads(reading="priority")


@mutant
def boundary_off_by_one() -> Sleec:
    """Eighteen counts as a minor."""
    return reads(("UserAge < LegalAge", "UserAge <= LegalAge"))


@mutant
def another_constant() -> Sleec:
    """Somebody took legal age for 17."""
    return reads(("LegalAge = 18", "LegalAge = 17"))


@mutant
def scale_off_by_one() -> Sleec:
    """Moderate risk counts as low."""
    return reads(("Risk > low", "Risk > moderate"))


@mutant
def negated_condition() -> Sleec:
    """A condition the wrong way round."""
    return reads(("UNLESS Busy", "UNLESS NOT Busy"))


@mutant
def and_for_or() -> Sleec:
    """Both conditions are asked for where one suffices."""
    return reads(("Undressed OR Distressed", "Undressed AND Distressed"))


@mutant
def guard_ignored() -> Sleec:
    """The rule speaks whether or not its guard is true."""
    return reads(("WHEN Fall AND NOT Asleep", "WHEN Fall"))


@mutant
def domain_ignored() -> Sleec:
    """Rules of the hospital are in force at home."""
    return reads(domain=None)


@mutant
def other_domain() -> Sleec:
    """The robot believes to be in hospital."""
    return reads(domain="hospital")


@mutant
def trigger_ignored() -> Sleec:
    """Nothing happens at mealtimes, because the rule listens to something else."""
    return reads(
        ("WHEN Mealtime", "WHEN MealTime"), ("RULE stop", "RULE spare WHEN Mealtime AND false THEN Inform\nRULE stop")
    )


@mutant
def nested_chain_flattened() -> Sleec:
    """A chain in parentheses is read as if it stood in the outer one."""
    return reads(
        (
            "(AskStatus UNLESS Companion IN WHICH CASE AskCompanion)",
            "AskStatus UNLESS Companion IN WHICH CASE AskCompanion",
        )
    )


@mutant
def hedge_forgotten() -> Sleec:
    """The last hedge of a chain is not read."""
    return reads(("UNLESS Distressed IN WHICH CASE (WarnUser AND OpenCurtains)", ""))


@mutant
def empty_hedge_forgotten() -> Sleec:
    """A hedge with no response does not suppress the default."""
    return reads(("UNLESS Undressed OR Distressed\n", ""), ("AND Walking", "AND (Walking OR Undressed AND Walking)"))


@mutant
def hedges_in_another_order() -> Sleec:
    """The first hedge is looked at second."""
    return reads(
        ("UNLESS Undressed IN", "UNLESS @ IN"), ("UNLESS Distressed IN", "UNLESS Undressed IN"), ("@", "Distressed")
    )


@mutant
def prohibition_for_obligation() -> Sleec:
    """What must not be done is done."""
    return reads(("NOT Speak", "Speak"))


@mutant
def constraint_ignored() -> Sleec:
    """Things that exclude one another are done together."""
    return reads(("EXCLUSIVE RefuseRequest, Stop", ""))


@mutant
def assumption_taken_for_fact() -> Sleec:
    """That nobody walks asleep is taken to say that who does not walk is asleep."""
    return reads(("WHEN Fall AND NOT Asleep", "WHEN Fall AND Walking"))


@mutant
def rules_in_another_order() -> Sleec:
    """The record is written before anything is done."""
    record = "RULE record WHEN CurtainRequest THEN WriteLog\nUNLESS Asleep IN WHICH CASE (WriteLog AND NOT Speak)\n"
    return reads(
        (record, ""),
        ("RULE curtains", f"{record}RULE curtains"),
    )
