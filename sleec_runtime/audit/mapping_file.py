"""Files of mappings, in TOML (docs/mapping.md).

tolerance = 1
domain = {topic = "/mode", field = "data"}

[conditions]
UserUndressed = {topic = "/user", field = "undressed"}
[measures]
battery = {topic = "/battery_state", field = "percentage", scale = 100}
[events]
LowBattery = {topic = "/battery_state", field = "percentage", below = 0.2}
[obligations]
Dock = {action = "/dock", goal = "succeeded"}
[topics]
"/battery_state" = {type = "sensor_msgs/msg/BatteryState", reliable = false}
"""

from __future__ import annotations

import sys
from collections.abc import Collection, Iterator, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.audit.message_field import FieldPath
from sleec_runtime.audit.source import GOAL_STATES, Source, SourceKind
from sleec_runtime.audit.vocabulary import Vocabulary
from sleec_runtime.errors import MappingError
from sleec_runtime.model import LONGEST, Rational, Ruleset, exact
from sleec_runtime.support.files import read_file
from sleec_runtime.support.messages import listed, represent
from sleec_runtime.support.suggestions import nearest

if TYPE_CHECKING:
    from pathlib import Path

TABLES: Mapping[str, SourceKind] = {
    "conditions": "condition",
    "measures": "measure",
    "events": "event",
    "obligations": "obligation",
}
_COMPARISON = ("scale", "offset", "above", "below", "until", "equals")
_KEYS: Mapping[SourceKind, tuple[str, ...]] = {
    "domain": ("topic", "field", "values"),
    "condition": ("topic", "field", *_COMPARISON),
    "measure": ("topic", "field", "scale", "offset", "values"),
    "event": ("topic", "field", *_COMPARISON, "each", "action", "goal"),
    "obligation": ("topic", "field", *_COMPARISON, "each", "action", "goal"),
}


class LiveTopic(NamedTuple):
    """The ROS type of a topic, for monitors and recorders. Publishers of a topic that is not `reliable` may lose
    messages (best effort)."""

    type: str
    reliable: bool = True


class MappingFile(NamedTuple):
    """The content of a file: the sources, the tolerance in seconds if it has one, the topics by name, and the
    definitions of message types by type, as in `.msg` files."""

    sources: tuple[Source, ...]
    tolerance: Rational | None
    topics: Mapping[str, LiveTopic]
    definitions: Mapping[str, str]


NO_MAPPING = MappingFile((), None, {}, {})
"""The mapping of a robot that only has our nodes."""


