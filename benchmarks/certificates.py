"""Measure certificates of 1,000 rules, and of the studies.

Writing a certificate takes at most twice the time of `check`. Checking one takes at most five times as long as the
check. There are three rulesets with three hedges for each rule: random rules, with witnesses for their conflicts; rules
that never conflict, with a refutation for every minimal inconsistent set; and rules that do not depend on the reading,
with a refutation for every rule. Times are processor times of one process, medians of some rounds. They include the
checker and the oracle that are proved in Coq, if these are built.

For rules with time, the certificate of each of our studies takes at most three times as long as its check, check
included. So does that of each published study. These are not part of this project: give their folder with
``python -m benchmarks.certificates FOLDER``.
"""

from __future__ import annotations

import random
import resource
import statistics
import sys
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path

from benchmarks.random_rules import random_rules
from benchmarks.studies import OWN
from sleec_runtime.language import load
from sleec_runtime.model import Ruleset
from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import checker
from sleec_verify.certificates.directory import write_folder
from sleec_verify.certificates.theory.oracle import built
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Proved

RULES = 1_000
TURNS = 3
WRITING, CHECKING, STUDIES = 2, 5, 3
"""How many times the time of `check` writing a certificate, the check included, and checking one may take. `STUDIES`:
writing that of a study."""


def harmless_rules(count: int, seed: int = 0) -> str:
    """`count` rules with three hedges, two for each trigger, that never conflict.

    Two rules of one trigger oblige and forbid the same under disjoint conditions. Triggers that share an obligation
    never occur together.
    """
    draw = random.Random(seed)
    lines = []
    for number in range(count // 2):
        done = f"Obligation{number // 2}"
        one, other, third = draw.sample([f"Condition{number}_{name}" for name in "abcd"], 3)
        if number % 2:
            lines.append(f"ASSUME NOT (Trigger{number} AND Trigger{number - 1})")
        lines += [
            f"RULE do{number}",
            f"WHEN Trigger{number} THEN {done}",
            f"UNLESS {one} IN WHICH CASE Explain{number}",
            f"UNLESS {other} IN WHICH CASE (Warn{number} AND {done})",
            f"UNLESS {third} IN WHICH CASE Explain{number}",
            f"RULE avoid{number}",
            f"WHEN Trigger{number} THEN Wait{number}",
            f"UNLESS {one} IN WHICH CASE NOT {done}",
            f"UNLESS {other} AND NOT {third} IN WHICH CASE Wait{number}",
            f"UNLESS {third} OR Halted IN WHICH CASE NOT Explain{number}",
        ]
    return "\n".join(lines) + "\n"


def alike_rules(count: int) -> str:
    """`count` rules with three hedges, each of which repeats the condition of the previous one."""
    lines = []
    for number in range(count):
        one, other, third = (f"Condition{number}_{name}" for name in "abc")
        lines += [
            f"RULE rule{number}",
            f"WHEN Trigger{number // 2} THEN Do{number}",
            f"UNLESS {one} IN WHICH CASE Explain{number}",
            f"UNLESS {one} AND {other} IN WHICH CASE (Warn{number} AND Do{number})",
            f"UNLESS {one} AND {other} AND {third} IN WHICH CASE Wait{number}",
        ]
    return "\n".join(lines) + "\n"


def seconds(work: Callable[[], object]) -> float:
    """Processor seconds of `work`, including child processes."""
    before = _spent()
    work()
    return _spent() - before


def _spent() -> float:
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def measure(ruleset: Ruleset, folder: str, turns: int = TURNS) -> tuple[float, float, float]:
    """Median seconds of the check, of the check with its certificate, and of checking that certificate."""
    times: tuple[list[float], ...] = ([], [], [])
    for _ in range(turns):
        works = (
            lambda: run_checks(ruleset),
            lambda: write_folder(folder, certify(ruleset).contents(), force=True),
            lambda: check_certificate(ruleset, folder, checker(), oracle=built()),
        )
        for work, measured in zip(works, times):
            measured.append(seconds(work))
    solving, writing, checking = map(statistics.median, times)
    return solving, writing, checking


def measure_studies(paths: Iterable[Path]) -> None:
    """Print how long the certificates of some files take, compared with their checks."""
    worst = (0.0, "no file")
    totals = [0.0, 0.0, 0.0]
    for path in paths:
        with tempfile.TemporaryDirectory() as place:
            times = measure(load(path), str(Path(place) / "certificate"))
        totals = [total + one for total, one in zip(totals, times)]
        worst = max(worst, (times[1] / times[0], path.name))
        solving, writing, checking = times
        print(
            f"  {solving:5.2f} s  {writing / solving:4.2f}  {checking / solving:5.2f}  {path.parent.name}/{path.name}"
        )
    solving, writing, checking = totals
    print(f"  check               {solving:7.2f} s")
    print(f"  with a certificate  {writing:7.2f} s   {writing / solving:.2f} times")
    print(f"    the worst file    {worst[1]}   {worst[0]:.2f} times (at most {STUDIES})")
    print(f"  checking that       {checking:7.2f} s   {checking / solving:.2f} times")


def main(published: Path = Path("../shared/case-studies")) -> None:
    print(f"proofs are checked by {checker().name}; the oracle is {'' if built() else 'not '}built")
    for name, rules in (("random", random_rules), ("harmless", harmless_rules), ("alike", alike_rules)):
        with tempfile.TemporaryDirectory() as place:
            path, folder = Path(place) / "rules.sleec", str(Path(place) / "certificate")
            path.write_text(rules(RULES), encoding="utf-8")
            ruleset = load(path)
            solving, writing, checking = measure(ruleset, folder)
            sizes = {kind: sum(f.stat().st_size for f in Path(folder).glob(f"*.{kind}")) for kind in ("cnf", "lrat")}
            certificate = certify(ruleset)
            proved = sum(isinstance(result.verdict, Proved) for result in certificate.results)
            refuted = sum(one.refuted for one in certificate.shown)
        print(f"{name}, {RULES:,} rules: {proved} checks proved, {refuted:,} questions refuted")
        print(f"  check               {solving:7.2f} s")
        print(f"  with a certificate  {writing:7.2f} s   {writing / solving:.2f} times (at most {WRITING})")
        print(f"  checking that       {checking:7.2f} s   {checking / solving:.2f} times (at most {CHECKING})")
        print(f"  formulas {sizes['cnf'] / 1e6:.2f} MB, refutations {sizes['lrat'] / 1e6:.2f} MB")
    print("our studies: check, and how many times as long it takes with a certificate, and checking that")
    measure_studies(sorted(OWN.glob("*.sleec")))
    if published.is_dir():
        print("the published studies")
        measure_studies(sorted(published.glob("*/*.sleec")))
    else:
        print(f"the published case studies are not in {published}")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
