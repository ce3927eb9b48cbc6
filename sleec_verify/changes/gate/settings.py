"""The settings of one side of a change: the configuration, the baseline, and files of assertions."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import NamedTuple

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.language.common.source import decode_source
from sleec_runtime.model import Source
from sleec_runtime.support.files import read_file
from sleec_verify.changes.gate.baseline import Key, read_baseline
from sleec_verify.changes.gate.config import Config, find_config, read_config
from sleec_verify.changes.gate.keys import ConfigError, is_assertion
from sleec_verify.changes.revisions.single_file import Tree


class Settings(NamedTuple):
    """`known` are the findings of the baseline at the path `baseline`. `assertions` are the files of assertions by
    their paths."""

    config: Config
    baseline: str | None
    known: frozenset[Key]
    assertions: Mapping[str, Source]


class GateSettings(NamedTuple):
    """The settings of the base, by which a change is judged; of the start of the change; and of the change."""

    base: Settings
    start: Settings
    change: Settings


def read_sides(base: Tree, start: Tree | None, now: Tree, file: str | None, baseline: str | None) -> GateSettings:
    """The settings of the trees. If `start` is None, the change starts at the base. `file` and `baseline` are from the
    command line, in place of the nearest configuration and its baseline.

    Raises:
        SleecError: a file is invalid, or neither the base nor the change has it.
    """
    configs = [config_of(tree, file) for tree in (base, now)]
    if configs == [None, None]:
        raise no_config(file or "")
    default = Config(folder=now.repository.position(os.curdir) or os.curdir)
    decides = _read(base, now, configs[0] or default, baseline)
    before = decides if start is None else _read(start, now, config_of(start, file) or default, baseline)
    return GateSettings(decides, before, _read(now, base, configs[1] or default, baseline))


def config_of(tree: Tree, file: str | None) -> Config | None:
    """The configuration: `file` from the command line, or the nearest one. None if the file is not on this side. A file
    outside the repository is the same on every side, and its paths are relative to the top of the repository.

    Raises:
        SleecError: it is invalid.
    """
    if file is None:
        return find_config(tree, tree.repository.position(os.curdir) or os.curdir)
    found = _named(tree, file)
    return None if found.data is None else read_config(found.data, found.path, found.called)


def no_config(file: str) -> ConfigError:
    """The error if neither side has the configuration."""
    return ConfigError(f"file {file} does not exist", "check its name and folder")


def no_baseline(file: str) -> ConfigError:
    """The error if neither side has the baseline."""
    return ConfigError(f"baseline {file} does not exist", "write it: sleec-verify gate --write-baseline …")


class _File(NamedTuple):
    """A file: its path in the repository, its name in messages, and its content, if any."""

    path: str
    called: str
    data: bytes | None


def _read(tree: Tree, other: Tree, config: Config, baseline: str | None) -> Settings:
    """The files that `config` names, on its side. A file that only the `other` side has is empty here."""
    path, known = None, frozenset[Key]()
    if baseline is not None or config.baseline is not None:
        found, elsewhere = (
            _named(one, baseline) if baseline is not None else _at(one, config.at(config.baseline or ""))
            for one in (tree, other)
        )
        if found.data is None and elsewhere.data is None:
            raise no_baseline(baseline or found.called)
        path = found.path
        known = frozenset() if found.data is None else read_baseline(found.data, found.called)
    assertions = {}
    for entry in config.assertions:
        if not is_assertion(entry):
            found, elsewhere = (_at(one, config.at(entry)) for one in (tree, other))
            if found.data is None and elsewhere.data is None:
                raise UnreadableFile(f"file {found.called} does not exist", "check its name and folder")
            if found.data is not None:
                assertions[found.path] = decode_source(found.called, found.data)
    return Settings(config, path, known, assertions)


def _at(tree: Tree, path: str) -> _File:
    return _File(path, tree.called(path), tree.read(path))


def _named(tree: Tree, file: str) -> _File:
    """A file from the command line."""
    path = tree.repository.position(file)
    if path is not None:
        return _at(tree, path)
    try:
        data = read_file(file)
    except FileNotFoundError:
        data = None
    except OSError as error:
        raise SleecError(f"{file} cannot be read: {error.strerror}") from None
    return _File(os.path.basename(file), file, data)
