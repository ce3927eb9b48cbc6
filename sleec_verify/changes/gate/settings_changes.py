"""The changes to the settings of the gate."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from sleec_runtime.model import NOWHERE, Source
from sleec_verify.changes.gate.baseline import Key
from sleec_verify.changes.gate.config import Config
from sleec_verify.changes.gate.keys import is_assertion
from sleec_verify.changes.gate.result import POLICY_CHANGES, Block
from sleec_verify.changes.gate.settings import Settings
from sleec_verify.changes.revisions.single_file import Tree
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import counted, listed

_MOST = 5
"""The maximal number of listed entries of a file."""


def policy_changes(tree: Tree, old: Settings, new: Settings) -> list[Block]:
    """Each changed key of the configuration, and each changed file that it names. `tree` is the current one."""
    return [_block(tree, where, what) for where, what in _changes(old, new)]


def _block(tree: Tree, where: str, what: str) -> Block:
    source = Source(tree.called(where), "")
    finding = Finding(POLICY_CHANGES, POLICY_CHANGES, "error", what, NOWHERE, source=source)
    return Block(POLICY_CHANGES, where, what, finding)


def _changes(old: Settings, new: Settings) -> Iterator[tuple[str, str]]:
    before, after = _keys(old.config), _keys(new.config)
    for key in before:
        if before[key] != after[key]:
            where = new.config.path or old.config.path
            assert where is not None, "without this file, all keys have their default values"
            yield where, f"{key} changes from {_shown(before[key])} to {_shown(after[key])}"
    where = new.baseline or old.baseline
    if where is not None and old.known != new.known:
        yield where, "; ".join(_moves("finding", [*map(_called, old.known)], [*map(_called, new.known)]))
    for where in sorted({*old.assertions, *new.assertions}):
        said = [_lines(one.assertions.get(where)) for one in (old, new)]
        if said[0] != said[1]:
            yield where, "; ".join(_moves("assertion", *said)) or "the order of the assertions changes"


def _keys(config: Config) -> Mapping[str, Any]:
    """The settings by their keys, with paths relative to the top of the repository."""
    keys: dict[str, Any] = {
        "rulesets": [*map(config.at, config.rulesets)],
        "base": config.base,
        "baseline": None if config.baseline is None else config.at(config.baseline),
        "assertions": [one if is_assertion(one) else config.at(one) for one in config.assertions],
        "targets": [[one.at(one.code), one.at(one.rules), one.domain] for one in config.targets],
    }
    return keys | {f"block.{name.replace('_', '-')}": value for name, value in config.block._asdict().items()}


def _shown(value: object) -> str:
    import json

    return "unset" if value is None else json.dumps(value, ensure_ascii=False)


def _called(one: Key) -> str:
    path, code, rules, *_ = one
    return f"{code} of {listed(rules)} in {path}" if rules else f"{code} in {path}"


def _lines(source: Source | None) -> list[str]:
    lines = [] if source is None else source.text.splitlines()
    return [said for said in (" ".join(line.partition("#")[0].split()) for line in lines) if said]


def _moves(noun: str, old: Collection[str], new: Collection[str]) -> Iterator[str]:
    """Added and removed entries, in words."""
    from collections import Counter

    for word, more in (("added", Counter(new) - Counter(old)), ("removed", Counter(old) - Counter(new))):
        if more:
            some = [*sorted(more.elements())[:_MOST], *(["…"] if more.total() > _MOST else [])]
            yield f"{counted(more.total(), noun)} {word}: {', '.join(some)}"
