"""The messages of the nodes. docs/ros.md has a table of topics and fields."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from sleec_runtime.ros.json_object import read_object
from sleec_runtime.ros.message import Conditions, Message, conditions_of
from sleec_runtime.ros.transport import Topic


@dataclass(frozen=True, kw_only=True)
class DomainChange(Message):
    """The robot is in another domain; None puts the rules of all domains in force."""

    topic = Topic("/domain")
    domain: str | None


@dataclass(frozen=True, kw_only=True)
class ConditionsUpdate(Message):
    """Conditions and measures that have changed. On the wire also without `v` and `conditions`: {"Fever": true}."""

    topic = Topic("/conditions", depth=100)
    conditions: Conditions

    @classmethod
    def from_json(cls, text: object) -> ConditionsUpdate:
        """Raises MalformedMessage."""
        given = read_object(text, cls.max_size)
        # No condition has an object as its value.
        if "v" in given or isinstance(given.get("conditions"), dict):
            return super().from_json(text)
        return cls(conditions=conditions_of("the message", given))


@dataclass(frozen=True, kw_only=True)
class LayersUpdate(Message):
    """A change of context, and the layers that it activates and deactivates. Numbers are consecutive.

    A `full` update carries all reported conditions and all active layers, not only those that changed. `ruleset` is the
    digest of the rules.
    """

    topic = Topic("/layers_update", latched=True, depth=64)
    max_size = 16 * 1024 * 1024
    manager: str
    number: int
    ruleset: str
    reading: str
    domain: str | None = None
    full: bool = False
    conditions: Conditions
    activate: tuple[str, ...]
    deactivate: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class LayersRequest(Message):
    """A node asks for a full update. `have` is the number of its last update, None if it has none."""

    topic = Topic("/layers_request")
    node: str
    ruleset: str
    reading: str
    have: int | None = None


@dataclass(frozen=True, kw_only=True)
class Heartbeat(Message):
    """The Context Manager is alive, and this is the number of its last update."""

    topic = Topic("/heartbeat")
    manager: str
    number: int
    beat: int
    ruleset: str
    reading: str


@dataclass(frozen=True, kw_only=True)
class MissionEvent(Message):
    """A trigger occurs. A second message with the same `id` is ignored."""

    topic = Topic("/mission", depth=100)
    trigger: str
    arguments: Mapping[str, Any] = field(default_factory=dict)
    id: str | None = None


@dataclass(frozen=True, kw_only=True)
class Executed(Message):
    """A node reports what it did for a trigger, in the context of update `number` of `manager`. Without a trigger, the
    Context Manager started an obligation.

    `due` are the obligations that the rules require, by the decision of the node. `executed` are those that its code
    executed, in order, as a recording saw them; None if nobody recorded. Only `executed` says what the robot did: the
    code of a variant may execute something else than its rule requires. `unrecorded` are those of `due` that no
    recording can see, because the code has no callable for them. Version 1 had `due` as `obligations`, and nothing
    else of this.

    `refused` is the reason why the node executed nothing, and `failed` the error that its code raised. `policy` is that
    of a node that was out of step. Times are in seconds since 1970: `triggered` when the trigger arrived, `time` at the
    end.
    """

    topic = Topic("/executed", depth=100)
    version = 2
    node: str
    triggered: float
    time: float
    trigger: str | None = None
    due: tuple[str, ...] = ()
    executed: tuple[str, ...] | None = None
    unrecorded: tuple[str, ...] = ()
    clauses: tuple[tuple[str, int], ...] = ()
    manager: str | None = None
    number: int | None = None
    policy: str | None = None
    refused: str | None = None
    failed: str | None = None

    @classmethod
    def read_earlier(cls, version: int, given: dict[str, Any]) -> bool:
        if version != 1:
            return False
        given["due"] = given.pop("obligations", [])
        return True


@dataclass(frozen=True, kw_only=True)
class Start(Message):
    """The Context Manager starts an obligation of a rule with time. It repeats the message until it is completed."""

    topic = Topic("/obligations", depth=100)
    manager: str
    number: int
    beat: int
    id: str
    obligation: str
    arguments: Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Completed(Message):
    """A node has completed the obligation of a `Start`."""

    topic = Topic("/completions", depth=100)
    node: str
    id: str
    obligation: str
