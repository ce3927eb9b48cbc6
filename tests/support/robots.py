"""Robots to try rules on: written as the paper's Listing 2 has it, for any ruleset, logging what they execute."""

from __future__ import annotations

import contextpy3 as cop

from sleec_runtime import Sleec
from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.language import parse
from sleec_runtime.model import Clause, Ruleset

CURTAINS = """
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS UserDistressed IN WHICH CASE (WarnUser AND OpenCurtains)
"""


def running(text: str, **options) -> Sleec:
    return Sleec(parse(text), **options)


class Log:
    """What a robot executed, in order."""

    def __init__(self) -> None:
        self.log: list[str] = []

    def do(self, name: str) -> None:
        recorded(name, self.log.append)(name)

    def taken(self) -> list[str]:
        """The log, which is empty afterwards."""
        log, self.log = self.log, []
        return log


def robot_source(ruleset: Ruleset) -> str:
    """The source of a class `Robot` with a method a rule and a variant a clause, properly structured."""
    lines = ["class Robot(Log):"]
    for place, rule in enumerate(ruleset.rules):
        for number, clause in enumerate(rule.clauses()):
            if number:
                lines.append(f"    @cop.around(sleec.layers[{rule.layer(number)!r}])")
            else:
                lines += [f"    @sleec.rule({rule.label!r})", "    @cop.base"]
            lines.append(f"    def rule_{place}(self, *args): {_body(clause)}")
    return "\n".join(lines)


def _body(clause: Clause) -> str:
    calls = [f"self.do({literal.name!r})" for literal in clause.obligations if not literal.negated]
    return "; ".join(calls) or "pass"


def listing_2(sleec: Sleec, ruleset: Ruleset | None = None) -> Log:
    """A robot for the rules in force (or for `ruleset`), bound to them."""
    namespace: dict[str, object] = {"Log": Log, "cop": cop, "sleec": sleec}
    exec(robot_source(ruleset or sleec.ruleset), namespace)
    robot: Log = namespace["Robot"]()  # type: ignore[operator]
    sleec.bind(robot)
    return robot
