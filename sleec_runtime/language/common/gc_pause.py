"""Parsing makes many objects and no cycles: looking for them again and again takes a fifth of its time."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def uncollected() -> Iterator[None]:
    """No collection of garbage inside, and no walk through what was made there soon after."""
    was_collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_collecting:
            if not gc.get_freeze_count():
                # All that is new becomes old at once, unseen; else the first collection would walk through it.
                gc.freeze()
                gc.unfreeze()
            gc.enable()
