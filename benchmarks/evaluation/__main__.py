"""Repeat the evaluation of the paper (Section 5): `python -m benchmarks.evaluation [--quick] [PART…]`.

Writes CSV files, plots and `report.md`. Exits with 1 if a system executes something that the rules do not oblige.
"""

from __future__ import annotations

import argparse
import logging
import os
import sys
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.evaluation import correctness, efficiency, maintainability, plots, process_faults, robustness
from benchmarks.evaluation.deployment import Deployment
from benchmarks.evaluation.output import Output
from benchmarks.evaluation.rule_changes import ROOT, RULES
from benchmarks.evaluation.situations import Situation, critical_values, random_situations
from benchmarks.evaluation.statistics import Comparison, Summary, compare, summarise
from benchmarks.evaluation.variants.systems import LISTING_2, VARIANTS
from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_runtime.ros.dds.environment import LOOPBACK

PARTS = ("correctness", "efficiency", "maintainability", "robustness")
FIRST_DOMAIN = 90 + os.getpid() % 3 * 4
"""The DDS domain of the first system; each has its own. Tests use domains below 90, and Linux gives the ports of
domains above 101 to other programs."""


LONG_SETTLING = 0.2
"""Seconds for a change of context with 10,000 rules. Each 32nd update has all active layers."""


def evaluate_correctness(systems: Mapping[str, Deployment], ruleset: Ruleset, output: Output, quick: bool) -> bool:
    """E1."""
    output.section("E1: correctness")
    verdicts = correctness.check(systems, ruleset, count=10 if quick else 100)
    output.csv("e1-correctness", correctness.Verdict._fields, verdicts)
    output.table(
        ("system", "cases", "situations", "triggers", "as the solver derives"), [verdict[:5] for verdict in verdicts]
    )
    for verdict in verdicts:
        if verdict.first_difference:
            output.text(f"{verdict.system}: {verdict.first_difference}")
    return all(verdict.triggers == verdict.matches for verdict in verdicts)


def evaluate_efficiency(systems: Mapping[str, Deployment], ruleset: Ruleset, output: Output, quick: bool) -> bool:
    """E2: the delay of each system, also while the context changes."""
    output.section("E2: efficiency")
    delays = efficiency.measure(systems, ruleset, random_situations(ruleset, 20 if quick else 2_000))
    samples = report_delays("e2-delays", "Milliseconds from trigger to execution:", delays, systems, output)
    pairs = [(ours, other) for ours in (VARIANTS[0], LISTING_2) for other in VARIANTS[1:]]
    # How much two systems differ that are equally fast by design.
    pairs.append((VARIANTS[1], VARIANTS[2]))
    comparisons = [(f"{one} and {other}", *compare(samples[one], samples[other])) for one, other in pairs]
    output.csv("e2-comparisons", ("compared", *Comparison._fields), comparisons)
    output.table(("compared", "Mann-Whitney U", "p", "Cliff's δ", "from", "to"), comparisons)
    plots.cumulative(output.image("e2-delays", "distribution of the delays"), samples)
    situations = [one for one in random_situations(ruleset, 20) if one.domain == "household"]
    changing = efficiency.measure_while_changing(systems, ruleset, situations, triggers=5 if quick else 1_000)
    heading = f"The same, while the context changes {efficiency.CHANGES} times each second:"
    report_delays("e2-delays-while-changing", heading, changing, systems, output)
    return not any(delays.wrong.values()) and not any(changing.wrong.values())


def evaluate_sizes(ruleset: Ruleset, output: Output, quick: bool) -> bool:
    """E2: the delay with more rules."""
    output.section("E2: more rules")
    situations = [one for one in random_situations(ruleset, 40 if quick else 600) if one.domain == "household"]
    with TemporaryDirectory() as folder, ExitStack() as stack:
        systems: dict[str, Deployment] = {}
        for number, size in enumerate((8, 100) if quick else (8, 100, 1_000, 10_000)):
            rules = Path(folder) / f"{size}.sleec"
            more = random_rules(size - len(ruleset.rules))
            rules.write_text((ROOT / RULES).read_text(encoding="utf-8") + more, encoding="utf-8")
            tasks = ("CurtainOpenRequest", "HumanOnFloor")
            deployment = Deployment(VARIANTS[0], FIRST_DOMAIN + number, together=True, rules=rules, tasks=tasks)
            systems[f"{size:,} rules"] = stack.enter_context(deployment)
        for deployment in systems.values():
            deployment.await_start()
        repeats, settling = (1, efficiency.SETTLING) if quick else (10, LONG_SETTLING)
        delays = efficiency.measure(systems, ruleset, situations, repeats, settling)
    samples = report_delays("e2-delays-by-size", "Milliseconds from trigger to execution:", delays, systems, output)
    summaries = {int(name.split()[0].replace(",", "")): summarise(sample) for name, sample in samples.items()}
    plots.by_size(output.image("e2-delays-by-size", "delay by the number of rules"), summaries)
    return not any(delays.wrong.values())


