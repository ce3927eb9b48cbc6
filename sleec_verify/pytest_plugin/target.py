"""The robot of ``--sleec-target``: its factory, imported from a module or a file."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from pathlib import Path
from types import ModuleType

from sleec_runtime.errors import SleecError
from sleec_verify.conformance.subject import Bench, Factory, NotASubject, Subject


class TargetError(SleecError):
    """A target that cannot be imported, or does not create a testable object."""


def load_target(target: str, folder: Path) -> Factory:
    """The factory ``module:attribute`` or ``file.py:attribute``, called once to check that it creates a testable
    object.

    Modules and files are also searched in `folder`. Raises `TargetError`.
    """
    where, colon, attribute = target.rpartition(":")
    if not colon or not where or not attribute:
        raise TargetError(f"the target {target!r} is invalid", "write module:function, or file.py:function")
    try:
        found: object = _module(where, folder)
        for name in attribute.split("."):
            found = getattr(found, name)
    except TargetError:
        raise
    except Exception as error:  # noqa: BLE001 - a robot's module may raise anything
        raise TargetError(f"the target {target} cannot be imported: {type(error).__name__}: {error}") from None
    if not callable(found):
        hint = (
            "name the function that returns it"
            if isinstance(found, Subject)
            else "name a function that returns a Sleec"
        )
        raise TargetError(f"the target {target} is a {type(found).__name__}, not a function", hint)
    try:
        Bench(found).subject()
    except NotASubject as error:
        raise TargetError(f"the target {target}: {error.message}", error.hint) from None
    except Exception as error:  # noqa: BLE001
        raise TargetError(f"the target {target} raised {type(error).__name__}: {error}") from None
    return found


def _module(where: str, folder: Path) -> ModuleType:
    if not where.endswith(".py"):
        sys.path.insert(0, str(folder))
        try:
            return importlib.import_module(where)
        finally:
            sys.path.remove(str(folder))
    path = folder / where
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if not path.is_file() or spec is None or spec.loader is None:
        raise TargetError(f"file {path} does not exist", "use a path relative to the folder in which pytest runs")
    module = importlib.util.module_from_spec(spec)
    # Classes of the module, such as dataclasses, look it up there.
    sys.modules.setdefault(path.stem, module)
    spec.loader.exec_module(module)
    return module
