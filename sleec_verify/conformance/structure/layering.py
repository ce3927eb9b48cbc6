"""Compares a method with its rule: each clause needs one variant that is bound to its layer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sleec_runtime.dispatch.required_code import require_one_start
from sleec_runtime.errors import NotBound
from sleec_runtime.model import Rule
from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.structure.abstract_execution import AbstractExecutor
from sleec_verify.conformance.structure.bodies import compare
from sleec_verify.conformance.structure.execution import Execution
from sleec_verify.conformance.structure.methods import Method, Variant, calls_super
from sleec_verify.conformance.structure.program import Function
from sleec_verify.conformance.structure.report import Findings, clause_name, expression
from sleec_verify.conformance.structure.values import Layer, OwnLayer, Value
from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.phrases import listed


@dataclass(eq=False)
class TracedVariant:
    """A variant with its abstract execution. If it implements no clause, `wrong` is the kind of finding and its
    message."""

    variant: Variant
    trace: Execution
    wrong: tuple[str, str] | None = None
    hint: str | None = None


@dataclass
class MethodCheck:
    """One method and one rule that it is for."""

    method: Method
    rule: Rule
    labels: list[str]
    layers: Mapping[str, tuple[str, int]]
    tracer: AbstractExecutor
    findings: Findings
    by_hand: bool
    """Whether the layers are activated globally, so that a hedge without a variant runs the base."""
    units: dict[int, list[TracedVariant]] = field(default_factory=dict)
    strays: list[TracedVariant] = field(default_factory=list)
    unknown_layers: bool = False

    def run(self) -> None:
        """Reports every difference."""
        self._sort()
        self._starts()
        expected = {number: self._positive(number) for number, _ in enumerate(self.rule.clauses())}
        missing = [number for number in expected if number not in self.units and self._needed(number)]
        self._settle(missing, expected)
        for unit in self.strays:
            meant = self._meant(unit, missing, expected)
            self._stray(unit, meant)
            if meant is not None:
                missing.remove(meant)
                compare(self.findings, self.rule, meant, unit.variant, unit.trace)
        self._missing(missing)
        if self.by_hand:
            self._hidden()
        for number, (unit, *_) in self.units.items():
            other = self._clause_of(unit, number, expected)
            if other is not None:
                self._wrong_layer(unit, number, other)
            else:
                compare(self.findings, self.rule, number, unit.variant, unit.trace)

    # Which variant is for which clause ------------------------------------------------------------------

    def _sort(self) -> None:
        """Assigns the variants to their clauses. The variant that runs comes first. A variant without a clause is a
        stray."""
        for group in self.method.groups:
            here: dict[int, list[TracedVariant]] = {}
            for variant in group.variants:
                if variant.kind in ("before", "after"):
                    continue
                number, wrong, hint = self._number(variant)
                unit = TracedVariant(variant, self._trace(variant, group.variants), wrong, hint)
                if number is not None:
                    # Of bases the first counts, of variants on a layer the last.
                    units = here.setdefault(number, [])
                    units.insert(len(units) if variant.is_base else 0, unit)
                elif wrong is not None:
                    self.strays.append(unit)
            for number, units in here.items():
                self.units.setdefault(number, units)

    def _settle(self, missing: list[int], expected: dict[int, list[str]]) -> None:
        """Of several variants for one clause, those that do what a clause without one obliges are for that clause;
        one of the others stays, and the rest are duplicates."""
        for number, units in self.units.items():
            if len(units) == 1:
                continue
            for unit in units[:]:
                done = unit.trace.executed
                if len(units) > 1 and done != expected[number] and any(done == expected[m] for m in missing):
                    units.remove(unit)
                    word = f"{clause_name(self.rule, number)} already has a variant"
                    unit.wrong = ("wrong-layer", word)
                    self.strays.append(unit)
            kept = units[0].variant.function.node.lineno
            for unit in units[1:]:
                word = f"also has a variant on line {kept}, which runs instead"
                unit.wrong = ("duplicate-variant", f"{clause_name(self.rule, number)} {word}")
                self.strays.append(unit)
            del units[1:]

    def _number(self, variant: Variant) -> tuple[int | None, tuple[str, str] | None, str | None]:
        """The clause that a variant implements. If there is none, the error in its layer and a hint."""
        layer: Value | None = variant.layer
        if variant.is_base:
            return 0, None, None
        if layer is None:
            word = "has no layer" if not variant.bare else f"has @{variant.kind} without a call"
            return None, ("no-layer", f"this variant of {self.method.name} {word}"), None
        if isinstance(layer, OwnLayer):
            word = "is bound to a layer that is not a layer of a rule"
            return None, ("unknown-layer", f"this variant of {self.method.name} {word}"), None
        if not isinstance(layer, Layer):
            self.unknown_layers = True
            return None, None, None
        if layer.name not in self.layers:
            near = nearest(layer.name, [*(n for n in self._own_layers()), *self.layers])
            hint = (
                f"did you mean `{near}`?"
                if near
                else f"{self.rule.label} has {', '.join(self._own_layers()) or 'none'}"
            )
            return None, ("unknown-layer", f"the rules have no layer `{layer.name}`"), hint
        label, number = self.layers[layer.name]
        if label == self.rule.label:
            return number, None, None
        if label in self.labels:
            return None, None, None  # of another rule that this method is for too
        word = f"{layer.name} is a layer of rule {label}, but this is the method of {self.rule.label}"
        return None, ("foreign-layer", word), None

    def _own_layers(self) -> list[str]:
        names = (self.rule.layer(number) for number, _ in enumerate(self.rule.clauses()))
        return [name for name in names if name is not None]

    def _trace(self, variant: Variant, around: list[Variant]) -> Execution:
        """What a variant does with the advice of its layer: later advice in the text runs around it."""
        trace = self._one(variant)
        place = around.index(variant)
        for advice in around[place + 1 :]:
            same = (advice.layer is None and variant.layer is None) or (
                advice.layer is not None and advice.layer == variant.layer
            )
            if advice.kind in ("before", "after") and same:
                more = self._one(advice)
                first, second = (more, trace) if advice.kind == "before" else (trace, more)
                trace = first.then(second)
        return trace

    def _one(self, variant: Variant) -> Execution:
        def inherited(reached: Function) -> Function | None:
            for group in self.method.groups:
                if reached.owner is not None and group.scope is reached.owner.inner:
                    same = [v for v in group.variants if v.layer == variant.layer and v.kind in ("around", "base")]
                    return same[-1].function if same else None
            return None

        return self.tracer.trace(variant.function, self.method.class_, inherited)

    def _starts(self) -> None:
        """A method is called once for a clause, so the windows of the clause must open at one time."""
        for number, clause in enumerate(self.rule.clauses()):
            try:
                require_one_start(self.rule, clause)
            except NotBound:
                unit = self.units.get(number)
                function = (unit[0].variant if unit else self.method.variants[0]).function
                self.findings.add(
                    "different-starts",
                    f"{self.method.name} is called once, but the obligations of {clause_name(self.rule, number)} start "
                    "at different times",
                    (function.file, function.node),
                    clause=ClauseRef(self.rule.label, number),
                    obligations=tuple(self._positive(number)),
                    note=self.findings.obliged(self.rule, number),
                    help="implement() each obligation in place of this method, or write two rules",
                )

    # What follows ---------------------------------------------------------------------------------------

    def _positive(self, number: int) -> list[str]:
        clause = tuple(self.rule.clauses())[number]
        return list(dict.fromkeys(literal.name for literal in clause.obligations if not literal.negated))

    def _needed(self, number: int) -> bool:
        """Whether the clause needs a variant. If it requires nothing, a dispatch runs nothing. But under global
        activation, the base would run."""
        return bool(self._positive(number)) or (number > 0 and self.by_hand)

    def _meant(self, unit: TracedVariant, missing: list[int], expected: dict[int, list[str]]) -> int | None:
        """The clause without a variant that a stray is for: the one it does the obligations of, or is spelled like."""
        if unit.wrong is not None and unit.wrong[0] == "duplicate-variant":
            return None
        alike = [number for number in missing if expected[number] == unit.trace.executed]
        alike += [number for number in missing if f"did you mean {self.rule.layer(number)}?" == unit.hint]
        return alike[0] if alike else None

    def _stray(self, unit: TracedVariant, meant: int | None) -> None:
        assert unit.wrong is not None, "a stray says what is wrong with it"
        kind, message = unit.wrong
        file, at = unit.variant.function.file, unit.variant.at
        note = None
        hint = unit.hint
        if meant is not None:
            note = self.findings.obliged(self.rule, meant)
            layer = self.rule.layer(meant)
            unknown = kind == "unknown-layer" and layer is not None
            hint = f"did you mean {layer}?" if unknown else f"bind it with {expression(self.rule, meant)}"
        clause = None if meant is None else ClauseRef(self.rule.label, meant)
        self.findings.add(kind, message, (file, at), rules=(self.rule.label,), clause=clause, note=note, help=hint)

    def _missing(self, missing: list[int]) -> None:
        if not missing:
            return
        first = self.method.variants[0]
        if self.unknown_layers or any(group.lost for group in self.method.groups):
            return  # each unknown layer, each lost variant is reported, and may be the one that is missing
        if self.method.open and not self.method.marks and not any(v.is_base for v in self.method.variants):
            self.findings.undecided(
                first.function.file,
                first.function.node,
                f"the other variants of {self.method.name} may be inherited from a class outside the target",
            )
            return
        for number in missing:
            self.findings.add(
                "missing-variant" if number else "missing-base",
                f"{self.method.name}, the method of {self.rule.label}, has no variant for "
                f"{clause_name(self.rule, number)}",
                (first.function.file, first.function.node),
                clause=ClauseRef(self.rule.label, number),
                obligations=tuple(self._positive(number)),
                note=self.findings.obliged(self.rule, number),
                help=f"write one under {expression(self.rule, number)}",
            )

    def _hidden(self) -> None:
        """A base of a subclass hides inherited variants where layers are globally active: ContextPy3 looks for them in
        one definition only, whereas a trigger finds them in all."""
        for place, group in enumerate(self.method.groups):
            bases = [variant.function for variant in group.variants if variant.is_base]
            own = {variant.layer for variant in group.variants}
            inherited = [variant for above in self.method.groups[place + 1 :] for variant in above.variants]
            lost = [v.layer.name for v in inherited if isinstance(v.layer, Layer) and v.layer not in own]
            if bases and lost and not calls_super(bases[0], group.name):
                self.findings.add(
                    "lost-variant",
                    f"this {group.name} hides the inherited {'variant' if len(lost) == 1 else 'variants'} for "
                    f"{listed(dict.fromkeys(lost))} where layers are globally active",
                    (bases[0].file, bases[0].node),
                    rules=(self.rule.label,),
                    help=f"call super().{group.name}(…) in it, or run the method with trigger()",
                )

    def _clause_of(self, unit: TracedVariant, number: int, expected: dict[int, list[str]]) -> int | None:
        """The other clause that a variant does the obligations of, if that clause's own variant does not."""
        executed = unit.trace.executed
        if not executed or executed == expected[number] or any(call.why for call in unit.trace.calls):
            return None
        for other, names in expected.items():
            own = self.units.get(other)
            if names == executed and (own is None or own[0].trace.executed != names):
                return other
        return None

    def _wrong_layer(self, unit: TracedVariant, number: int, other: int) -> None:
        self.findings.add(
            "wrong-layer",
            f"this variant is bound to {clause_name(self.rule, number)}, but does what "
            f"{clause_name(self.rule, other)} requires",
            (unit.variant.function.file, unit.variant.at),
            clause=ClauseRef(self.rule.label, number),
            note=self.findings.obliged(self.rule, number),
            help=f"bind it with {expression(self.rule, other)}",
        )
