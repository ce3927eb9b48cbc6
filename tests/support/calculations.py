"""Rulesets that calculate with three measures."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks

TEXT = """def_start
  event A
  event B
  event C
  measure x: numeric
  measure y: numeric
  measure z: numeric
  constant K = 3
def_end
rule_start
%s
rule_end
%s
"""
NEEDS_Z3 = "R1 when A and (({x} + {y}) > 9) then B", "R2 when A and (({x} < 2) and ({y} < 2)) then not B"
BOTH = "R1 when A and (({x} + {y}) > K) then B", "R2 when A and (({x} * {y}) < 0) then not B"
NAMES = ("x", "y", "z")
OPERATORS = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    "=": lambda a, b: a == b,
    "<>": lambda a, b: a != b,
    ">=": lambda a, b: a >= b,
    ">": lambda a, b: a > b,
}


def ruleset_of(*rules: str, more: str = ""):
    return parse(TEXT % ("\n".join(rules), more))


def results(*rules: str, more: str = "", only: list[str] | None = None):
    return {result.name: result.verdict for result in run_checks(ruleset_of(*rules, more=more), only)}


def guard_of(condition: str):
    (rule,) = ruleset_of(f"R1 when A and {condition} then B").rules
    return rule.guard


def worked_out(written: str, known) -> bool:
    """What Python makes of a condition."""
    for name in NAMES:
        written = written.replace(f"{{{name}}}", f"({known[name]})")
    return bool(eval(written.replace("K", "3").replace(" = ", " == ").replace("<>", "!=")))
