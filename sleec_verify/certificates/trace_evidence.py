"""The files of a certificate with evidence about traces: `traces.json` and `templates.json`.

Each is JSON in ASCII, with a line for each entry, so that there is one way to write it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING, Protocol

from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.traces import replay_example, replay_found
from sleec_verify.results.conflict_freedom import Example, FreeComponent, LaterInstant, UsedTemplate
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.results.json_values import Json, values_json
from sleec_verify.wording.phrases import listed, quoted

if TYPE_CHECKING:
    from sleec_runtime.model import Value
    from sleec_verify.replay.trace_evaluator import TraceEvaluator

TRACES, TEMPLATES = "traces.json", "templates.json"
"""The names of the files."""


class Entry(Protocol):
    """An entry of a file. Its text names it in messages."""

    def json(self) -> dict[str, Json]:
        """The entry as JSON."""
        ...

    @property
    def traces(self) -> int:
        """The number of its traces."""
        ...

    def confirmed(self, evaluator: TraceEvaluator) -> bool:
        """Whether an evaluator confirms all of its traces."""
        ...


@dataclass(frozen=True)
class CheckTrace:
    """A trace that a check found, the domain of its rules (empty: all rules), and their index."""

    check: str
    domain: str
    index: RulesetIndex
    found: FoundTrace

    def json(self) -> dict[str, Json]:
        about: list[Json] = [{"name": name, "clause": clause} for name, clause in self.found.about]
        entry: dict[str, Json] = {"check": self.check, "domain": self.domain, "shows": self.found.shows, "about": about}
        if self.found.shows == "response":
            entry["complies"] = [rule.label for rule in self.found.rules]
            entry["inputs"] = [*sorted(self.found.inputs)]
        return {**entry, "now": self.found.now, "instants": _instants(self.found.instants)}

    @property
    def traces(self) -> int:
        return 1

    def confirmed(self, evaluator: TraceEvaluator) -> bool:
        return replay_found(self.index, self.found, evaluator)

    def __str__(self) -> str:
        names = dict.fromkeys(name for name, _ in self.found.about)
        domain = f" in {quoted(self.domain)}" if self.domain else ""
        return f"the {self.found.shows} of {listed(map(quoted, names))}{domain} ({self.check})"


@dataclass(frozen=True)
class CheckTemplates:
    """The templates for rules that are in no conflict, the domain of the rules, and their index."""

    check: str
    domain: str
    index: RulesetIndex
    found: FreeComponent

    def json(self) -> dict[str, Json]:
        templates: list[Json] = [_template(one) for one in self.found.templates]
        entry: dict[str, Json] = {"check": self.check, "domain": self.domain, "rules": list(self.found.labels)}
        return {**entry, "templates": templates}

    @property
    def traces(self) -> int:
        return sum(one.example is not None for one in self.found.templates)

    def confirmed(self, evaluator: TraceEvaluator) -> bool:
        examples = (one.example for one in self.found.templates)
        return all(replay_example(self.index, one, evaluator) for one in examples if one is not None)

    def __str__(self) -> str:
        domain = f" in {quoted(self.domain)}" if self.domain else ""
        return f"the templates of {listed(map(quoted, self.found.labels))}{domain} ({self.check})"


def _template(template: UsedTemplate) -> Json:
    policies: list[Json] = [
        {"of": response, "later": [_later(one) for one in plan]} for response, plan in template.policies
    ]
    later: list[Json] = [_later(one) for one in template.later]
    example = None if template.example is None else _example(template.example)
    return {"acts": list(template.acts), "later": later, "policies": policies, "example": example}


def _later(one: LaterInstant) -> Json:
    return {"after": one.after, "seconds": one.seconds, **_instant(one.events, one.conditions)}


def _example(example: Example) -> Json:
    rules: list[Json] = [rule.label for rule in example.rules]
    return {"rules": rules, "now": example.now, "instants": _instants(example.instants)}


def _instants(instants: Sequence[tuple[int, frozenset[str], Mapping[str, Value]]]) -> list[Json]:
    return [{"time": time, **_instant(events, conditions)} for time, events, conditions in instants]


def _instant(events: frozenset[str], conditions: Mapping[str, Value]) -> dict[str, Json]:
    return {"events": [*sorted(events)], "conditions": values_json(conditions)}


def file_text(entries: Sequence[Entry]) -> str:
    """The text of a file with these entries."""
    return "[\n" + ",\n".join(map(_line, entries)) + "\n]\n"


def _line(entry: Entry) -> str:
    return json.dumps(entry.json())


def changed_entries(name: str, data: bytes, entries: Sequence[Entry]) -> Iterator[str]:
    """The first difference between the content of a file and the entries that are found now."""
    if data == file_text(entries).encode():
        return
    rows = data.decode("ascii", "replace").removeprefix("[\n").removesuffix("\n]\n").split(",\n")
    for row, entry in zip_longest(rows, entries):
        if entry is None:
            yield f"{name} has more entries than the checks"
            return
        if row != _line(entry):
            yield f"{name} does not show {entry}"
            return
    yield f"{name} is not what certify writes"
