"""Which player owns a relation: the robot or the environment."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.model import Agent, EventRelation, Lasting
from sleec_verify.encoding.relations import Relation, events_of


def is_environments(law: Relation, whose: Mapping[str, Agent]) -> bool:
    """Whether the environment owns a relation or constraint, so that the robot may rely on it.

    It does if the relation names no event of the robot. It also owns what holds for some time after an event, and the
    requirement that an event precedes an event of the environment.
    """
    if isinstance(law, Lasting):
        return True
    names: Iterable[str] = events_of(law)
    if isinstance(law, EventRelation) and law.relation == "happenBefore":
        names = (law.right,)
    return all(whose.get(name, "environment") == "environment" for name in names)
