"""Pages of the site whose files are outside docs/: the rulesets, the changelog, and pages for contributors."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
AS_THEY_ARE = {"CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md", "SECURITY.md": "security.md"}
WITH_RULESETS = {"rulesets": "rulesets.md", "rulesets/studies": "studies.md"}
PAGES = {**AS_THEY_ARE, **{f"{folder}/README.md": page for folder, page in WITH_RULESETS.items()}}
"""The address of each page by its file."""


def pages() -> dict[str, str]:
    """The text of each page by its address in the site."""
    same = {page: (ROOT / file).read_text(encoding="utf-8") for file, page in AS_THEY_ARE.items()}
    return {**{page: _with_rulesets(ROOT / folder) for folder, page in WITH_RULESETS.items()}, **same}


def _with_rulesets(folder: Path) -> str:
    """The README of a folder, followed by every ruleset that it names."""
    text = (folder / "README.md").read_text(encoding="utf-8")
    names = re.findall(r"\]\(([\w.-]+\.sleec)\)", text)
    page = re.sub(r"\]\(([\w-]+)\.sleec\)", r"](#\1)", text)
    return page + "".join(_section(folder / name) for name in names)


def _section(path: Path) -> str:
    text = path.read_text(encoding="utf-8").strip()
    language = "dsl" if "def_start\n" in text else "sleec"
    return f'\n## {path.name} {{ #{path.stem} }}\n\n```{language} title="{path.name}"\n{text}\n```\n'
