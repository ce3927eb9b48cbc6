"""Rules of the DSL over fixed definitions."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import (
    Ruleset,
)

DEFINITIONS = """def_start
  event A
  event B as system
  event C as environment
  measure m: boolean
  measure n: boolean
  measure x: numeric
  measure risk: scale(low, middle, high)
  constant K = 5
  constant L = K
def_end
"""


def rules(text: str) -> Ruleset:
    return parse(f"{DEFINITIONS}rule_start\n{text}\nrule_end\n")


def timing(text: str):
    (rule,) = rules(f"R1 when A then {text}").rules
    return rule.default.obligations[0].timing


def problems_of(text: str) -> list[tuple[int, str]]:
    with pytest.raises(LanguageError) as caught:
        parse(text)
    return [(caught.value.source.place(p.span).line, p.message) for p in caught.value.problems]