def report_delays(
    name: str, heading: str, delays: efficiency.Delays, systems: Iterable[str], output: Output
) -> dict[str, list[float]]:
    """Writes the delays of each system, and returns them."""
    samples = {system: delays.of(system) for system in systems}
    output.csv(name, efficiency.Delay._fields, delays.samples)
    output.text(heading)
    rows = [
        (system, *summarise(sample), delays.late[system], delays.wrong[system]) for system, sample in samples.items()
    ]
    output.table(("system", *Summary._fields, "late", "wrong"), rows)
    return samples


def evaluate_maintainability(output: Output, quick: bool) -> bool:
    """E3."""
    output.section("E3: maintainability")
    sizes = maintainability.sizes()
    output.csv("e3-sizes", maintainability.Size._fields, sizes)
    output.table(maintainability.Size._fields, sizes)
    edits = maintainability.edits(with_partial=not quick)
    output.csv("e3-changes", maintainability.Edit._fields, edits)
    output.table(maintainability.Edit._fields, edits)
    counts: dict[str, dict[str, int]] = {}
    for edit in edits:
        if "(" not in edit.variant:
            counts.setdefault(edit.change, {})[edit.variant] = edit.python
    plots.lines_to_change(output.image("e3-changes", "lines of Python for each change"), counts)
    return all(edit.wrong == 0 and not edit.notice for edit in edits if edit.variant == VARIANTS[0])


def evaluate_robustness(ruleset: Ruleset, output: Output, quick: bool) -> bool:
    """Executions with faults of messages, processes and clocks."""
    output.section("Robustness")
    logging.getLogger("sleec_runtime.ros").setLevel(logging.CRITICAL)  # the nodes report each incident
    results = [
        robustness.run(scenario, variant, ruleset, missions=1 if quick else 20)
        for scenario in robustness.SCENARIOS
        for variant in VARIANTS
    ]
    output.csv("robustness", robustness.Result._fields, results)
    output.table(robustness.Result._fields, results)
    held = not any(result.wrong or result.repeated for result in results if result.system == VARIANTS[0])
    if not quick:
        output.text("Processes of CO-SLEEC over DDS:")
        situation = Situation("household", {name: known[-1] for name, known in critical_values(ruleset).items()})
        phases = process_faults.run(ruleset, FIRST_DOMAIN, situation)
        output.csv("robustness-of-processes", process_faults.Phase._fields, phases)
        output.table(process_faults.Phase._fields, phases)
        held &= all(phase.wrong == 0 and phase.executed == phase.obliged for phase in phases)
    return held


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.evaluation", description=__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"{', '.join(PARTS)}; by default all")
    parser.add_argument("--quick", action="store_true", help="a small part of the triggers, and fewer processes")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "evaluation", help="the folder of the results")
    options = parser.parse_args()
    parts = options.parts or PARTS
    unknown = [part for part in parts if part not in PARTS]
    if unknown:
        parser.error(f"unknown part {unknown[0]!r}; give one of {', '.join(PARTS)}")
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    ruleset = parse((ROOT / RULES).read_text(encoding="utf-8"))
    output = Output(options.output)
    held = True
    with ExitStack() as stack:
        systems: dict[str, Deployment] = {}
        if {"correctness", "efficiency"} & set(parts):
            for number, variant in enumerate((*VARIANTS, LISTING_2)):
                deployment = Deployment(variant, FIRST_DOMAIN + number, together=options.quick)
                systems[variant] = stack.enter_context(deployment)
            for deployment in systems.values():
                deployment.await_start()
        if "correctness" in parts:
            held &= evaluate_correctness(systems, ruleset, output, options.quick)
        if "efficiency" in parts:
            held &= evaluate_efficiency(systems, ruleset, output, options.quick)
    if "efficiency" in parts:
        held &= evaluate_sizes(ruleset, output, options.quick)
    if "maintainability" in parts:
        held &= evaluate_maintainability(output, options.quick)
    if "robustness" in parts:
        held &= evaluate_robustness(ruleset, output, options.quick)
    output.close()
    print(f"The results are in {output.folder}.")
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
