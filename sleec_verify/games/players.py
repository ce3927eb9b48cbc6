"""Whose a relation is to keep: the robot's or the environment's."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.model import Agent, EventRelation, Lasting
from sleec_verify.encoding.relations import Relation, events_of


def is_environments(law: Relation, whose: Mapping[str, Agent]) -> bool:
    """Whether it is the environment that keeps a relation or constraint, so that it may be relied on.

    That is where no event of the robot has a part in it, and where the robot cannot help it: what is so for some time
    after an event, and that an event of the environment comes after another.
    """
    if isinstance(law, Lasting):
        return True
    names: Iterable[str] = events_of(law)
    if isinstance(law, EventRelation) and law.relation == "happenBefore":
        names = (law.right,)
    return all(whose.get(name, "environment") == "environment" for name in names)
