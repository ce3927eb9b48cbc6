"""Small random rulesets with times, by a seed: rules that trigger each other, clash, and repeat themselves often.

Each is written as a text of the DSL and read from it, so that a ruleset that fails a test can be shown, kept and read
again: `print_ruleset(ruleset)`, or `ruleset.source.text`.
"""

from __future__ import annotations

from random import Random

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset

EVENTS = ("A", "B", "C", "D")
BOOLEANS = ("m", "n")
SCALE = ("low", "middle", "high")


def timed_ruleset(
    seed: int,
    rules: int = 5,
    events: int = 4,
    booleans: int = 2,
    scale: bool = True,
    longest: int = 3,
    relations: int = 2,
    hedges: int = 2,
    calculations: bool = False,
    named: bool = False,
    lengths: bool = False,
) -> Ruleset:
    """A ruleset with one rule at least and the given numbers at most; no window is over after `longest` seconds. With
    `calculations`, half of its conditions calculate with two numbers; with `named`, half of those of its rules and
    claims name events. With `lengths`, measures with declared ranges give half of the lengths of its windows."""
    random = Random(seed)
    writer = _Writer(random, rules, events, booleans, scale, longest, relations, hedges, calculations)
    writer.named, writer.lengths = named, lengths
    return parse(writer.text())


