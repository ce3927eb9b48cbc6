"""The configuration of a team: ``sleec-verify.toml``, or ``[tool.sleec-verify]`` of pyproject.toml."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_verify.changes.gate.keys import ConfigError, Policy, Target, joined, settings
from sleec_verify.files.toml import parse_toml

if TYPE_CHECKING:
    from sleec_verify.changes.revisions.single_file import Tree

OWN = "sleec-verify.toml"
SHARED = "pyproject.toml"
TABLE = "sleec-verify"


class Config(NamedTuple):
    """All settings. `path` is their file, None if there is none. `folder` is the folder to which their paths are
    relative. Both are relative to the top of the repository."""

    path: str | None = None
    folder: str = "."
    rulesets: tuple[str, ...] = (".",)
    base: str | None = None
    baseline: str | None = None
    assertions: tuple[str, ...] = ()
    targets: tuple[Target, ...] = ()
    block: Policy = Policy()

    def at(self, path: str) -> str:
        """A path of the configuration, relative to the top of the repository."""
        return joined(self.folder, path)


def find_config(tree: Tree, folder: str) -> Config:
    """The settings of the nearest folder with a configuration, from `folder` up to the top of the repository; otherwise
    the defaults.

    Raises:
        SleecError: the configuration is invalid.
    """
    here = folder
    while True:
        for name in (OWN, SHARED):
            path = joined(here, name)
            data = tree.read(path)
            if data is not None and (name == OWN or _has_table(data, tree.called(path))):
                return read_config(data, path, tree.called(path))
        if here == ".":
            return Config(folder=folder)
        here = posixpath.dirname(here) or "."


def read_config(data: bytes, path: str, called: str) -> Config:
    """The settings of the file at `path`, which messages call `called`. Raises `ConfigError`."""
    table: object = _table(data, called)
    where = ""
    if posixpath.basename(path) == SHARED:
        where = f"[tool.{TABLE}] "
        for key in ("tool", TABLE):
            table = table.get(key) if isinstance(table, dict) else None
        if table is None:
            raise ConfigError(f"{called} has no [tool.{TABLE}] table", f"add the table, or use a {OWN}")
    folder = posixpath.dirname(path) or "."
    return Config(path=path, folder=folder, **settings(table, called, where, folder))


def _has_table(data: bytes, called: str) -> bool:
    tool = _table(data, called).get("tool", {})
    return isinstance(tool, dict) and TABLE in tool


def _table(data: bytes, called: str) -> dict[str, Any]:
    return parse_toml(data, called, ConfigError)
