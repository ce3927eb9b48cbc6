"""The results as files: CSV for each measurement, and one report in Markdown."""

from __future__ import annotations

import csv
import os
import platform
from collections.abc import Iterable, Sequence
from pathlib import Path


class Output:
    """A folder of results. `report` is the text of `report.md`."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.folder.mkdir(parents=True, exist_ok=True)
        self.report: list[str] = [f"# The evaluation of the paper, repeated\n\n{machine()}\n"]

    def csv(self, name: str, heading: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
        """Writes a file of comma-separated values."""
        with (self.folder / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(heading)
            writer.writerows(rows)

    def section(self, heading: str) -> None:
        """Starts a section of the report."""
        self.report.append(f"\n## {heading}\n")
        print(f"== {heading}", flush=True)

    def table(self, heading: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
        """Adds a table to the report."""
        lines = [heading, ["---"] * len(heading), *rows]
        text = "\n".join("| " + " | ".join(_cell(cell) for cell in line) + " |" for line in lines)
        self.report.append(f"{text}\n")
        print(text, flush=True)

    def text(self, text: str) -> None:
        """Adds a paragraph to the report."""
        self.report.append(f"{text}\n")
        print(text, flush=True)

    def image(self, name: str, what: str) -> Path:
        """Adds an image to the report. Returns its path."""
        self.report.append(f"![{what}]({name}.svg)\n")
        return self.folder / f"{name}.svg"

    def close(self) -> None:
        """Writes the report."""
        (self.folder / "report.md").write_text("\n".join(self.report), encoding="utf-8")


def machine() -> str:
    """What the figures are from."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"Machine: {platform.machine()}, {cores} cores, {platform.system()}, Python {platform.python_version()}."


def _cell(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 0.1 else f"{value:.3f}"
    return str(value)
