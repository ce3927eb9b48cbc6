"""Every view at two sizes: axe-core finds no barrier, nothing is cut off, and screenshots are stored for review."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.browser.actions import flip, place, write
from tests.browser.barriers import barriers
from tests.browser.conftest import SCREENSHOTS
from tests.support.paths import ROOT

SIZES = {"wide": (1400, 900), "narrow": (420, 900)}
RULES = (ROOT / "rulesets" / "care-robot.sleec").read_text(encoding="utf-8")
TIMED = """EVENT SmokeDetected, SoundAlarm, CallOperator

RULE smoke
WHEN SmokeDetected THEN SoundAlarm WITHIN 10 seconds AND CallOperator WITHIN 1 TO 5 minutes
UNLESS Drill
"""
CONFLICT = "\nRULE quiet_evening\nWHEN CurtainOpenRequest THEN NOT OpenCurtains\n"


def situation(page: Page) -> None:
    flip(page, "curtain open request")
    flip(page, "user undressed")
    expect(page.locator(".answer .must")).to_be_visible()


def half_written(page: Page) -> None:
    situation(page)
    write(page, RULES + "\nWHEN")
    expect(page.locator(".problem-title")).to_be_visible()


def contradiction(page: Page) -> None:
    write(page, RULES + CONFLICT)
    expect(page.locator(".finding.error").first).to_be_visible()
    flip(page, "curtain open request")
    expect(page.locator(".contradiction")).to_be_visible()


def timeline(page: Page) -> None:
    write(page, TIMED)
    page.get_by_role("tab", name="Timeline").click()
    place(page, "trigger", "SmokeDetected", 0)
    place(page, "executed", "SoundAlarm", 8)
    place(page, "wait", None, 320)
    expect(page.locator(".windows .bar")).to_have_count(2)


def compare(page: Page) -> None:
    write(page, RULES.replace("THEN OpenCurtains", "THEN OpenCurtains AND ExplainWhy"))
    page.get_by_role("tab", name="Compare").click()
    page.get_by_role("button", name="Compare what the texts require").click()
    expect(page.locator(".differences li").first).to_be_visible()


def repairs(page: Page) -> None:
    write(page, RULES + CONFLICT)
    page.get_by_role("button", name="Show repairs").first.click()
    expect(page.locator(".repairs ol > li").first).to_be_visible()


def cases(page: Page) -> None:
    situation(page)
    page.get_by_role("textbox", name="Name of the case").fill("an undressed user")
    page.get_by_role("button", name="Save this situation").click()
    page.get_by_role("tab", name="Cases").click()
    page.get_by_role("button", name="Run all cases").click()
    expect(page.locator(".case.passed")).to_be_visible()


VIEWS = {
    "timeline": timeline,
    "compare": compare,
    "repairs": repairs,
    "cases": cases,
    "situation": situation,
    "half-written": half_written,
    "contradiction": contradiction,
}


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("view", VIEWS)
def test_a_view_has_no_barriers(view: str, size: str, serve, show) -> None:
    page = show(serve(RULES))
    page.set_viewport_size(dict(zip(("width", "height"), SIZES[size])))
    VIEWS[view](page)
    SCREENSHOTS.mkdir(exist_ok=True)
    page.screenshot(path=SCREENSHOTS / f"{view}-{size}.png", full_page=size == "narrow")
    width = page.evaluate("document.documentElement.scrollWidth")
    assert width <= SIZES[size][0], "the page must not scroll sideways"
    assert barriers(page) == []


def test_banners_and_the_search_panel_have_no_barriers(serve, show) -> None:
    server = serve(RULES)
    page = show(server)
    write(page, RULES + "// mine")
    server.path.write_text(RULES + "// theirs", encoding="utf-8")
    expect(page.get_by_role("alert")).to_contain_text("changed on disk")
    server.kill()
    expect(page.get_by_role("alert").filter(has_text="does not answer")).to_be_visible()
    page.keyboard.press("Control+f")
    expect(page.get_by_role("textbox", name="Find")).to_be_focused()
    page.screenshot(path=SCREENSHOTS / "banners-wide.png")
    assert barriers(page) == []


def test_forced_colors_show_bars_tabs_and_clauses(serve, show) -> None:
    page = show(serve(TIMED))
    page.emulate_media(forced_colors="active", reduced_motion="reduce")
    flip(page, "smoke detected")
    expect(page.locator(".answer .must")).to_be_visible()
    deciding = page.locator(".mark-deciding").first
    assert deciding.evaluate("one => getComputedStyle(one).outlineStyle") == "dashed"
    timeline(page)
    page.screenshot(path=SCREENSHOTS / "forced-colors-wide.png")
    canvas = page.locator(".windows .track").first.evaluate("one => getComputedStyle(one).backgroundColor")
    for bar in page.locator(".windows .bar").all():
        shown = bar.evaluate("one => getComputedStyle(one).backgroundColor + getComputedStyle(one).backgroundImage")
        assert shown != canvas + "none"
    tabs = page.get_by_role("tab").evaluate_all("all => all.map((one) => getComputedStyle(one).backgroundColor)")
    assert len(set(tabs)) == 2


def test_the_selected_tab_is_readable_under_the_pointer(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_role("tab", name="Compare").click()
    assert barriers(page) == []
