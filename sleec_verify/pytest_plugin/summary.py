"""Coverage in words, and the percentage for the threshold."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.language import print_formula
from sleec_verify.conformance.cases.goals import conditions_of
from sleec_verify.conformance.cases.reachability import deciding_conditions, reachable_clauses
from sleec_verify.conformance.scenarios.window_coverage import reachable_windows
from sleec_verify.conformance.scenarios.windows import windows_of
from sleec_verify.pytest_plugin.coverage import RuleCoverage
from sleec_verify.results.finding import ClauseRef


class Summary:
    """For one ruleset: how many of its reachable clauses were active, how many of their windows were met or missed, and
    with `mcdc` how many conditions decided."""

    def __init__(self, covered: RuleCoverage, mcdc: bool) -> None:
        ruleset = covered.ruleset
        every = [ClauseRef(rule.label, n) for rule in ruleset.rules for n, _ in enumerate(rule.clauses())]
        reachable = reachable_clauses(ruleset)
        self.path = ruleset.source.path
        self.reachable = [ref for ref in every if ref in reachable]
        self.unreachable = [ref for ref in every if ref not in reachable]
        self.never = [ref for ref in self.reachable if ref not in covered.active]
        reachable_ones = reachable_windows(ruleset, reachable)
        windows = [window for rule in ruleset.rules for window in windows_of(rule)]
        self.windows = [window for window in windows if window in reachable_ones]
        self.unreached = [window for window in self.windows if window not in covered.windows]
        self.unreachable_windows = [window for window in windows if window not in reachable_ones]
        self.conditions = 0
        self.undecided: list[str] = []
        self.undecidable: list[str] = []
        if mcdc:
            deciding = deciding_conditions(ruleset)
            for rule in ruleset.rules:
                never = covered.undecided(rule)
                for condition in conditions_of(rule):
                    name = f"{print_formula(condition)} in {rule.label}"
                    if (rule.label, condition) not in deciding:
                        self.undecidable.append(name)
                        continue
                    self.conditions += 1
                    if condition in never:
                        self.undecided.append(name)

    @property
    def goals(self) -> int:
        return len(self.reachable) + len(self.windows) + self.conditions

    @property
    def reached(self) -> int:
        return self.goals - len(self.never) - len(self.unreached) - len(self.undecided)

    def lines(self) -> Iterator[str]:
        active = len(self.reachable) - len(self.never)
        yield f"{self.path}: {active} of {len(self.reachable)} clauses active ({percent(active, len(self.reachable))})"
        yield from (f"  never: {_name(ref)}" for ref in self.never)
        yield from (f"  unreachable: {_name(ref)}" for ref in self.unreachable)
        if self.windows:
            ended = len(self.windows) - len(self.unreached)
            yield f"  windows: {ended} of {len(self.windows)} met or missed ({percent(ended, len(self.windows))})"
        yield from (f"  never: {window}" for window in self.unreached)
        yield from (f"  unreachable: {window}" for window in self.unreachable_windows)
        if self.conditions:
            shown = self.conditions - len(self.undecided)
            yield f"  MC/DC: {shown} of {self.conditions} conditions decided ({percent(shown, self.conditions)})"
        yield from (f"  never decides: {name}" for name in self.undecided)
        yield from (f"  cannot decide: {name}" for name in self.undecidable)


def percent(part: int, whole: int) -> str:
    """A percentage with one decimal, rounded down, so that only everything is 100 %."""
    return f"{share(part, whole):.1f} %"


def share(part: int, whole: int) -> float:
    return 1000 * part // whole / 10 if whole else 100.0


def _name(ref: ClauseRef) -> str:
    return f"{ref.rule}.hc{ref.clause}" if ref.clause else f"{ref.rule} (default)"
