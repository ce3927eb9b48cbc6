"""Links that lead out of docs/: they work where the project is read as files, and the site has other addresses."""

from __future__ import annotations

import re
from posixpath import dirname, join, normpath, relpath

from website import copied

_LINK = re.compile(r"\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s#:]+)(#[\w-]+)?\)")
_PAGES = {**copied.PAGES, "README.md": "index.md"}


def within_the_site(markdown: str, page: str) -> str:
    """The text of `page`, a path below docs/, where such a link leads to the page that has the same, or is plain text
    if there is none. A link to a page by the name of its file says the title instead."""

    def changed(link: re.Match[str]) -> str:
        words, path, anchor = link.groups()
        target = normpath(join("docs", dirname(page), path))
        if target.startswith("docs/"):
            return f"[{_title(target)}]({path}{anchor or ''})" if words == path else link.group()
        if target not in _PAGES:
            return str(words)
        return f"[{words}]({relpath(_PAGES[target], dirname(page) or '.')}{anchor or ''})"

    return _LINK.sub(changed, markdown)


def _title(page: str) -> str:
    """What a page calls itself: on the site, the name of its file means nothing to anybody."""
    first, _, _ = (copied.ROOT / page).read_text(encoding="utf-8").partition("\n")
    return first.removeprefix("# ")
