"""What each name is: trigger, condition, obligation, measure, constant or value of a scale.

The parser reports all declarations first, then every use. Conflicts are found at the end, when all uses are known.
"""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.language.common.problems import MAX_PROBLEMS, quoted
from sleec_runtime.language.common.symbol_table import SymbolTable, WrittenConstants
from sleec_runtime.language.english.name_conflicts import Uses, conflicts
from sleec_runtime.model import Agent, Atom, Constant, Kind, Measure, MeasureRef, Number, Source, Span
from sleec_runtime.support.suggestions import did_you_mean

_KINDS: tuple[Kind, ...] = ("trigger", "condition", "obligation")


class EnglishNames(SymbolTable):
    """The names of one text and what they stand for."""

    constant_keyword = "CONSTANT"

    def __init__(self, source: Source, problems: list[Problem]) -> None:
        super().__init__(source, problems)
        self.inferred: dict[str, Measure] = {}
        self.triggers: set[str] = set()
        """The triggers of all rules, wherever these are."""
        self._declared: dict[Kind, dict[str, Span]] = {kind: {} for kind in _KINDS}
        self._used: dict[Kind, dict[str, Span]] = {kind: {} for kind in _KINDS}
        self._events: dict[str, tuple[Span, Agent | None]] = {}
        self._events_used: dict[str, Span] = {}
        self.compared: dict[str, Span] = {}
        self._named: dict[str, Span] = {}
        self.scales: dict[str, list[str]] = {}
        """The measures that have each value of a scale."""
        self._labels: dict[str, tuple[Span, str]] = {}

    # Declarations ---------------------------------------------------------------------------------------------

    def declare(self, kind: Kind, name: str, span: Span) -> None:
        self._declared[kind].setdefault(name, span)

    def is_declared(self, kind: Kind, name: str) -> bool:
        return name in self._declared[kind]

    def declared_triggers(self) -> list[str]:
        """The names that TRIGGER declares, without those of EVENT, which may be responses only."""
        return [name for name in self._declared["trigger"] if name not in self._events]

    def is_condition(self, name: str) -> bool:
        """Whether a condition or a trigger of this name is declared, or triggers a rule."""
        return self.is_declared("condition", name) or self.is_declared("trigger", name) or name in self.triggers

    def declare_event(self, name: str, span: Span, agent: Agent | None) -> None:
        """Declares an event, which may be a trigger and an obligation. All declarations must name the same agent."""
        first, other = self._events.setdefault(name, (span, agent))
        if other != agent:
            here, there = (f"BY {its}" if its is not None else "without BY" for its in (agent, other))
            message = f"{quoted(name)} is declared {here} here, and {there} in line {self.line(first)}"
            self.problem(message, span, "declare it once")
        self.declare("trigger", name, span)
        self.declare("obligation", name, span)

    def declare_measure(self, measure: Measure, name_span: Span, value_spans: Sequence[Span]) -> None:
        """Declares a measure, unless its name is taken. The values of one scale must differ."""
        if self.is_new(measure.name, name_span):
            self.measures[measure.name] = measure
        self.check_scale(measure, value_spans)
        for value in dict.fromkeys(measure.values):
            owners = self.scales.setdefault(value, [])
            if measure.name not in owners:
                owners.append(measure.name)

    def unknown_constant(self, name: str, known: WrittenConstants) -> tuple[str, str]:
        if name in self.measures:
            return f"{quoted(name)} is a measure, not a constant", "a constant is a number or another constant"
        return f"no constant is called {quoted(name)}", did_you_mean(self.nearest(name, known))

    def check_scales(self) -> None:
        """Reports values of scales with the name of a measure or constant: a comparison could mean either."""
        for value, owners in self.scales.items():
            if value in self._named:
                measure = self.measures.get(owners[0])
                other = "measure" if value in self.measures else "constant"
                self.problem(
                    f"{quoted(value)} is a value of the scale of {quoted(owners[0])} and the name of another "
                    f"{other} (line {self.line(self._named[value])})",
                    measure.span if measure else self._named[value],
                    "rename one of them",
                )

    def label(self, label: str, span: Span, what: str) -> None:
        """Declares the label of a rule, concern or purpose, as `what` says. Labels must differ."""
        first, other = self._labels.setdefault(label, (span, what))
        if first is span:
            return
        if other == what:
            message = f"two {what}s are called {quoted(label)}; the first is in line {self.line(first)}"
        else:
            message = f"{quoted(label)} is also the label of the {other} in line {self.line(first)}"
        self.problem(message, span, f"give each {what} its own label")

    def numbered(self, labels: dict[str, Span]) -> None:
        """Reports labels that are the number of a rule without a label."""
        for label, span in labels.items():
            if label in self._labels:
                self.problem(
                    f"{quoted(label)} is also the name of the rule without a label in line {self.line(span)}",
                    self._labels[label][0],
                    "give one of them another label",
                )

    def is_new(self, name: str, span: Span) -> bool:
        """Whether no other measure or constant has this name; if one has, that is reported."""
        first = self._named.setdefault(name, span)
        if first is not span:
            message = f"{quoted(name)} is declared twice; the first time in line {self.line(first)}"
            self.problem(message, span, "delete or rename one of them")
        return first is span

    # Uses -----------------------------------------------------------------------------------------------------

    def use(self, kind: Kind, name: str, span: Span) -> None:
        used = self._used[kind]
        if name not in used:
            used[name] = span

    def event(self, name: str, span: Span) -> None:
        """Uses a name as an event: a trigger, an obligation or both."""
        self._events_used.setdefault(name, span)

    def has_amount(self, name: str) -> bool:
        """Whether a constant or a measure has this name."""
        return name in self.constants or name in self.measures

    def amount(self, name: str, span: Span) -> Number | MeasureRef | None:
        """The constant or measure that is an amount of time; None, and a problem, if the name is neither."""
        constant = self.constants.get(name)
        if constant is not None:
            return self._constant_amount(constant, name, span)
        measure = self.measures.get(name)
        if measure is not None and measure.kind == "integer":
            self.compared.setdefault(name, span)
            return MeasureRef(name)
        if measure is not None:
            kind = "a scale" if measure.kind == "scale" else "a decimal number"
            self.problem(
                f"{quoted(name)} is {kind}, but a time is a whole number",
                span,
                f"declare it as MEASURE {name}: integer, or write a number",
            )
        elif self.complete:
            near = self.nearest(name, [*self.constants, *self.measures])
            self.problem(
                f"no constant or measure is called {quoted(name)}",
                span,
                did_you_mean(near) or f"declare it: CONSTANT {name} = 5, or MEASURE {name}: integer",
            )
        return None

    def _constant_amount(self, constant: Constant, name: str, span: Span) -> Number | None:
        if constant.value < 0:
            message = f"a time cannot be negative: the constant {quoted(name)} is {print_number(constant.value)}"
            self.problem(message, span, "use another value")
            return None
        if constant.value.denominator != 1:
            message = f"a time is a whole number, but the constant {quoted(name)} is {print_number(constant.value)}"
            self.problem(message, span, "use a smaller unit: 90 seconds, not 1.5 minutes")
            return None
        return Number(constant.value, name)

    def condition(self, name: str, span: Span) -> Atom:
        """A leaf of a guard or an exception: an event if the name is a trigger, else a condition."""
        if name in self.triggers or self.is_declared("trigger", name):
            return self._atom("trigger", name, span)
        return self._atom("condition", name, span)

    def state(self, name: str, span: Span) -> Atom:
        """A leaf of a relation, which is always a condition."""
        return self._atom("condition", name, span)

    def assumed(self, name: str, span: Span) -> Atom:
        """A leaf of an ASSUME. It describes situations, so it is a trigger or a condition."""
        if self._is("trigger", name):
            return self._atom("trigger", name, span)
        if self._is("obligation", name) and not self._is("condition", name):
            self.problem(
                f"{quoted(name)} is an obligation, but ASSUME is about triggers and conditions",
                span,
                "to forbid an obligation, write NEVER",
            )
            return Atom("obligation", name, span)
        return self._atom("condition", name, span)

    def forbidden(self, name: str, span: Span) -> Atom:
        """A leaf of a NEVER: an obligation, unless the name is only something else."""
        for kind in ("obligation", "condition", "trigger"):
            if self._is(kind, name):
                return self._atom(kind, name, span)
        return self._atom("obligation", name, span)

    def _atom(self, kind: Kind, name: str, span: Span) -> Atom:
        self.use(kind, name, span)
        return Atom(kind, name, span)

    def _is(self, kind: Kind, name: str) -> bool:
        return name in self._declared[kind] or name in self._used[kind]

    # The end --------------------------------------------------------------------------------------------------

    def finish(self) -> None:
        """Reports names of two kinds, and undeclared names of kinds with declarations."""
        conflicting = self._report_conflicts()
        if not self.complete:
            return
        self._report_unknown_events(conflicting)
        unknown: list[tuple[Span, str, Kind]] = []
        for kind in _KINDS:
            if self._declared[kind]:
                for name, span in self._used[kind].items():
                    if name not in self._declared[kind] and name not in conflicting:
                        unknown.append((span, name, kind))
        for index, (span, name, kind) in enumerate(sorted(unknown)):
            # Only a problem that is shown is worth a search for the nearest name.
            near = self.nearest(name, self._declared[kind]) if index < MAX_PROBLEMS else None
            first = self.line(next(iter(self._declared[kind].values())))
            self.problem(
                f"no {kind} is called {quoted(name)}",
                span,
                did_you_mean(near) or f"this text declares its {kind}s (line {first}); add {kind.upper()} {name}",
            )

    def _report_unknown_events(self, conflicting: set[str]) -> None:
        """Reports unknown events of a text that declares its triggers and obligations."""
        if not (self._declared["trigger"] and self._declared["obligation"]):
            return
        known = {**self._declared["trigger"], **self._declared["obligation"]}
        for name, span in self._events_used.items():
            if name not in known and name not in conflicting:
                near = self.nearest(name, known)
                self.problem(
                    f"no event is called {quoted(name)}",
                    span,
                    did_you_mean(near) or f"this text declares its triggers and obligations; add EVENT {name}",
                )

    def _report_conflicts(self) -> set[str]:
        inferred = {name: self.compared[name] for name in self.inferred}
        measures = {name: self._named[name] for name in self.measures}
        constants = {name: self._named[name] for name in self.constants if name in self._named}
        uses: dict[str, Uses] = {
            "measure": Uses({**inferred, **measures}, self._named.keys()),
            "constant": Uses(constants, self._named.keys()),
            "event": Uses(self._events_used, set()),
        }
        for kind in _KINDS:
            uses[kind] = Uses({**self._used[kind], **self._declared[kind]}, self._declared[kind].keys())
        found: set[str] = set()
        for conflict in conflicts(uses, self._events.keys(), self.measures):
            found.add(conflict.name)
            message = (
                f"{quoted(conflict.name)} is {conflict.here} here, and {conflict.there} in line "
                f"{self.line(conflict.other)}"
            )
            self.problem(message, conflict.span, conflict.hint)
        return found
