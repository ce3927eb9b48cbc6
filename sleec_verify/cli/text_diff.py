"""The changes of a text as a unified diff."""

from __future__ import annotations

from difflib import unified_diff
from io import StringIO

from sleec_verify.cli.output import write_data
from sleec_verify.report.escape import as_line


def show_diff(path: str, before: str, after: str) -> None:
    """Write the unified diff of two texts of the file at `path` to standard output. Equal texts have none."""
    name = as_line(path)
    old, new = (StringIO(text).readlines() for text in (before, after))
    for line in unified_diff(old, new, name, name):
        write_data((line if line.endswith("\n") else line + "\n\\ No newline at end of file\n",))