class _Writer:
    def __init__(
        self,
        random: Random,
        rules: int,
        events: int,
        booleans: int,
        scale: bool,
        longest: int,
        relations: int,
        hedges: int,
        calculations: bool,
    ) -> None:
        self.random = random
        self.rules, self.relations, self.most_hedges = rules, relations, hedges
        self.events, self.booleans = EVENTS[:events], BOOLEANS[:booleans]
        # Two texts in three do without the scale: most of what can go wrong needs no third value.
        self.scale = scale and random.randrange(3) == 0
        self.longest = longest
        self.calculations = calculations
        self.named = False
        self.lengths = False

    def text(self) -> str:
        definitions = [f"event {e}" for e in self.events]
        definitions += [f"measure {m}: boolean" for m in self.booleans]
        if self.calculations:
            definitions += ["measure x: numeric", "measure y: numeric"]
        if self.lengths:
            definitions += ["measure w: numeric", "measure v: numeric"]
        if self.scale:
            definitions.append(f"measure risk: scale({', '.join(SCALE)})")
        rules = [self.rule(f"R{number}") for number in range(self.random.randint(1, self.rules))]
        relations = [self.relation() for _ in range(self.few(self.relations))]
        if self.lengths:
            relations += self.ranges()
        concerns = [self.claim("c1")] if self.random.random() < 0.5 else []
        purposes = [self.claim("p1")] if self.random.random() < 0.5 else []
        blocks = (
            ("def", definitions),
            ("rule", rules),
            ("relation", relations),
            ("concern", concerns),
            ("purpose", purposes),
        )
        return "".join(
            f"{name}_start\n" + "".join(f"  {line}\n" for line in lines) + f"{name}_end\n"
            for name, lines in blocks
            if lines
        )

    def few(self, most: int) -> int:
        """None or a few, and none about half of the time."""
        return max(0, self.random.randint(-most, most))

    def ranges(self) -> list[str]:
        """Relations that bound the measures of lengths, one of them perhaps by the other."""
        least, most = self.random.randint(0, 1), self.random.randint(1, self.longest)
        bound = self.random.choice((str(most), "{w}"))
        return [
            f"measure invariant (({{w}} >= {least}) and ({{w}} <= {most}))",
            f"measure invariant (({{v}} >= 0) and ({{v}} <= {bound}))",
        ]

    def event(self) -> str:
        return self.random.choice(self.events)

    def condition(self, depth: int = 1) -> str:
        kind = self.random.randrange(8)
        if depth and kind == 0:
            word = self.random.choice(("and", "or"))
            return f"({self.condition(depth - 1)} {word} {self.condition(depth - 1)})"
        if depth and kind in (1, 2):
            return f"(not {self.condition(0)})"
        if self.named and kind in (3, 4, 5, 6):
            return self.event()
        if self.calculations and kind in (3, 4, 5, 6):
            calculated = self.random.choice(("{x} + {y}", "{x} - {y}", "{x} * {y}", "2 * {x} + {y}", "{y} - 3 * {x}"))
            return (
                f"(({calculated}) {self.random.choice(('<', '<=', '=', '<>', '>=', '>'))} {self.random.randint(-3, 4)})"
            )
        if self.lengths and kind in (3, 4):
            side = self.random.choice(("{w}", "{v}"))
            other = self.random.choice(("{w}", str(self.random.randint(0, self.longest))))
            return f"({side} {self.random.choice(('<', '<=', '=', '<>', '>=', '>'))} {other})"
        if self.scale and kind in (3, 4):
            return f"({{risk}} {self.random.choice(('<', '<=', '=', '<>', '>=', '>'))} {self.random.choice(SCALE)})"
        return "{" + self.random.choice(self.booleans) + "}"

    def maybe_condition(self) -> str:
        return f" and {self.condition()}" if self.random.randrange(3) == 0 else ""

    def response(self, depth: int = 2) -> str:
        text = ("not " if self.random.randrange(4) == 0 else "") + self.event() + self.window()
        if depth and self.random.randrange(5) == 0:
            text += f" otherwise {self.alternative(depth - 1)}"
        if depth and self.random.randrange(8) == 0:
            text += f" else {self.alternative(depth - 1)}"
        return text

    def alternative(self, depth: int) -> str:
        if self.random.randrange(4):
            return self.response(depth)
        return "{" + self.response(0) + "".join(self.hedges()) + "}"

    def window(self) -> str:
        kind = self.random.randrange(8)
        if kind < 2:
            return ""
        if kind == 2:
            return " eventually"
        if self.lengths and self.random.randrange(2):
            return self.measured_window()
        end = self.random.randint(0, self.longest)
        if kind < 6:
            return f" within {end} seconds"
        return f" within [{self.random.randint(0, end)}, {end}] seconds"

    def measured_window(self) -> str:
        written = ("{w}", "{w}", "{v}", "({w} + 1)", "[{v}, {w}]", "[{v}, {w} + {v}]", f"[{{v}}, {self.longest}]")
        return f" within {self.random.choice(written)} seconds"

    def hedges(self) -> list[str]:
        return [self.hedge() for _ in range(self.few(self.most_hedges))]

    def hedge(self) -> str:
        text = f" unless {self.condition()}"
        if self.random.randrange(4) == 0:
            return text
        return f"{text} then {self.alternative(1)}"

    def rule(self, label: str) -> str:
        return f"{label} when {self.event()}{self.maybe_condition()} then {self.response()}{''.join(self.hedges())}"

    def relation(self) -> str:
        named, self.named = self.named, False
        try:
            return self.relation_of_states()
        finally:
            self.named = named

    def relation_of_states(self) -> str:
        a, b = self.event(), self.event()
        p, q = self.condition(), self.condition()
        kind = self.random.randrange(13)
        if kind < 4:
            return f"{('witness', 'equal', 'mutualExclusive', 'happenBefore')[kind]} {a} {b}"
        if kind < 6:
            return f"measure {self.random.choice(('imply', 'iff', 'mutualExclusive', 'opposite'))} {p} {q}"
        if kind == 6:
            return f"measure invariant {p}"
        if kind < 11:
            return f"{('causation', 'includes', 'forbid', 'forbid')[kind - 7]} {a} {p}"
        if kind == 11:
            return f"when {a}{self.maybe_condition()} then {p} until {b}{self.maybe_condition()}"
        most = self.random.choice(("{w}", "{v}")) if self.lengths else str(self.random.randint(0, self.longest))
        return f"when {a}{self.maybe_condition()} then {p} for {most} seconds"

    def claim(self, label: str) -> str:
        if self.random.randrange(2):
            return f"{label} when {self.event()}{self.maybe_condition()} then {self.alternative(1)}"
        text = f"{label} exists {self.event()}{self.maybe_condition()}"
        text += "".join(f" while {self.alternative(0)}" for _ in range(self.random.randrange(3)))
        if self.random.randrange(5) == 0:
            text += f" meanwhile (exists {self.event()}{self.maybe_condition()})"
        return text
