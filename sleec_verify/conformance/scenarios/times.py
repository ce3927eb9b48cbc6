"""Times in files of cases: whole seconds, or texts such as ``5 minutes``."""

from __future__ import annotations

import re

from sleec_runtime.model import LONGEST, SECONDS
from sleec_verify.entailment.situation_text import SituationError
from sleec_verify.wording.phrases import shortened

_TEXT = re.compile(r"([0-9]{1,20}) *(second|minute|hour|day)s?", re.ASCII)


def time_of(key: str, value: object) -> int:
    """A time in seconds. Raises SituationError."""
    shown = f"{key} is {shortened(repr(value))}"
    seconds = value
    if isinstance(value, str):
        match = _TEXT.fullmatch(value.strip())
        seconds = (
            None
            if match is None
            else int(match[1]) * next(length for unit, length in SECONDS.items() if unit == f"{match[2]}s")
        )
    if type(seconds) is not int:
        raise SituationError(f"{shown}, not a time", 'give whole seconds, or a text such as "5 minutes"')
    if seconds < 0:
        raise SituationError(f"{shown}, before the start", "a scenario starts at 0")
    if seconds > LONGEST:
        raise SituationError(f"{shown}, too long", f"the longest time is {LONGEST:,} seconds")
    return seconds
