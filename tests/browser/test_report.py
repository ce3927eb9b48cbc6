"""The report in a browser: its layout is as committed, axe-core finds no barrier, and nothing is cut off."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from sleec_verify import __version__
from tests.browser.barriers import barriers
from tests.browser.conftest import SCREENSHOTS
from tests.browser.visual import MEDIA, compare_with_reference, differences, picture, with_box_fonts
from tests.support.cli import Cli

RULES = """// Rules that lead to every part of a report.
MEASURE Age: number
ASSUME Age >= 18 OR NOT LivesAlone

// The nurse: a fall is an emergency.
RULE fall
WHEN Fall THEN Light
UNLESS Age < 16 IN WHICH CASE Call
UNLESS LivesAlone IN WHICH CASE Call WITHIN 5 minutes

DOMAIN home
RULE night
WHEN Fall THEN NOT Light
"""
FAULTS = (
    ".finding { display: none }",
    ".finding.error { border-left-style: solid }",
    ".standing.refuted { font-weight: 400 }",
    ".verdict { border-left-width: 2px }",
    ".step { display: block }",
    ".then::before { content: none }",
    ".card { border-color: transparent }",
    "table { border-collapse: separate }",
    "th { font-family: inherit }",
    "a { text-decoration: none }",
    "body { line-height: 1.4 }",
    "pre { padding: 0 }",
)
"""Faults of the style sheet that the comparison of pictures must see."""
REPORT = ("report", "rules.sleec", "broken.sleec")


@pytest.fixture
def report(cli: Cli) -> Callable[..., str]:
    """The text of the report on the rules, and on a file that cannot be read."""

    def made(*options: str) -> str:
        ran = cli(*REPORT, *options, files={"rules.sleec": RULES, "broken.sleec": "RULE a\nWHEN"})
        assert ran.code == 2
        return ran.out

    return made


@pytest.fixture
def open_report(browser: Browser, tmp_path: Path) -> Iterator[Callable[[str], Page]]:
    """Shows the text of a page. The test may run scripts on it, which the policy of the page forbids."""
    context = browser.new_context(bypass_csp=True)

    def opened(html: str) -> Page:
        page = context.new_page()
        (tmp_path / "report.html").write_text(html, encoding="utf-8")
        page.goto((tmp_path / "report.html").as_uri())
        page.evaluate("document.fonts.ready")
        return page

    yield opened
    context.close()


def with_fixed_version(html: str) -> str:
    return html.replace(__version__, "0.0.0")


@pytest.mark.parametrize("medium", MEDIA)
def test_the_layout_is_as_committed(
    medium: str, report: Callable[..., str], open_report: Callable[[str], Page]
) -> None:
    page = open_report(with_box_fonts(with_fixed_version(report())))
    page.locator("a").first.focus()
    compare_with_reference(page, f"report-{medium}", MEDIA[medium])


def test_faults_of_the_style_sheet_are_seen(report: Callable[..., str], open_report: Callable[[str], Page]) -> None:
    page, other = open_report(with_box_fonts(report())), open_report("")
    whole = picture(page, MEDIA["wide"])
    for fault in FAULTS:
        style = page.add_style_tag(content=fault)
        assert differences(other, whole, picture(page, MEDIA["wide"])), fault
        style.evaluate("(one) => one.remove()")
    assert differences(other, whole, picture(page, MEDIA["wide"])) == []


@pytest.mark.parametrize("language", ["en", "it", "de"])
@pytest.mark.parametrize("width", [1100, 360])
def test_a_report_has_no_barriers(
    language: str, width: int, report: Callable[..., str], open_report: Callable[[str], Page]
) -> None:
    page = open_report(report("--language", language))
    page.set_viewport_size({"width": width, "height": 900})
    page.screenshot(path=SCREENSHOTS / f"report-{language}-{width}.png", full_page=True)
    assert page.evaluate("document.documentElement.scrollWidth") <= width, "the page must not scroll sideways"
    assert barriers(page) == []
