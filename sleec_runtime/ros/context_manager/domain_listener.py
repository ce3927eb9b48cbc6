"""The Domain Listener (paper, Section 4)."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.ros.context_manager.hedge_clauses_manager import HedgeClausesManager
from sleec_runtime.ros.messages import DomainChange
from sleec_runtime.ros.node import Node


class DomainListener:
    """Follows the domain of the robot, on /domain: the rules of that domain are in force."""

    def __init__(self, node: Node, hedge_clauses: HedgeClausesManager, save: Callable[[], object]) -> None:
        self._hedge_clauses = hedge_clauses
        self._save = save
        node.listen(DomainChange, self._received)

    def _received(self, message: DomainChange) -> None:
        self._hedge_clauses.enter_domain(message.domain)
        self._save()
