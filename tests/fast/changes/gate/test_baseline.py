"""Baselines: what is written is read, and nothing else is."""

from __future__ import annotations

import json
from contextlib import suppress
from typing import Any

import pytest

from sleec_verify.changes.gate.baseline import Key, baseline_text, read_baseline
from sleec_verify.changes.gate.keys import ConfigError

KEYS: set[Key] = {
    ("a.sleec", "SLEEC101", ("r", "s"), (("r", 0), ("s", 1)), ("Open", "NOT Close"), "0f61c2a98b3d4e57"),
    ("b.sleec", "SLEEC201", (), (), (), "1" * 16),
}
TEXT = baseline_text(KEYS)


def test_what_is_written_is_read() -> None:
    assert read_baseline(TEXT.encode(), "known.json") == KEYS


def paths(value: Any, *path: Any) -> list[tuple[Any, ...]]:
    """Where the values of JSON stand."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [path, *(place for key, one in items for place in paths(one, *path, key))]


@pytest.mark.parametrize("put", ["null", "true", "1.0", "1e400", "NaN", '"x"', "[]", "{}", "[[]]", "9" * 5000])
@pytest.mark.parametrize("path", paths(json.loads(TEXT)), ids=str)
def test_another_value_is_read_as_itself_or_refused(path: tuple[Any, ...], put: str) -> None:
    marked: Any = [json.loads(TEXT)]
    at = marked
    for key in (0, *path)[:-1]:
        at = at[key]
    at[(0, *path)[-1]] = "here!"
    text = json.dumps(marked[0]).replace('"here!"', put)
    with suppress(ConfigError):
        assert findings(baseline_text(read_baseline(text.encode(), "known.json"))) == findings(text)


def findings(text: str) -> list[str]:
    """The findings in JSON, with the types of their values."""
    return sorted(map(repr, json.loads(text)["findings"]))


@pytest.mark.parametrize(
    "data", [b"", b"[" * 100_000, b"\xff", b"{", b'{"version": 1}', b'{"version": 3, "findings": []}']
)
def test_no_baseline(data: bytes) -> None:
    with pytest.raises(ConfigError, match=r"is not a baseline|is a baseline of version 3"):
        read_baseline(data, "known.json")
