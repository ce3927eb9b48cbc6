"""Replays the witnesses of a manifest with the evaluator, which shares no code with the solver."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sleec_runtime.errors import SleecError
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replay_finding
from sleec_verify.results.finding import Witness
from sleec_verify.results.json_values import witness_json

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value
    from sleec_verify.results.finding import Finding

KEYS = ("witness", "timeline")
"""The keys of a finding that contain its witness."""

_FRACTION = re.compile(r"-?[0-9]{1,200}/[0-9]{1,200}")
"""The spelling of numbers without an exact JSON number. Others, such as 1e999999999, would use up the memory."""


def same(one: object, other: object) -> bool:
    """Whether two values have the same JSON text. Unlike `==`, this distinguishes true from 1, and orders of keys."""
    return json.dumps(one) == json.dumps(other)


class Replay:
    """Replays witnesses of one ruleset."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._ruleset = ruleset
        self._cones: dict[str, RulesetIndex] = {}

    def shows(self, finding: Finding, computed: Mapping[str, Any], claim: Mapping[str, Any]) -> bool:
        """Whether the evaluator confirms the finding in the witness of the manifest. The witness must have its
        canonical JSON text. A trace must equal the trace of `computed`, the entry that was computed now."""
        if finding.witness is None or finding.timeline is not None:
            return all(same(claim.get(key), computed.get(key)) for key in KEYS)
        try:
            witness = self._witness(claim["witness"])
            if not same(claim["witness"], witness_json(witness)):
                return False
            found = replace(finding, witness=witness)
            return all(replay_finding(self._in(domain), found) for domain in finding.domains or ("",))
        except (KeyError, TypeError, ValueError, ZeroDivisionError, SleecError):
            return False

    def _witness(self, claim: Mapping[str, Any]) -> Witness:
        triggers = tuple(sorted(set(claim["triggers"])))
        values = {name: self._value(name, value) for name, value in sorted(claim["conditions"].items())}
        absent = tuple(sorted(set(claim.get("absent", ()))))
        if not self._ruleset.triggers.issuperset((*triggers, *absent)):
            raise ValueError("a trigger that the rules do not have")
        if not set(absent).isdisjoint(triggers):
            raise ValueError("a trigger that occurs and does not")
        return Witness(triggers, values, absent)

    def _value(self, name: str, value: object) -> Value:
        measure = self._ruleset.measures.get(name)
        if measure is None:
            if name not in self._ruleset.conditions or not isinstance(value, bool):
                raise ValueError("no condition, or no truth value")
            return value
        if measure.kind == "scale":
            if value not in measure.values:
                raise ValueError("no value of the scale")
            return str(value)
        if isinstance(value, bool) or not isinstance(value, (int, float, str)):
            raise ValueError("no number")
        if isinstance(value, str) and not _FRACTION.fullmatch(value):
            raise ValueError("no number as certificates have them")
        number = Fraction(str(value))
        return number.numerator if number.denominator == 1 else number

    def _in(self, domain: str) -> RulesetIndex:
        if domain not in self._cones:
            self._cones[domain] = RulesetIndex(self._ruleset.in_domain(domain) if domain else self._ruleset)
        return self._cones[domain]
