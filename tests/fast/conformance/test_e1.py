"""The paper's experiment E1, correctness: 100 random cases, 8 rules, 800 dispatches against Definition 1."""

from __future__ import annotations

from functools import partial
from random import Random

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.model import Context, formulas_of
from sleec_verify.conformance import Bench
from sleec_verify.conformance.exhaustive import tried
from sleec_verify.conformance.regions import givens
from tests.support.robots import listing_2


def test_100_random_cases_by_8_rules() -> None:
    dice = Random(2026)
    dispatches = 0

    def make(domain: str) -> Sleec:
        sleec = sleec_runtime.load("rulesets/care-robot.sleec", domain=domain)
        listing_2(sleec)
        return sleec

    benches = {domain: Bench(partial(make, domain)) for domain in ("hospital", "household")}
    for _ in range(100):
        domain = dice.choice(sorted(benches))
        with benches[domain].running() as running:
            whole = running.oracle.whole
            formulas = [formula for rule in whole.rules for formula in formulas_of(rule)]
            given = givens(formulas, whole.measures, unreported=False)
            drawn = {one.name: dice.choice(one.values) for one in given}
            facts = {name: value for name, value in drawn.items() if value is not None}
            for rule in whole.rules:
                assert tried(running, Context(frozenset({rule.trigger}), facts)) is None
                dispatches += 1
    assert dispatches == 800
