"""``python -m tests.fuzz.replay TARGET FILE …``: run inputs once, without the fuzzer. Exits with a traceback or 0."""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.fuzz.targets import TARGETS, run


def replay(name: str, path: Path) -> None:
    """Raises what shows that the property of the target does not hold of the input."""
    with TemporaryDirectory() as folder:
        run(TARGETS[name], path.read_bytes(), Path(folder))


if __name__ == "__main__":
    for argument in sys.argv[2:]:
        replay(sys.argv[1], Path(argument))
