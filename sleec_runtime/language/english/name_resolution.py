"""What each name is: trigger, condition, obligation, measure, constant or value of a scale.

A parser tells this symbol table of every declaration first, then of every use; whatever clashes is found at the end,
when all uses are known. Both syntaxes share it.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.constant_cycles import circular
from sleec_runtime.language.common.problems import MAX_PROBLEMS, quoted
from sleec_runtime.model import (
    NOWHERE,
    Agent,
    Atom,
    Constant,
    Kind,
    Measure,
    MeasureRef,
    Number,
    Source,
    Span,
)
from sleec_runtime.support.suggestions import Suggester, did_you_mean

_KINDS: tuple[Kind, ...] = ("trigger", "condition", "obligation")


class Names:
    """The names of one text and what they stand for."""

    def __init__(self, source: Source, problems: list[Problem]) -> None:
        self.measures: dict[str, Measure] = {}
        self.inferred: dict[str, Measure] = {}
        self.constants: dict[str, Constant] = {}
        self.triggers: set[str] = set()
        """The triggers of all rules, wherever these stand."""
        self.complete = True
        """False once a declaration could not be read: then a name that is not declared is no news."""
        self._source = source
        self._problems = problems
        self._declared: dict[Kind, dict[str, Span]] = {kind: {} for kind in _KINDS}
        self._used: dict[Kind, dict[str, Span]] = {kind: {} for kind in _KINDS}
        self._events: dict[str, tuple[Span, Agent | None]] = {}
        self._events_used: dict[str, Span] = {}
        self.compared: dict[str, Span] = {}
        self._named: dict[str, Span] = {}
        self.scales: dict[str, list[str]] = {}
        self._labels: dict[str, tuple[Span, str]] = {}
        self.nearest = Suggester().nearest

    # Declarations ---------------------------------------------------------------------------------------------

    def declare(self, kind: Kind, name: str, span: Span) -> None:
        self._declared[kind].setdefault(name, span)

    def declare_event(self, name: str, span: Span, agent: Agent | None) -> None:
        """Takes in an event, which may be a trigger and an obligation. Whose it is must be said the same everywhere."""
        first, its = self._events.setdefault(name, (span, agent))
        if its != agent:
            self.problem(
                f"{quoted(name)} is declared {_owned(agent)} here, and {_owned(its)} in line {self._line(first)}",
                span,
                "declare it once",
            )
        self.declare("trigger", name, span)
        self.declare("obligation", name, span)

    def declare_measure(self, measure: Measure, name_span: Span, value_spans: Collection[Span]) -> None:
        """Takes a measure in, unless its name is taken. The values of one scale must differ."""
        if self.is_new(measure.name, name_span):
            self.measures[measure.name] = measure
        seen: dict[str, Span] = {}
        for value, span in zip(measure.values, value_spans):
            if value in seen:
                self.problem(
                    f"the scale of {quoted(measure.name)} names {quoted(value)} twice",
                    span,
                    "each value of a scale has one place in it",
                )
            elif value not in self.scales or measure.name not in self.scales[value]:
                self.scales.setdefault(value, []).append(measure.name)
            seen.setdefault(value, span)

    def declare_constants(self, written: dict[str, tuple[Side, Constant]]) -> dict[str, Constant]:
        """The constants with their values: each is a number or the value of another, which may stand further down."""
        for name in written:
            self._settle_constant(name, written)
        return self.constants

    def _settle_constant(self, name: str, written: dict[str, tuple[Side, Constant]]) -> None:
        chain: dict[str, None] = {}
        while name not in self.constants and name not in chain:
            chain[name] = None
            side, constant = written[name]
            if not isinstance(side.written, str):
                self.constants[name] = constant
            elif side.written in written:
                name = side.written
            else:
                self._undefined_constant(side, written)
                self.constants[name] = constant
        if name in chain and name not in self.constants:
            side, _ = written[name]
            message, hint = circular(list(chain)[list(chain).index(name) :], "CONSTANT")
            self.problem(message, side.span, hint)
            self.constants[name] = written[name][1]
        value = self.constants[name].value
        for link in chain:
            self.constants[link] = replace(written[link][1], value=value)

    def _undefined_constant(self, side: Side, known: Collection[str]) -> None:
        name = side.written
        assert isinstance(name, str)
        if name in self.measures:
            message, hint = f"{quoted(name)} is a measure, not a constant", "a constant is a number or another constant"
        else:
            message, hint = f"there is no constant {quoted(name)}", did_you_mean(self.nearest(name, known))
        self.problem(message, side.span, hint or f"write a number, or define it: CONSTANT {name} = 18")

    def check_scales(self) -> None:
        """A value of a scale must not be called like a measure or a constant: a comparison could mean either."""
        for value, owners in self.scales.items():
            if value in self._named:
                measure = self.measures.get(owners[0])
                self.problem(
                    f"{quoted(value)} is a value of the scale of {quoted(owners[0])} and the name of another "
                    f"{'measure' if value in self.measures else 'constant'} (line {self._line(self._named[value])})",
                    measure.span if measure else self._named[value],
                    "rename one of them",
                )

    def label(self, label: str, span: Span, what: str) -> None:
        """The label of a rule, a concern or a purpose, as `what` says; no two of them may have the same."""
        first, other = self._labels.setdefault(label, (span, what))
        if first is span:
            return
        if other == what:
            message = f"there are two {what}s {quoted(label)}; the first is in line {self._line(first)}"
        else:
            message = f"{quoted(label)} is also the label of the {other} in line {self._line(first)}"
        self.problem(message, span, f"give each {what} a label of its own")

    def numbered(self, labels: dict[str, Span]) -> None:
        """Rules without a label are called by their number, which no other rule may have for its label."""
        for label, span in labels.items():
            if label in self._labels:
                self.problem(
                    f"{quoted(label)} is also the name of the rule in line {self._line(span)}, which has no label",
                    self._labels[label][0],
                    "give one of them another label",
                )

    def is_new(self, name: str, span: Span) -> bool:
        """Whether a measure or constant may have this name; if not, that is reported."""
        first = self._named.setdefault(name, span)
        if first is not span:
            self.problem(
                f"{quoted(name)} is declared twice; the first time in line {self._line(first)}",
                span,
                "delete or rename one of them",
            )
        return first is span

    # Uses -----------------------------------------------------------------------------------------------------

    def use(self, kind: Kind, name: str, span: Span) -> None:
        used = self._used[kind]
        if name not in used:
            used[name] = span

    def event(self, name: str, span: Span) -> None:
        """A name that stands where something happens, be it a trigger, an obligation or both."""
        self._events_used.setdefault(name, span)

    def has_amount(self, name: str) -> bool:
        """Whether a constant or a measure has this name."""
        return name in self.constants or name in self.measures

    def amount(self, name: str, span: Span) -> Number | MeasureRef | None:
        """The constant or measure that says how long something takes; None, and a problem, if it is nothing of that."""
        constant = self.constants.get(name)
        if constant is not None:
            return self._constant_amount(constant, name, span)
        measure = self.measures.get(name)
        if measure is not None and measure.kind == "integer":
            self.compared.setdefault(name, span)
            return MeasureRef(name)
        if measure is not None:
            its = "a scale" if measure.kind == "scale" else "any number"
            self.problem(
                f"{quoted(name)} is {its}, and times are whole numbers",
                span,
                f"declare it as MEASURE {name}: integer, or write a number",
            )
        elif self.complete:
            near = self.nearest(name, [*self.constants, *self.measures])
            self.problem(
                f"there is no constant or measure {quoted(name)}",
                span,
                did_you_mean(near) or f"declare it: CONSTANT {name} = 5, or MEASURE {name}: integer",
            )
        return None

    def _constant_amount(self, constant: Constant, name: str, span: Span) -> Number | None:
        if constant.value >= 0 and constant.value.denominator == 1:
            return Number(constant.value, name)
        wrong = "negative" if constant.value < 0 else "no whole number"
        self.problem(
            f"the constant {quoted(name)} is {wrong}, and times are whole numbers from 0",
            span,
            "give it another value" if constant.value < 0 else "choose a smaller unit: 90 seconds, not 1.5 minutes",
        )
        return None

    def condition(self, name: str, span: Span) -> Atom:
        """A leaf of a guard or a hedge: an event if the name is a trigger, which then occurs or not."""
        if name in self.triggers or name in self._declared["trigger"]:
            return self._atom("trigger", name, span)
        return self._atom("condition", name, span)

    def state(self, name: str, span: Span) -> Atom:
        """A leaf of a relation, which speaks of conditions alone."""
        return self._atom("condition", name, span)

    def assumed(self, name: str, span: Span) -> Atom:
        """A leaf of an ASSUME. It speaks of situations, so it is a trigger or a condition."""
        if self._is("trigger", name):
            return self._atom("trigger", name, span)
        if self._is("obligation", name) and not self._is("condition", name):
            self.problem(
                f"{quoted(name)} is an obligation, and ASSUME speaks of situations: of triggers and conditions",
                span,
                "to forbid something to the robot, write NEVER",
            )
            return Atom("obligation", name, span)
        return self._atom("condition", name, span)

    def forbidden(self, name: str, span: Span) -> Atom:
        """A leaf of a NEVER: whatever the name is elsewhere, an obligation before all."""
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
        """Reports the names that are two things at once, and those that are not declared although their kind is."""
        clashing = self._report_clashes()
        if not self.complete:
            return
        self._report_unknown_events(clashing)
        unknown: list[tuple[Span, str, Kind]] = []
        for kind in _KINDS:
            if self._declared[kind]:
                for name, span in self._used[kind].items():
                    if name not in self._declared[kind] and name not in clashing:
                        unknown.append((span, name, kind))
        for index, (span, name, kind) in enumerate(sorted(unknown)):
            # Only what can be shown is worth a search for the nearest name.
            near = self.nearest(name, self._declared[kind]) if index < MAX_PROBLEMS else None
            first = next(iter(self._declared[kind].values()))
            article = "an" if kind == "obligation" else "a"
            self.problem(
                f"{quoted(name)} is not declared as {article} {kind}",
                span,
                did_you_mean(near)
                or f"this text declares its {kind}s (line {self._line(first)}); add it there: {kind.upper()} {name}",
            )

    def _report_unknown_events(self, clashing: set[str]) -> None:
        """Events that nothing else in a text knows which declares all its triggers and obligations."""
        if not (self._declared["trigger"] and self._declared["obligation"]):
            return
        known = {**self._declared["trigger"], **self._declared["obligation"]}
        for name, span in self._events_used.items():
            if name not in known and name not in clashing:
                near = self.nearest(name, known)
                self.problem(
                    f"{quoted(name)} is not declared as an event",
                    span,
                    did_you_mean(near) or f"this text declares its triggers and obligations; add it: EVENT {name}",
                )

    def _report_clashes(self) -> set[str]:
        clashing: set[str] = set()
        places: dict[str, dict[str, Span]] = {kind: {**self._used[kind], **self._declared[kind]} for kind in _KINDS}
        places["measure"] = {name: self.compared.get(name, NOWHERE) for name in (*self.inferred,)}
        for name in self.measures:
            places["measure"][name] = self._named.get(name, NOWHERE)
        places["constant"] = {name: self._named[name] for name in self.constants if name in self._named}
        places["event"] = self._events_used
        for one, other in _APART:
            for name in places[one].keys() & places[other].keys():
                if name not in clashing:
                    clashing.add(name)
                    self._report_clash(name, one, places[one][name], other, places[other][name])
        return clashing

    def _report_clash(self, name: str, one: str, one_span: Span, other: str, other_span: Span) -> None:
        """At the use that goes against a declaration, or at the later of two."""
        declared = {one: self._declares(one, name), other: self._declares(other, name)}
        at_one = one_span > other_span if declared[one] == declared[other] else declared[other]
        here, span, there, place = (one, one_span, other, other_span) if at_one else (other, other_span, one, one_span)
        self.problem(
            f"{quoted(name)} is {self._role(name, here, declared[here])} here, and "
            f"{self._role(name, there, declared[there])} "
            f"in line {self._line(place)}",
            span,
            self._how_to_part(name, here, there),
        )

    def _role(self, name: str, kind: str, declared: bool) -> str:
        if declared and kind in ("trigger", "obligation") and name in self._events:
            return "declared as an event"
        article = "an" if kind in ("obligation", "event") else "a"
        if declared:
            return f"declared as {article} {kind}"
        return "compared as a measure" if kind == "measure" else f"used as {article} {kind}"

    def _declares(self, kind: str, name: str) -> bool:
        if kind == "event":
            return False
        if kind in _KINDS:
            return name in self._declared[kind]
        return name in self._named

    def _how_to_part(self, name: str, here: str, there: str) -> str:
        kinds = {here, there}
        if kinds == {"condition", "measure"}:
            measure = self.measures.get(name)
            example = f">= {measure.values[-1]}" if measure and measure.values else "> 0"
            return f"a measure is compared wherever it stands, for example: {name} {example}"
        if kinds == {"condition", "obligation"}:
            return "a condition says how things are, an obligation what is to be done: give the two different names"
        if kinds in ({"condition", "trigger"}, {"condition", "event"}):
            return "a trigger is what happens, a condition how things are meanwhile: give the two different names"
        return "give the two different names"

    def _line(self, span: Span) -> int:
        return self._source.place(span).line

    def problem(self, message: str, span: Span, hint: str | None) -> None:
        self._problems.append(Problem(message, span, hint))


_APART = (
    ("condition", "measure"),
    ("trigger", "measure"),
    ("obligation", "measure"),
    ("condition", "constant"),
    ("trigger", "constant"),
    ("obligation", "constant"),
    ("condition", "obligation"),
    ("condition", "trigger"),
    ("condition", "event"),
    ("event", "measure"),
    ("event", "constant"),
)
"""What a name cannot be at once. A trigger may be an obligation of another rule: it happens because it was due."""


def _owned(agent: Agent | None) -> str:
    return f"BY {agent}" if agent is not None else "without BY"
