"""Compare `check` of 10,000 random rules with parsing them, in one warm process.

One ruleset has few findings, and one has 20,000. Times are processor times, the minimum of several rounds, for all
checks without file access.
"""

from __future__ import annotations

from time import process_time

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_verify.checks import run_checks

RULES = 10_000
FEW, MANY = (1, 10.0), (3, 1.5)
"""Hedges and names per rule, so that few rules meet, and that the findings are about 20,000."""

BOUND_FEW, BOUND_MANY = 4, 15


def ratio(hedges: int, names_per_rule: float, rounds: int = 3) -> tuple[float, int]:
    """The processor time of the checks divided by that of parsing, and the number of findings."""
    text = random_rules(RULES, hedges, names_per_rule=names_per_rule)
    parsing, checking, findings = [], [], 0
    for _ in range(rounds):
        start = process_time()
        ruleset = parse(text)
        parsed = process_time()
        findings = sum(len(result.findings) for result in run_checks(ruleset))
        parsing.append(parsed - start)
        checking.append(process_time() - parsed)
    return min(checking) / min(parsing), findings


def main() -> None:
    for (hedges, names), bound in ((FEW, BOUND_FEW), (MANY, BOUND_MANY)):
        times, findings = ratio(hedges, names)
        print(
            f"{RULES:,} rules with {findings:,} findings: check takes {times:.1f} times parsing (at most {bound})",
            flush=True,
        )


if __name__ == "__main__":
    main()