def read_mapping(path: str | Path, ruleset: Ruleset, chains: bool = True) -> MappingFile:
    """The mapping in a file, for a ruleset. `chains` is that of the audit.

    Raises MappingError if the file cannot be read, is not a mapping, or does not fit the ruleset.
    """
    try:
        text = read_file(path).decode("utf-8-sig")
    except FileNotFoundError:
        raise MappingError(f"file {path} does not exist", "check its name and folder") from None
    except OSError as problem:
        raise MappingError(f"{path} cannot be read: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise MappingError(f"{path} is not UTF-8", "save it as UTF-8") from None
    return parse_mapping(text, str(path), ruleset, chains)


def parse_mapping(text: str, path: str, ruleset: Ruleset, chains: bool = True) -> MappingFile:
    """The mapping in a text, which messages call `path`. Raises MappingError."""
    from decimal import Decimal

    try:
        toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    except ImportError:
        raise MappingError("reading a mapping needs the package tomli", "pip install tomli") from None
    try:
        table: dict[str, Any] = toml.loads(text, parse_float=Decimal)
    except (ValueError, RecursionError, ArithmeticError) as problem:
        raise MappingError(f"{path} is not TOML: {problem}") from None
    return _Reader(path, ruleset, chains).mapping(table)


class _Reader:
    def __init__(self, path: str, ruleset: Ruleset, chains: bool) -> None:
        self.path = path
        self.ruleset = ruleset
        names = Vocabulary(ruleset, chains)
        self.names: Mapping[SourceKind, Collection[str]] = {
            "condition": ruleset.conditions,
            "measure": ruleset.measures,
            "event": names.events,
            "obligation": names.obligations,
        }

    def mapping(self, table: dict[str, Any]) -> MappingFile:
        known = ("tolerance", "domain", *TABLES, "topics", "definitions")
        for key in table:
            if key not in known:
                raise self._error("", f"unknown key {represent(key)}", _near(key, known))
        tolerance = exact(table.get("tolerance", 0))
        if tolerance is None or not 0 <= tolerance <= LONGEST:
            problem = f"it is {represent(table['tolerance'])}, not a number of seconds from 0 to {LONGEST:,}"
            raise self._error("tolerance", problem)
        topics = dict(self._topics(table.get("topics", {})))
        definitions = self._definitions(table.get("definitions", {}))
        sources = tuple(self._sources(table))
        return MappingFile(sources, tolerance if "tolerance" in table else None, topics, definitions)

    def _definitions(self, table: object) -> dict[str, str]:
        if not isinstance(table, dict):
            raise self._error("definitions", "it is not a table", "begin the table with [definitions]")
        return {name: self._text(f"[definitions] {name}", table, name) for name in table}

    def _topics(self, table: object) -> Iterator[tuple[str, LiveTopic]]:
        if not isinstance(table, dict):
            raise self._error("topics", "it is not a table", "begin the table with [topics]")
        for name, entry in table.items():
            where = f"[topics] {name}"
            if not isinstance(entry, dict):
                raise self._error(where, f"it is {represent(entry)}, not a table", 'write {type = "std_msgs/msg/Bool"}')
            for key in entry:
                if key not in LiveTopic._fields:
                    raise self._error(where, f"unknown key `{key}`", _near(key, LiveTopic._fields))
            reliable = entry.get("reliable", True)
            if not isinstance(reliable, bool):
                raise self._error(where, f"`reliable` is {represent(reliable)}, not true or false")
            yield name, LiveTopic(self._text(where, entry, "type"), reliable)

    def _sources(self, table: dict[str, Any]) -> Iterator[Source]:
        if "domain" in table:
            yield self._source("domain", "domain", "domain", table["domain"])
        for title, kind in TABLES.items():
            entries = table.get(title, {})
            if not isinstance(entries, dict):
                raise self._error(title, "it is not a table", f"begin the table with [{title}]")
            for name, entry in entries.items():
                where = f"[{title}] {name}"
                self._check_name(where, kind, name)
                for one in entry if isinstance(entry, list) else [entry]:
                    yield self._source(where, kind, name, one)

    def _check_name(self, where: str, kind: SourceKind, name: str) -> None:
        if name in self.names[kind]:
            return
        for title, other in TABLES.items():
            if name in self.names[other]:
                article = "an" if other in ("event", "obligation") else "a"
                raise self._error(where, f"`{name}` is {article} {other}", f"move it to [{title}]")
        raise self._error(where, f"the ruleset has no {kind} `{name}`", _near(name, sorted(self.names[kind])))

    def _source(self, where: str, kind: SourceKind, name: str, entry: object) -> Source:
        if not isinstance(entry, dict):
            raise self._error(
                where, f"it is {represent(entry)}, not a table", 'write {topic = "/topic", field = "data"}'
            )
        for key in entry:
            if key not in _KEYS[kind]:
                raise self._error(where, f"unknown key `{key}`", _near(key, _KEYS[kind]))
        if "action" in entry or "goal" in entry:
            return self._action(where, kind, name, entry)
        topic = self._text(where, entry, "topic")
        if "field" not in entry and (kind not in ("event", "obligation") or set(entry) & set(_COMPARISON)):
            raise self._error(
                where, "the key `field` is missing", 'give the field with the value, such as field = "data"'
            )
        path = self._field(where, self._text(where, entry, "field")) if "field" in entry else None
        numbers = {key: self._number(where, entry, key) for key in ("scale", "offset", "above", "below", "until")}
        each = entry.get("each", "equals" in entry)
        if not isinstance(each, bool):
            raise self._error(where, f"`each` is {represent(each)}, not true or false")
        source = Source(
            where,
            kind,
            name,
            topic,
            path,
            1 if numbers["scale"] is None else numbers["scale"],
            numbers["offset"] or 0,
            numbers["above"],
            numbers["below"],
            numbers["until"],
            self._plain(where, entry, "equals"),
            self._values(where, kind, name, entry),
            each,
        )
        self._check_comparison(source)
        return source

    def _action(self, where: str, kind: SourceKind, name: str, entry: Mapping[str, Any]) -> Source:
        action, goal = self._text(where, entry, "action"), self._text(where, entry, "goal")
        if set(entry) != {"action", "goal"}:
            others = listed(sorted(f"`{key}`" for key in set(entry) - {"action", "goal"}))
            raise self._error(where, f"`action` and `goal` exclude {others}")
        for state in GOAL_STATES:
            if goal == state:
                topic = f"{action}/_action/status"
                return Source(where, kind, name, topic, FieldPath("status_list"), goal=state)
        raise self._error(where, f"the state of a goal is {listed(GOAL_STATES)}; got {represent(goal)}")

    def _check_comparison(self, source: Source) -> None:
        where, above, below, until = source.where, source.above, source.below, source.until
        if (source.scale, source.offset) != (1, 0) and above is None and below is None:
            if source.kind != "measure":
                raise self._error(where, "`scale` and `offset` need `above` or `below`", "`equals` compares the field")
            if source.values:
                raise self._error(where, "`values` excludes `scale` and `offset`", "`values` names values of the field")
        if sum(one is not None for one in (above, below, source.equals)) > 1:
            raise self._error(where, "`above`, `below` and `equals` exclude each other", "give one of them")
        if until is not None:
            bound = above if above is not None else below
            if bound is None:
                raise self._error(where, "`until` needs `above` or `below`")
            if until > bound if above is not None else until < bound:
                side = "at most `above`" if above is not None else "at least `below`"
                raise self._error(where, f"`until` is {side}, because the comparison stays true up to it")

    def _values(self, where: str, kind: SourceKind, name: str, entry: Mapping[str, Any]) -> dict[str, object]:
        if "values" not in entry:
            return {}
        values = entry["values"]
        if not isinstance(values, dict) or not values:
            raise self._error(where, "`values` is not a table", "write values = {low = 0, high = 1}")
        measure = self.ruleset.measures.get(name)
        if kind == "measure" and (measure is None or measure.kind != "scale"):
            raise self._error(where, f"`values` names values of a scale, and `{name}` is a number", "use `scale`")
        known = self.ruleset.domains if kind == "domain" else () if measure is None else measure.values
        for one in values:
            if one not in known:
                what = "the ruleset has no domain" if kind == "domain" else f"the scale of `{name}` has no value"
                raise self._error(where, f"{what} `{one}`", _near(one, known))
        plain = {one: self._plain(where, values, one) for one in values}
        names: dict[tuple[bool, object], str] = {}
        for one, value in plain.items():
            # In Python, True equals 1.
            other = names.setdefault((isinstance(value, bool), exact(value) or value), one)
            if other != one:
                raise self._error(where, f"`values` gives {represent(value)} two names: `{other}` and `{one}`")
        return plain

    def _plain(self, where: str, entry: Mapping[str, Any], key: str) -> object:
        value = entry.get(key)
        if value is not None and not isinstance(value, (bool, str)) and exact(value) is None:
            raise self._error(where, f"`{key}` is {represent(value)}, not true, false, a number or a text")
        return value

    def _number(self, where: str, entry: Mapping[str, Any], key: str) -> Rational | None:
        if key not in entry:
            return None
        number = exact(entry[key])
        if number is None:
            raise self._error(where, f"`{key}` is {represent(entry[key])}, not a number")
        return number

    def _text(self, where: str, entry: Mapping[str, Any], key: str) -> str:
        value = entry.get(key)
        if not isinstance(value, str) or not value:
            problem = (
                f"the key `{key}` is missing" if key not in entry else f"`{key}` is {represent(value)}, not a text"
            )
            raise self._error(where, problem)
        return value

    def _field(self, where: str, text: str) -> FieldPath:
        try:
            return FieldPath(text)
        except ValueError:
            hint = "write names with dots, and [0] for an item of a list, such as status_list[0].status"
            raise self._error(where, f"`{text}` is not the path of a field", hint) from None

    def _error(self, where: str, problem: str, hint: str | None = None) -> MappingError:
        return MappingError(f"{self.path}: {where}: {problem}" if where else f"{self.path}: {problem}", hint)


def _near(name: str, known: Collection[str]) -> str:
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else f"known: {listed(known)}" if known else "it has none"
