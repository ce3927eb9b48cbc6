"""Snapshots of what is pending, restored by another instance."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.errors import NotEnforced
from sleec_runtime.language import parse_source
from sleec_runtime.language.common.source import decode_source
from tests.fuzz.property import unless_refused

SAVED_AT = 1_764_000_000
RULESET = parse_source(
    decode_source(
        "fuzz.sleec",
        b"""\
MEASURE Age: number
MEASURE wait: integer
RULE fall WHEN Fall THEN Call WITHIN 5 minutes OTHERWISE Shout WITHIN 1 minute OTHERWISE Warn
RULE nap WHEN Nap THEN NOT Clean WITHIN 2 TO 5 seconds OTHERWISE Warn
RULE walk WHEN Morning THEN Offer WITHIN 10 TO 60 seconds AND Open WITHIN 20 TO 60 seconds
RULE ask WHEN Ask THEN Answer WITHIN wait seconds OTHERWISE (Warn UNLESS Awake AND Age > 36.5)
RULE pick WHEN Choice THEN Left WITHIN 4 seconds ELSE Right WITHIN 8 seconds
""",
    )
)


def snapshot(data: bytes, folder: Path) -> None:
    """What is restored is saved and restored again as the same, and goes on as time passes."""
    try:
        saved = json.loads(data)
    except (ValueError, RecursionError):
        return
    sleec, clock = _instance()
    if unless_refused(sleec.restore, saved, SAVED_AT) is None:
        return
    again = sleec.pending_snapshot(SAVED_AT)
    other, _ = _instance()
    other.restore(json.loads(json.dumps(again)), SAVED_AT)
    assert other.pending_snapshot(SAVED_AT) == again
    clock.advance(1000)


def _instance() -> tuple[Sleec, VirtualClock]:
    clock = VirtualClock()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotEnforced)  # a window for as long as `wait` says
        sleec = Sleec(RULESET, clock=clock, on_error=lambda failure: None)
    for name in RULESET.obligations:
        sleec.implement({name: _code(name)})
    return sleec, clock


def _code(name: str) -> Any:
    @obligation(name, completes=name not in ("Call", "Answer", "Left"))
    def code(*args: object, **kwargs: object) -> None:
        pass

    return code


def snapshot_seeds() -> Iterator[bytes]:
    sleec, clock = _instance()
    sleec.update({"Awake": True, "Age": 37.5, "wait": 30})
    for trigger in ("Fall", "Nap", "Morning", "Ask", "Choice"):
        sleec.trigger(trigger, "bath", room=[2, None])
        clock.advance(1)
        yield json.dumps(sleec.pending_snapshot(SAVED_AT)).encode()
