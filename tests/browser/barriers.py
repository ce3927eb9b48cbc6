"""Barriers that axe-core finds."""

from __future__ import annotations

from playwright.sync_api import Page

from tests.support.paths import ROOT

AXE = ROOT / "frontend" / "node_modules" / "axe-core" / "axe.min.js"


def barriers(page: Page) -> list[tuple[str, list[str]]]:
    """Each rule of axe-core that the page violates, with the elements."""
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found = page.evaluate("axe.run().then(({violations}) => violations)")
    return [(one["id"], [node["html"][:150] for node in one["nodes"]]) for one in found]
