"""The names that assertions may use."""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.model import (
    Measure,
    Rational,
    Ruleset,
)


class Vocabulary:
    """The names that assertions may use: those of some rulesets. If these use a name differently, the first one
    decides."""

    def __init__(self, rulesets: Iterable[Ruleset]) -> None:
        self.triggers: set[str] = set()
        self.conditions: set[str] = set()
        self.obligations: set[str] = set()
        self.measures: dict[str, Measure] = {}
        self.constants: dict[str, Rational] = {}
        for ruleset in rulesets:
            said = self.triggers | self.conditions | self.measures.keys()
            self.triggers |= ruleset.triggers - said
            self.conditions |= ruleset.conditions - said
            self.obligations |= ruleset.obligations
            for name, measure in ruleset.measures.items():
                if name not in said:
                    self.measures[name] = measure
            for name, constant in ruleset.constants.items():
                self.constants.setdefault(name, constant.value)
