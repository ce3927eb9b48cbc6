"""Any other value in any place of a JSON document."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

_DEEP = "[" * 300 + "]" * 300

HOSTILE = (
    *("null", "0", "1", "-1", "2.5", "1e999", "1e-5000", "9" * 4_000, "1" + "0" * 400, "true", "NaN"),
    *('""', '"\\u0000"', '"\\u202e\\u001b[31m"', '"WHEN"', f'"{"x" * 20_000}"', '"WHEN A AND ' + "(" * 999 + '"'),
    *("[]", "[null]", '["Bell,Bell"]', "[[1, 2]]", _DEEP, "{}", '{"": 1}', '{"Age": {}}', '{"Asleep=true,Age": 1}'),
    *('{"Age": "1/0"}', '{"Age": "3,Asleep=true"}', '{" Age ": 1}', '{"Risk": 3}', '{"Asleep": "yes"}', '"\\ud800"'),
    *('"1/3"', '"1/0"', '"home"', '"low"'),
)
"""Values that no program of ours writes, as JSON."""


def places(value: object, above: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The places of a JSON value, each as the keys that lead to it."""
    yield above
    keys = value.keys() if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    for key in keys:
        yield from places(value[key], (*above, key))  # type: ignore[index]


def replaced(value: Any, place: tuple[Any, ...], new: str) -> str:
    """The JSON of a value with other JSON at a place."""
    value = json.loads(json.dumps(value))
    inner = value
    for key in place[:-1]:
        inner = inner[key]
    if not place:
        return new
    inner[place[-1]] = "@"
    return json.dumps(value).replace('"@"', new)
