"""Why some rules are in no conflict, as evidence: the templates of continuations that serve their situations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.model import Rule, Ruleset, Value


class LaterInstant(NamedTuple):
    """An instant of a template: this number of `seconds` after a time, which is ``now``, or the trigger of a pending
    response or relation; its events, and the conditions and measures that matter."""

    after: str
    seconds: int
    events: frozenset[str]
    conditions: Mapping[str, Value]


class Example(NamedTuple):
    """A situation that a template fits: a lawful history, now (the instant with the number `now`), and the continuation
    of the template. `rules` are those of the situation, without the responses that can always be met."""

    rules: tuple[Rule, ...]
    instants: tuple[tuple[int, frozenset[str], Mapping[str, Value]], ...]
    now: int


class UsedTemplate(NamedTuple):
    """A continuation: `acts` occur now, in addition to what the rules require at once, and `later` follows. `policies`
    are the instants that follow each trigger of a response of which several can be pending."""

    acts: tuple[str, ...]
    later: tuple[LaterInstant, ...]
    policies: tuple[tuple[str, tuple[LaterInstant, ...]], ...]
    example: Example | None


class FreeComponent(NamedTuple):
    """Rules of `ruleset`, by label, that are in no conflict, and the templates that the last refutation uses."""

    ruleset: Ruleset
    labels: tuple[str, ...]
    templates: tuple[UsedTemplate, ...]
