"""Links from docs/ to other files of the project: the site has other addresses for these."""

from __future__ import annotations

import re
from posixpath import dirname, join, normpath, relpath

from website import copied

_LINK = re.compile(r"\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s#:]+)(#[\w-]+)?\)")
_PAGES = {**copied.PAGES, "README.md": "index.md"}
_SOURCES = {page: file for file, page in copied.PAGES.items()}


def within_the_site(markdown: str, page: str) -> str:
    """The text of `page` (its address in the site) with links to pages of the site. A link to a file without a page
    becomes plain text. A link whose text is a file name gets the title of the page as its text."""

    folder = dirname(_SOURCES.get(page, f"docs/{page}"))

    def changed(link: re.Match[str]) -> str:
        words, path, anchor = link.groups()
        target = normpath(join(folder, path))
        if target.startswith("docs/"):
            address = target.removeprefix("docs/")
            words = _title(target) if words == path else words
        elif target in _PAGES:
            address = _PAGES[target]
        else:
            return str(words)
        return f"[{words}]({relpath(address, dirname(page) or '.')}{anchor or ''})"

    return _LINK.sub(changed, markdown)


def _title(page: str) -> str:
    """The title of a page. Readers of the site do not see file names."""
    first, _, _ = (copied.ROOT / page).read_text(encoding="utf-8").partition("\n")
    return first.removeprefix("# ")
