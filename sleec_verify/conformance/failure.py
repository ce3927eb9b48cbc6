"""Nonconformance: a difference between what was executed and what was due, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.errors import ConflictInContext, UndeterminedDecision
from sleec_runtime.model import Context, Ruleset
from sleec_verify.conformance.oracle import Expectation
from sleec_verify.conformance.subject import Observation
from sleec_verify.wording.phrases import context_text


class Nonconformance(AssertionError):
    """The subject did not execute what the rules oblige. Its text is a report; its attributes are for programs."""

    def __init__(
        self, context: Context, expected: Expectation, observed: Observation, what: str, before: Sequence[str] = ()
    ) -> None:
        self.context = context
        self.expected = expected
        self.observed = observed
        self.what = what
        self.before = tuple(before)
        super().__init__("\n".join(_lines(self)))

    def after(self, before: Sequence[str]) -> Nonconformance:
        """The same, with its history."""
        return Nonconformance(self.context, self.expected, self.observed, self.what, before)


def difference(context: Context, expected: Expectation, observed: Observation, ruleset: Ruleset) -> str | None:
    """What is wrong with an observation, or None. A context that violates an assumption does not count."""
    executed, error = observed.executed, observed.error
    if not expected.possible:
        return None
    if isinstance(error, UndeterminedDecision) and not executed and not _total(context, ruleset):
        return None
    if expected.conflict:
        if isinstance(error, ConflictInContext) and not executed:
            return None
        if executed:
            return f"executed {_listed(executed)} although the rules contradict each other"
        return (
            f"raised {error!r} where the rules contradict each other"
            if error
            else "did not refuse although the rules contradict each other"
        )
    forbidden = [name for name in dict.fromkeys(executed) if name in expected.prohibited]
    missing = [name for name in dict.fromkeys(expected.due) if name not in executed]
    extra = [name for name in dict.fromkeys(executed) if name not in expected.due and name not in forbidden]
    parts = [
        f"{words} {_listed(names)}"
        for words, names in (
            ("executed, although forbidden,", forbidden),
            ("did not execute", missing),
            ("executed, although not required,", extra),
        )
        if names
    ]
    if error is not None:
        parts.append(f"raised {type(error).__name__}: {error}")
    if not parts and sorted(executed) != sorted(expected.due):
        parts.append("executed an obligation more or less often than required")
    if not parts and executed != expected.due:
        parts.append("executed in the wrong order")
    return "; ".join(parts) or None


def situation_text(context: Context) -> str:
    """A context in words, without false conditions."""
    return context_text(Context(context.triggers, {n: v for n, v in context.conditions.items() if v is not False}))


def _total(context: Context, ruleset: Ruleset) -> bool:
    return context.conditions.keys() >= ruleset.conditions | ruleset.measures.keys()


def _lines(failure: Nonconformance) -> Iterator[str]:
    expected = failure.expected
    yield failure.what
    yield f"  situation: {situation_text(failure.context)}"
    yield f"  executed:  {_listed(failure.observed.executed)}"
    required = "a refusal, because the rules contradict each other" if expected.conflict else _listed(expected.due)
    yield f"  required:  {required}"
    for active in expected.active:
        layer = f"layer {active.layer}" if active.layer else "the rule's base, no layer"
        says = " AND ".join(map(str, active.obligations)) or "nothing"
        yield f"    by rule {active.rule}, clause {active.clause}, {layer}: {says}"
    if not expected.active:
        yield "    no rule requires it"
    if failure.before:
        yield "  after:"
        yield from (f"    {step}" for step in failure.before)


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names) or "nothing"
