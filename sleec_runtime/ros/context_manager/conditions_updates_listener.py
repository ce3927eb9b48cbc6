"""The Conditions Updates Listener (paper, Section 4)."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.ros.context_manager.hedge_clauses_manager import HedgeClausesManager
from sleec_runtime.ros.messages import ConditionsUpdate
from sleec_runtime.ros.node import Node


class ConditionsUpdatesListener:
    """Follows the state of the user and the environment, on /conditions. Each message is one change of context."""

    def __init__(self, node: Node, hedge_clauses: HedgeClausesManager, save: Callable[[], object]) -> None:
        self._hedge_clauses = hedge_clauses
        self._save = save
        node.listen(ConditionsUpdate, self._received)

    def _received(self, message: ConditionsUpdate) -> None:
        self._hedge_clauses.update(message.conditions)
        self._save()
