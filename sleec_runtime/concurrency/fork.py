"""Renewal of locks and threads after `os.fork`: the new process has one thread, and locks of others stay locked."""

from __future__ import annotations

import os
from typing import Protocol
from weakref import WeakSet


class Renewable(Protocol):
    """An object with locks or threads."""

    def after_fork(self) -> None:
        """Makes the object usable in the new process."""


_renewables: WeakSet[Renewable] = WeakSet()


def renew_after_fork(renewable: Renewable) -> None:
    """Calls `renewable.after_fork` in each process that is forked from this one."""
    _renewables.add(renewable)


def renew() -> None:
    """Renews all registered objects that still exist."""
    for renewable in tuple(_renewables):
        renewable.after_fork()


if hasattr(os, "register_at_fork"):  # not on Windows
    os.register_at_fork(after_in_child=renew)
