"""Pages of the site that stand elsewhere in the project: the rulesets, the changelog, and those for contributors."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
AS_THEY_ARE = {"CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md", "SECURITY.md": "security.md"}
PAGES = {**AS_THEY_ARE, "rulesets/README.md": "rulesets.md"}
"""The pages by the files whose text they have."""


def pages() -> dict[str, str]:
    """The pages by their paths in the site."""
    same = {page: (ROOT / file).read_text(encoding="utf-8") for file, page in AS_THEY_ARE.items()}
    return {"rulesets.md": _rulesets(), **same}


def _rulesets() -> str:
    """The table of rulesets/README.md, and below it every file that it names."""
    folder = ROOT / "rulesets"
    text = (folder / "README.md").read_text(encoding="utf-8")
    names = re.findall(r"\]\(([\w.-]+\.sleec)\)", text)
    page = re.sub(r"\]\(([\w-]+)\.sleec\)", r"](#\1)", text)
    parts = (
        f'\n## {name} {{ #{Path(name).stem} }}\n\n```sleec title="{name}"\n'
        f"{(folder / name).read_text(encoding='utf-8').strip()}\n```\n"
        for name in names
    )
    return page + "".join(parts)
