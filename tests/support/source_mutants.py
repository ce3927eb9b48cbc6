"""Mutants of the project's own functions: a function with one text of its source replaced."""

from __future__ import annotations

import ast
import inspect
import types
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import pytest


@dataclass(frozen=True)
class SourceMutant:
    """The function or method `function` of a module, with the text `before`, which it has once, replaced by `after`."""

    module: str
    function: str
    before: str
    after: str

    def __str__(self) -> str:
        """An identifier of a test."""
        return f"{self.module.rpartition('.')[2]}.{self.function}: {self.before} -> {self.after}".replace("\n", " ")

    def apply(self, patch: pytest.MonkeyPatch) -> None:
        """Replaces the code of the function until `patch` is undone, for all modules that have imported it."""
        module = import_module(self.module)
        function: Any = module
        for name in self.function.split("."):
            function = inspect.getattr_static(function, name)
        lines, start = inspect.getsourcelines(function)
        own = "".join(lines)
        assert own.count(self.before) == 1, f"{self.function} does not have this text once: {self.before}"
        whole = inspect.getsource(module).splitlines(keepends=True)
        changed = own.replace(self.before, self.after)
        text = "".join([*whole[: start - 1], changed, *whole[start - 1 + len(lines) :]])
        ast.parse(text)
        code = compile(text, module.__file__ or "", "exec", dont_inherit=True)
        for name in self.function.split("."):
            code = next(one for one in code.co_consts if isinstance(one, types.CodeType) and one.co_name == name)
        patch.setattr(function, "__code__", code)
