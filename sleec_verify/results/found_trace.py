"""Traces that answer questions of checks with yes, as evidence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.model import Rule, Ruleset, Value

Shows = Literal[
    "violation",
    "violation-with-hedge",
    "violation-without-hedge",
    "trigger",
    "decision",
    "concern",
    "purpose",
    "conflict",
    "response",
]
"""What a trace shows:

- ``violation``: it violates this rule and nothing else.
- ``violation-with-hedge``: it violates this rule, and nothing if the rule loses this hedge.
- ``violation-without-hedge``: it violates nothing, and only this rule if the rule loses this hedge.
- ``trigger``: it violates nothing, triggers this rule, and the guard holds.
- ``decision``: it violates no relation or constraint, and this clause decides.
- ``concern``, ``purpose``: it violates nothing, and this claim occurs.
- ``conflict``: up to its last instant, which is now, it is a lawful history, and these clauses decide. Clause -1 is
  that of a rule that only a response triggers.
- ``response``: the same up to the instant `now`, and the whole trace violates no relation and none of `rules`: those of
  the conflict but one.
"""


class FoundTrace(NamedTuple):
    """A trace of `ruleset`, which may be one domain of a text, and what it shows about rules or claims, each with the
    number of a clause or None. An instant has its time in seconds, its events, and the conditions and measures that
    matter. `changed` is the rule without the hedge, if the question is about one. `rules` are those that a response
    complies with, without what can always be met. `now` is the number of an instant,
    and `inputs` are the events of now that are not part of the response."""

    ruleset: Ruleset
    shows: Shows
    about: tuple[tuple[str, int | None], ...]
    instants: tuple[tuple[int, frozenset[str], Mapping[str, Value]], ...]
    changed: Rule | None = None
    rules: tuple[Rule, ...] = ()
    now: int | None = None
    inputs: frozenset[str] = frozenset()
