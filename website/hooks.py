"""Hooks that mkdocs calls while it builds the site (https://www.mkdocs.org/user-guide/configuration/#hooks)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from website import commands, copied, findings, lexers, links, refused

_FOREIGN = re.compile(r"<(?:script|img|iframe|source|link)\b[^>]*?\b(?:src|href)=\"?(?:https?:)?//[^>]*>")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Add the generated pages to the navigation, and register the lexers for rules."""
    lexers.register()
    made: dict[str, list[Any]] = {
        "Commands": [f"{commands.FOLDER}/index.md", *({n: f"{commands.FOLDER}/{n}.md"} for n in commands.commands())],
        "Findings": [
            f"{findings.FOLDER}/index.md",
            *({e["code"]: f"{findings.FOLDER}/{e['code']}.md"} for e in findings.entries()),
        ],
    }
    config.nav = [{title: made.get(title, value) for title, value in item.items()} for item in config.nav or []]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages."""
    for path, text in (commands.pages() | findings.pages() | copied.pages()).items():
        files.append(File.generated(config, path, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Show the errors below each rejected example, and change links to addresses of the site."""
    return links.within_the_site(refused.with_answers(markdown), page.file.src_uri)


def on_post_build(config: MkDocsConfig) -> None:
    """The site must work without a network, so no page may load anything from elsewhere.

    Raises:
        PluginError: a page does so.
    """
    for page in Path(config.site_dir).rglob("*.html"):
        foreign = [tag for tag in _FOREIGN.findall(page.read_text(encoding="utf-8")) if 'rel="canonical"' not in tag]
        if foreign:
            raise PluginError(f"{page} loads from another server: {foreign[0]}")
