"""Run measurements: ``python -m benchmarks [NAME…]``, by default all modules of this package that have a `main`."""

from __future__ import annotations

import importlib
import pkgutil
import sys
from collections.abc import Callable

import benchmarks


def measurements() -> dict[str, Callable[[], object]]:
    found = {}
    for module in pkgutil.iter_modules(benchmarks.__path__):
        if module.name != "__main__":
            measure = getattr(importlib.import_module(f"benchmarks.{module.name}"), "main", None)
            if measure is not None:
                found[module.name] = measure
    return found


def main() -> None:
    known = measurements()
    chosen = sys.argv[1:] or sorted(known)
    unknown = set(chosen) - set(known)
    if unknown:
        sys.exit(f"no such benchmark: {', '.join(sorted(unknown))}; there are {', '.join(sorted(known))}")
    for name in chosen:
        print(f"== {name}", flush=True)
        known[name]()


if __name__ == "__main__":
    main()
