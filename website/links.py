"""Links that lead out of docs/: they work where the project is read as files, and the site has other addresses."""

from __future__ import annotations

import re
from posixpath import dirname, join, normpath, relpath

from website import copied

_LINK = re.compile(r"\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s#:]+)(#[\w-]+)?\)")
_PAGES = {**copied.PAGES, "README.md": "index.md"}
_SOURCES = {page: file for file, page in copied.PAGES.items()}


def within_the_site(markdown: str, page: str) -> str:
    """The text of `page`, an address in the site, where such a link leads to the page that has the same, or is plain
    text if there is none. A link to a page by the name of its file says the title instead."""

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
    """What a page calls itself: on the site, the name of its file means nothing to anybody."""
    first, _, _ = (copied.ROOT / page).read_text(encoding="utf-8").partition("\n")
    return first.removeprefix("# ")
