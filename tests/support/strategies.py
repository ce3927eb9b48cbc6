"""The strategies of `sleec_verify.conformance`, and contexts that keep no assumption."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from sleec_runtime.model import Context, Ruleset
from sleec_verify.conformance.rulesets import formulas, rulesets
from sleec_verify.conformance.vocabulary import VALUES

__all__ = ["contexts", "formulas", "rulesets"]


@st.composite
def contexts(draw: st.DrawFn, ruleset: Ruleset) -> Context:
    """Situations for `ruleset`: any triggers, conditions true or false, and for measures values near those that the
    rules compare them with; some conditions and measures are left out."""
    conditions: dict[str, bool | int | Fraction | str] = {}
    for name in sorted(ruleset.conditions):
        if draw(st.booleans()):
            conditions[name] = draw(st.booleans())
    for name, measure in sorted(ruleset.measures.items()):
        if draw(st.integers(0, 5)) == 0:
            continue
        if measure.kind == "scale":
            conditions[name] = draw(st.sampled_from(measure.values))
        else:
            value = draw(st.sampled_from(VALUES)) + draw(st.integers(-1, 1))
            conditions[name] = int(value) if measure.kind == "integer" else value
    triggers = draw(st.sets(st.sampled_from(sorted(ruleset.triggers))))
    return Context(frozenset(triggers), conditions)
