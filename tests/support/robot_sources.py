"""Robots written for any ruleset, in several spellings, as values that can be changed before they become text."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

from sleec_runtime.dispatch.implementations import snake_case
from sleec_runtime.model import Ruleset


@dataclass
class Written:
    """One variant: its layer (None for the base), and its lines, of which the obligations are in braces."""

    layer: str | None
    calls: list[str]
    decorator: str | None = None
    lines: list[str] = field(default_factory=list)


@dataclass
class Robot:
    """The methods by the labels of their rules, and how it is all spelled."""

    ruleset: Ruleset
    methods: dict[str, list[Written]]
    module_level: bool
    imports: int
    aliases: bool
    marked: frozenset[str]
    helpers: bool
    more: str = ""

    def text(self) -> str:
        """The source of a module."""
        lines = [_IMPORTS[self.imports][0], "import sleec_runtime", "", "sleec = sleec_runtime.load('rules.sleec')"]
        if self.aliases:
            lines.append("L = sleec.layers")
        lines += ["", "" if self.module_level else "class Robot:"]
        body: list[str] = []
        for place, (label, variants) in enumerate(self.methods.items()):
            for number, written in enumerate(variants):
                body += [] if number else [f"@sleec.rule({label!r})"]
                body.append(self._decorator(written))
                body.append(f"def rule_{place}({self._self('*args')}):")
                body += [f"    {line}" for line in self._lines(written)] + [""]
        methods = "\n".join(body)
        for name in sorted(self.ruleset.obligations):
            if name in self.marked:
                body.append(f"@sleec_runtime.obligation({name!r})")
            body += [f"def {self._method(name)}({self._self()}): ...", ""]
            if self.helpers and self.call(name) in methods:
                body += [f"def help_{self._method(name)}({self._self()}):", f"    {self._call(name)}", ""]
        body += [line for line in self.more.split("\n") if line]
        indent = "" if self.module_level else "    "
        return "\n".join(lines + [indent + line for line in body]) + "\n"

    def call(self, name: str) -> str:
        """A call that executes an obligation, from within a method."""
        return f"{'' if self.module_level else 'self.'}{'help_' if self.helpers else ''}{self._method(name)}()"

    def _call(self, name: str) -> str:
        return f"{'' if self.module_level else 'self.'}{self._method(name)}()"

    def _method(self, name: str) -> str:
        return f"does_{snake_case(name)}" if name in self.marked else snake_case(name)

    def _self(self, *more: str) -> str:
        return ", ".join(more if self.module_level else ("self", *more))

    def _decorator(self, written: Written) -> str:
        if written.decorator is not None:
            return f"@{written.decorator}"
        _, base, around = _IMPORTS[self.imports]
        if written.layer is None:
            return f"@{base}"
        label, _, number = written.layer.rpartition(".hc")
        layer = f'L[f"{label}.hc{{{number}}}"]' if self.aliases else f"sleec.layers[{written.layer!r}]"
        return f"@{around}({layer})"

    def _lines(self, written: Written) -> list[str]:
        return [*(self.call(name) for name in written.calls), *written.lines] or ["pass"]

    @property
    def proceed(self) -> str:
        return _IMPORTS[self.imports][2].replace("around", "proceed").replace("when", "go_on")


_IMPORTS = (
    ("import contextpy3 as cop", "cop.base", "cop.around"),
    ("import contextpy3", "contextpy3.base", "contextpy3.around"),
    ("from contextpy3 import around as when, base as default, proceed as go_on", "default", "when"),
    ("from contextpy3 import *", "base", "around"),
)


@st.composite
def robots(draw: st.DrawFn, ruleset: Ruleset) -> Robot:
    """Correct robots for a ruleset, their variants in any order."""
    methods = {}
    for rule in ruleset.rules:
        variants = [
            Written(
                rule.layer(number),
                list(dict.fromkeys(literal.name for literal in clause.obligations if not literal.negated)),
            )
            for number, clause in enumerate(rule.clauses())
        ]
        methods[rule.label] = draw(st.permutations(variants))
    obligations = sorted(ruleset.obligations)
    return Robot(
        ruleset,
        methods,
        module_level=draw(st.booleans()),
        imports=draw(st.integers(0, len(_IMPORTS) - 1)),
        aliases=draw(st.booleans()),
        marked=frozenset(name for name in obligations if not snake_case(name).isidentifier() or draw(st.booleans())),
        helpers=draw(st.booleans()),
    )
