"""Measure the repairs of our studies and of the published ones, and of one conflict among 50 rules.

The published files are not part of this project: give their folder with ``python -m benchmarks.repairs FOLDER``. For
those with a corrected version, it also compares the repairs with what the authors changed.

SLEEC-PATCH repairs 63 issues of nine studies in 15 to 79 s each, by its published results; we must be 50 times faster.
At least 95 % of all issues must have a repair or a stated reason, and the repairs of the conflict may take at most 20
checks. Times are those of the processor, which a load on the machine does not change.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median
from time import process_time

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load, parse
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.changes.compare import compare
from sleec_verify.checks import run_checks
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import CheckResult, Finding

OWN = Path(__file__).parents[1] / "rulesets" / "studies"
CORRECTED = {
    "ALMI/ALMI.sleec": "ALMI/ALMI-Corrected.sleec",
    "ASPEN/aspen.sleec": "ASPEN/aspen-corrected.sleec",
    "Autocar/Autocar.sleec": "Autocar/Autocar-corrected.sleec",
    "CSI/CSI.sleec": "CSI/CSI-corrected.sleec",
    "dressingAssist/DRESSASSIST.sleec": "dressingAssist/DRESSASSIST-corrected.sleec",
    "sleec-tk/firefighter-initial.sleec": "sleec-tk/firefighter-valid.sleec",
}
ISSUES = ("SLEEC101", "SLEEC102", "SLEEC104", "SLEEC105", "SLEEC107", "SLEEC202", "SLEEC301", "SLEEC302")
"""Conflicts, concerns, purposes, and rules or exceptions that are redundant."""

SLEEC_PATCH = 15.0
"""Seconds for one issue, the fastest of its studies."""

FASTER = 50
SHARE = 95
CHECKS = 20


def issues(results: Sequence[CheckResult]) -> list[Finding]:
    return [finding for result in results for finding in result.findings if finding.code in ISSUES]


def study(path: Path) -> Iterator[tuple[Finding, list[Repair], str | None, float]]:
    """Each issue of a file with its repairs, why there are none if this is known, and the seconds that they took."""
    ruleset = load(path)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    for finding in issues(results):
        started = process_time()
        repairs = search.repairs(finding)
        yield finding, repairs, search.reason, process_time() - started


def measure(paths: Sequence[Path]) -> None:
    found, repaired, spent = Counter[str](), Counter[str](), []
    stated = 0
    for path in paths:
        for finding, repairs, reason, seconds in study(path):
            stated += reason is not None
            found[finding.code] += 1
            repaired[finding.code] += bool(repairs)
            spent.append(seconds)
            if not repairs:
                print(f"no repair: {path.name}: {finding.code} {finding.message[:80]}: {reason}")
    for code in sorted(found):
        print(f"{code}: {repaired[code]} of {found[code]} with a repair")
    share = 100 * (repaired.total() + stated) / found.total()
    print(
        f"{repaired.total()} of {found.total()} issues with a repair, {stated} more with the reason why there is none: "
        f"{share:.0f} % (at least {SHARE} %)"
    )
    mean = sum(spent) / len(spent)
    print(
        f"{mean:.2f} s for each issue (median {median(spent):.2f}, at most {max(spent):.2f}): "
        f"{SLEEC_PATCH / mean:.0f} times as fast as SLEEC-PATCH (at least {FASTER})"
    )


def fifty_rules() -> None:
    rules = [f"RULE r{n}\nWHEN t{n % 10} AND c{n} THEN o{n}\nUNLESS d{n} IN WHICH CASE p{n}\n" for n in range(49)]
    text = "".join([*rules, "RULE last\nWHEN t7 AND e THEN NOT o17\n"])
    run_checks(parse(text))
    checks = []
    for _ in range(5):
        started = process_time()
        ruleset = parse(text)
        results = run_checks(ruleset)
        checks.append(process_time() - started)
    (finding,) = issues(results)
    started = process_time()
    repairs = RepairSearch(ruleset, results).repairs(finding)
    seconds = process_time() - started
    print(
        f"one conflict among 50 rules: {len(repairs)} repairs in {seconds:.2f} s, "
        f"{seconds / median(checks):.1f} checks (at most {CHECKS})"
    )


def variants(initial: Ruleset, corrected: Ruleset) -> Iterator[Ruleset]:
    """The initial rules with one rule as the authors corrected it, and the whole correction."""
    ours = initial.by_label
    for label in dict.fromkeys((*ours, *corrected.by_label)):
        old, new = ours.get(label), corrected.by_label.get(label)
        if old == new:
            continue
        kept = [one for one in initial.statements if one is not old]
        yield replace(initial, statements=tuple([*kept, new] if isinstance(new, Rule) else kept))
    yield corrected


def size(old: Ruleset, new: Ruleset) -> float:
    """The situations that a change affects."""
    difference = compare(old, new, over_time=False)
    numbers = [change.extent.affected for change in difference.changes]
    return float("inf") if None in numbers or difference.undecided else sum(n for n in numbers if n is not None)


def against_authors(folder: Path) -> None:
    """For the issues that the authors removed: whether a repair is equivalent to a rule of their correction, or changes
    fewer situations than the smallest part of it that removes the issue."""
    for before, after in CORRECTED.items():
        initial, corrected = load(folder / before), load(folder / after)
        results = run_checks(initial)
        parts = [(one, {key(f) for f in issues(run_checks(one))}) for one in variants(initial, corrected)]
        search = RepairSearch(initial, results)
        rows = Counter[str]()
        for finding in issues(results):
            theirs = [one for one, left in parts if key(finding) not in left]
            repairs = search.repairs(finding)
            rows["issues"] += 1
            rows["removed by them"] += bool(theirs)
            if theirs and repairs:
                equivalent = any(
                    compare(repair.repaired, one, over_time=False).relation == "equivalent"
                    for one in theirs
                    for repair in repairs
                )
                smallest = min(size(initial, one) for one in theirs)
                smaller = any(r.effect.situations is not None and r.effect.situations < smallest for r in repairs)
                rows["equivalent"] += equivalent
                rows["smaller"] += smaller
                rows["either"] += equivalent or smaller
        print(
            f"{Path(before).name}: of {rows['issues']} issues, the authors removed {rows['removed by them']}; "
            f"a repair is equivalent to theirs for {rows['equivalent']}, changes fewer situations for "
            f"{rows['smaller']}, either for {rows['either']}",
            flush=True,
        )


def key(finding: Finding) -> tuple[object, ...]:
    return finding.code, finding.rules if finding.code == "SLEEC101" else finding.message


def _is_read(path: Path) -> bool:
    """Whether a published file is in a known dialect."""
    try:
        load(path)
    except SleecError as error:
        print(f"not read: {path.name}: {error.message}")
        return False
    return True


def main(folder: Path = Path("../shared/case-studies")) -> None:
    fifty_rules()
    print("our studies:")
    measure(sorted(OWN.glob("*.sleec")))
    if not folder.is_dir():
        print(f"the published case studies are not in {folder}")
        return
    print("the published studies:")
    measure([path for path in sorted(folder.rglob("*.sleec")) if _is_read(path)])
    against_authors(folder)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
