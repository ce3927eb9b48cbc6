"""Entries of a cache."""

from __future__ import annotations

from pathlib import Path

CLASH = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
TIMED = "WHEN Rung THEN Open WITHIN 5 minutes\nWHEN Rung AND Pain > 0.5 THEN NOT Open WITHIN 10 minutes\n"


def entries(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.name != ".gitignore")
