"""Who writes what a hint says has a text that is right, and that says something."""

from __future__ import annotations

import re

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import Truth

TEXT = """def_start
  event A
  event B
  measure m: boolean
  measure p: boolean
  measure n: numeric
  measure s: scale(lo, hi)
  constant K = 5
def_end
rule_start
  R1 when A and {} then B
rule_end
"""


_EXAMPLE = re.compile(r"(?:as in: |for example: |equal, write |write )((?:\(m|[\w]+ [<>=]).*|m)(?= alone|$)")


@pytest.mark.parametrize(
    "condition",
    ["K", "n", "s", "lo", "3", "3 = true", "n = true", "s = false", "m > 3", "m = K", "m = n", "m = p", "m > true"],
)
def test_a_comparison_is_written_as_the_hint_says(condition: str) -> None:
    with pytest.raises(LanguageError) as caught:
        parse(TEXT.format(condition))
    (problem,) = caught.value.problems
    assert problem.hint is not None
    found = re.search(_EXAMPLE, problem.hint)
    assert found is not None, problem.hint
    guard = parse(TEXT.format(found[1])).rules[0].guard
    assert guard is not None
    assert not isinstance(guard, Truth)
