"""Random rulesets by a seed, with every construct of both languages in every position.

Each ruleset leaves out a random half of the constructs, because a construct often hides the defects of others: A.
Groce et al., "Swarm testing", ISSTA 2012. It is drawn as a value of the model, printed, and parsed again, so that each
ruleset is a text that can be shown and kept: `random_ruleset(seed).source.text`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from random import Random

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.language.english.always import Always, instances
from sleec_runtime.model import (
    CLAIM_KINDS,
    NO_COMMENTS,
    NOWHERE,
    READINGS,
    Agent,
    And,
    Assume,
    Atom,
    Calculation,
    Claim,
    ClaimForm,
    ClaimKind,
    Clause,
    Comparison,
    Constant,
    Declaration,
    Effect,
    EffectKind,
    EventRelation,
    EventRelationKind,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    MeasureRelationKind,
    Never,
    Not,
    Number,
    Obligation,
    Operator,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Syntax,
    Timing,
    Truth,
    Unit,
    Window,
)

EVENTS = ("A", "B", "C", "D", "E", "F", "G", "H")
CONDITIONS = ("m", "n", "p")
SCALE = ("low", "middle", "high")
DOMAINS = ("ward", "home")
FORMS: tuple[ClaimForm, ...] = ("exists", "when")
OPERATORS: tuple[Operator, ...] = ("<", "<=", "=", "!=", ">=", ">")
BETWEEN_EVENTS: tuple[EventRelationKind, ...] = ("witness", "equal", "mutualExclusive", "happenBefore")
EFFECTS: tuple[EffectKind, ...] = ("causation", "includes", "forbid")
BETWEEN_MEASURES: tuple[MeasureRelationKind, ...] = ("imply", "iff", "mutualExclusive", "opposite", "invariant")

TIMED = ("windows", "starts", "eventually", "otherwise", "else", "measured windows", "relations", "claims")
BOTH_LANGUAGES = (
    *TIMED,
    *("events in conditions", "environment", "chains", "prohibitions", "nested hedges", "scales", "numbers"),
    *("constants", "truths", "guards", "hedges"),
)
ENGLISH_ONLY = ("several", "exclusive", "never", "assume", "always", "domains")
DSL_ONLY = ("calculations",)


@dataclass(frozen=True)
class Limits:
    """The largest numbers of a ruleset, and the longest window in seconds."""

    rules: int = 5
    events: int = 8
    hedges: int = 2
    laws: int = 3
    longest: int = 3
    conditions: int = 3
    depth: int = 2


SMALL = Limits(rules=3, events=4, hedges=1, laws=2, longest=2, conditions=1)
"""Small enough for the explicit oracle, mostly."""


def random_ruleset(seed: int, syntax: Syntax = "english", limits: Limits = Limits(), timed: bool = True) -> Ruleset:
    """A ruleset. Without `timed`, it has neither times nor relations nor claims nor responses that trigger rules."""
    return parse(print_ruleset(_Draw(Random(f"{seed} {syntax} {timed}"), syntax, limits, timed).ruleset()))


class _Draw:
    def __init__(self, chance: Random, syntax: Syntax, limits: Limits, timed: bool) -> None:
        self.chance, self.syntax, self.limits = chance, syntax, limits
        every = (*BOTH_LANGUAGES, *(ENGLISH_ONLY if syntax == "english" else DSL_ONLY))
        self.features = {each for each in every if chance.random() < 0.6}
        if not timed:
            self.features -= {*TIMED, "chains"}
        self.events = EVENTS[: chance.randint(2, limits.events)]
        cut = chance.randint(1, len(self.events) - 1)
        self.causes = self.events if self.has("chains") else self.events[:cut]
        self.acts = self.events if self.has("chains") else self.events[cut:]
        self.conditions = CONDITIONS[: chance.randint(1, limits.conditions)]
        self.unit: Unit = "seconds" if self.sometimes(0.7) else chance.choice(("minutes", "hours", "days"))

    def has(self, feature: str) -> bool:
        return feature in self.features

    def sometimes(self, share: float) -> bool:
        return self.chance.random() < share

    def uses(self, feature: str, share: float) -> bool:
        return self.has(feature) and self.sometimes(share)

    def few(self, most: int) -> int:
        """None about half of the time."""
        return max(0, self.chance.randint(-most, most))

    def ruleset(self) -> Ruleset:
        rules = [self.rule(number) for number in range(1, self.chance.randint(1, self.limits.rules) + 1)]
        laws = [self.law() for _ in range(self.chance.randint(0, self.limits.laws))] if self._laws() else []
        claims = (
            [self.claim(f"c{n}", self.chance.choice(CLAIM_KINDS)) for n in range(self.chance.randint(0, 3))]
            if self.has("claims")
            else []
        )
        every = list(self.always(rules)) if self.uses("always", 0.5) else []
        reading = self.chance.choice(READINGS) if self.syntax == "english" else "priority"
        statements = (*self.declarations(), *rules, *every, *laws, *claims)
        return Ruleset(statements, reading, self.syntax, dialect="legos" if self.syntax == "dsl" else None)

    # Declarations ---------------------------------------------------------------------------------------------

    def declarations(self) -> Iterator[Statement]:
        for name in self.events:
            agents: tuple[Agent | None, ...] = ("environment", None, None, None, "system")
            yield Declaration("event", (name,), agent=self.chance.choice(agents) if self.has("environment") else None)
        for name in self.conditions:
            yield Declaration("condition", (name,))
        if self.has("scales"):
            yield Measure("risk", "scale", SCALE)
        if self.has("constants"):
            yield Constant("K", 1)
        for name in ("w", "v") if self.has("numbers") or self.has("measured windows") else ():
            yield Measure(name, "integer")
            yield self.bounds(name)

    def bounds(self, name: str) -> Statement:
        """The range that a measure must have to give the length of a window."""
        most = Comparison(MeasureRef(name), "<=", Number(self.limits.longest))
        formula = And((Comparison(MeasureRef(name), ">=", Number(0)), most))
        return Assume(formula) if self.syntax == "english" else MeasureRelation("invariant", formula)

    # Rules ----------------------------------------------------------------------------------------------------

    def rule(self, number: int) -> Rule:
        guard = self.occasion() if self.uses("guards", 0.4) else None
        trigger = self.chance.choice(self.causes)
        return Rule(f"R{number}", trigger, guard, self.clause(self.limits.depth), self.hedges(1), self.domains())

    def always(self, rules: list[Rule]) -> Iterator[Rule]:
        """An ALWAYS as the parser gives it: a rule for each trigger of the text."""
        triggers = dict.fromkeys((*self.events, *(rule.trigger for rule in rules)))
        every = Always(self.clause(1), self.hedges(0), None, NOWHERE, NOWHERE, NO_COMMENTS)
        yield from instances(every, "always_1", triggers)

    def domains(self) -> tuple[str, ...] | None:
        if not self.uses("domains", 0.5):
            return None
        return tuple(sorted(self.chance.sample(DOMAINS, self.chance.choice((1, 1, 2)))))

    def clause(self, depth: int) -> Clause:
        number = self.chance.choice((1, 1, 2)) if self.has("several") else 1
        obligations = tuple(self.obligation(depth) for _ in range(number))
        return Clause(None, obligations, self.hedges(depth - 1) if self.uses("nested hedges", 0.3) else ())

    def hedges(self, depth: int) -> tuple[Clause, ...]:
        if depth < 0 or not (self.has("hedges") or self.has("nested hedges")):
            return ()
        return tuple(self.hedge(depth) for _ in range(self.few(self.limits.hedges)))

    def hedge(self, depth: int) -> Clause:
        clause = Clause(None, ()) if self.sometimes(0.25) else self.clause(depth)
        return replace(clause, condition=self.occasion())

    def obligation(self, depth: int) -> Obligation:
        """A literal with its time. Its alternatives are clauses, with hedges of their own."""
        otherwise = self.alternative(depth - 1) if depth and self.uses("otherwise", 0.35) else None
        instead = self.alternative(depth - 1) if depth and self.uses("else", 0.3) else None
        timing = Timing(self.window(), otherwise, instead)
        negated = self.uses("prohibitions", 0.4)
        return Obligation(self.chance.choice(self.acts), negated, timing=None if timing == Timing() else timing)

    def alternative(self, depth: int) -> Clause:
        clause = self.clause(depth)
        if not clause.hedges and self.uses("nested hedges", 0.5):
            return replace(clause, hedges=(self.hedge(0),))
        return clause

    def window(self) -> Window | None:
        if self.uses("eventually", 0.2):
            return Window(None)
        if not self.has("windows") or self.sometimes(0.35):
            return None
        if self.uses("measured windows", 0.4):
            return self.measured_window()
        last = self.chance.randint(0, self.limits.longest)
        first = self.chance.randint(0, last) if self.uses("starts", 0.4) else None
        return Window(self.length(last), None if first is None else self.length(first))

    def measured_window(self) -> Window:
        """A window that is never empty, for the declared ranges."""
        start, late = Length(MeasureRef("v"), self.unit), self.length(self.limits.longest)
        sums = Length(Calculation(((1, ("v",)), (1, ("w",)))), self.unit)
        shapes = [Window(Length(MeasureRef("w"), self.unit))]
        if self.has("starts"):
            shapes += [Window(late, start), *([Window(sums, start)] if self.has("calculations") else [])]
        return self.chance.choice(shapes)

    def length(self, amount: int) -> Length:
        return Length(Number(amount, "K" if amount == 1 and self.has("constants") else None), self.unit)

    # Constraints, relations and claims ------------------------------------------------------------------------

    def _laws(self) -> list[str]:
        return [each for each in ("exclusive", "never", "assume", "relations", "relations") if self.has(each)]

    def law(self) -> Statement:
        kind = self.chance.choice(self._laws())
        if kind == "relations":
            return self.relation()
        if kind == "exclusive" and len(self.acts) > 1:
            names = self.chance.sample(self.acts, self.chance.randint(2, min(3, len(self.acts))))
            return Exclusive(tuple(names), self.domains())
        if kind == "assume":
            return Assume(self.formula(1, self.causes if self.has("events in conditions") else ()), self.domains())
        act: Formula = Atom("obligation", self.chance.choice(self.acts))
        parts = [act] if self.sometimes(0.4) else [act, self.literal()]
        exceptions = self.chance.choice((0, 1, 1, 2))
        parts += [Not(self.literal()) for _ in range(exceptions)]
        return Never(parts[0] if len(parts) == 1 else And(tuple(parts)), self.domains(), exceptions=exceptions)

    def literal(self) -> Formula:
        return Atom("condition", self.chance.choice(self.conditions))

    def relation(self) -> Statement:
        draw = (self.between_events, self.between_measures, self.effect, self.lasting)
        return self.chance.choices(draw, (4, 5, 3, 2))[0]()

    def between_events(self) -> Statement:
        left, right = self.chance.sample(self.events, 2)
        return EventRelation(self.chance.choice(BETWEEN_EVENTS), left, right)

    def between_measures(self) -> Statement:
        name = self.chance.choice(BETWEEN_MEASURES)
        return MeasureRelation(name, self.formula(1), None if name == "invariant" else self.formula(1))

    def effect(self) -> Statement:
        return Effect(self.chance.choice(EFFECTS), self.chance.choice(self.events), self.formula(1))

    def lasting(self) -> Statement:
        event, formula = self.chance.choice(self.events), self.formula(1)
        condition = self.formula(1) if self.sometimes(0.4) else None
        if self.sometimes(0.5):
            ending = self.formula(1) if self.sometimes(0.4) else None
            return Lasting(event, condition, formula, self.chance.choice(self.events), ending)
        length = self.length(self.chance.randint(0, self.limits.longest))
        if self.uses("measured windows", 0.4):
            length = Length(MeasureRef("w"), self.unit)
        return Lasting(event, condition, formula, duration=length)

    def claim(self, label: str, kind: ClaimKind) -> Claim:
        form = self.chance.choice(FORMS)
        responses = [self.alternative(1) for _ in range(self.chance.choice((0, 1, 1, 2)))]
        if form == "when" and not responses:
            responses = [self.clause(0)]
        second = self.claim("", kind) if label and self.sometimes(0.3) else None
        condition = self.occasion() if self.sometimes(0.5) else None
        return Claim(kind, label, form, self.chance.choice(self.events), condition, tuple(responses), second)

    # Formulas -------------------------------------------------------------------------------------------------

    def occasion(self) -> Formula:
        """A condition of a rule or a claim, which may name events: mere inputs, or acts too."""
        return self.formula(1, self.events if self.has("events in conditions") else ())

    def formula(self, depth: int, events: tuple[str, ...] = ()) -> Formula:
        shape = self.chance.randrange(8 if depth else 4)
        if shape < 4:
            return self.leaf(events)
        if shape < 6:
            return Not(self.formula(depth - 1, events))
        parts = tuple(self.formula(depth - 1, events) for _ in range(self.chance.randint(2, 3)))
        return And(parts) if shape == 6 else Or(parts)

    def leaf(self, events: tuple[str, ...]) -> Formula:
        if events and self.sometimes(0.4):
            inputs = [event for event in events if event not in self.acts] or events
            return Atom("trigger", self.chance.choice(self.chance.choice((events, inputs))))
        kinds = [each for each in ("scales", "numbers", "calculations", "truths") if self.has(each)]
        kind = self.chance.choice(("", "", "", *kinds))
        operator = self.chance.choice(OPERATORS)
        if kind == "scales":
            rank = self.chance.randrange(len(SCALE))
            return Comparison(MeasureRef("risk"), operator, ScaleValue(SCALE[rank], rank))
        if kind == "calculations" and self.has("numbers"):
            return Comparison(Calculation(((1, ("w",)), (1, ("v",)))), operator, Number(self.chance.randint(1, 3)))
        if kind == "numbers":
            amount = self.length(self.chance.randint(0, self.limits.longest)).amount
            return Comparison(MeasureRef("w"), operator, MeasureRef("v") if self.sometimes(0.3) else amount)
        if kind == "truths" and self.sometimes(0.4):
            return Truth(self.sometimes(0.5))
        return Atom("condition", self.chance.choice(self.conditions))
