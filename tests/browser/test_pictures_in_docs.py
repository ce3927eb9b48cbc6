"""The pictures of the page and of the report in the docs. With UPDATE_DOCUMENTS=1, they are taken again."""

from __future__ import annotations

import os

from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.actions import editor, finding, place
from tests.browser.conftest import SCREENSHOTS
from tests.support.cli import Cli
from tests.support.paths import ROOT

HOUSEHOLD = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
EVENING = "\nRULE quiet_evening\nWHEN CurtainOpenRequest AND EveningTime THEN NOT OpenCurtains\n"
SMOKE = """EVENT SmokeDetected, SoundAlarm, CallOperator, TellPeople

RULE smoke
WHEN SmokeDetected THEN SoundAlarm WITHIN 10 seconds AND CallOperator WITHIN 1 TO 5 minutes
UNLESS FireDrill IN WHICH CASE TellPeople
"""
FALL = """// A resident falls: the nurse is called.
RULE fall_alarm
WHEN FallDetected THEN TurnOnLight AND CallNurse
UNLESS ResidentGetsUp IN WHICH CASE AskForHelp

RULE dark_rooms
WHEN FallDetected AND NOT LightRequested THEN NOT TurnOnLight
UNLESS ResidentGetsUp IN WHICH CASE AskForHelp
"""


def test_a_contradiction_in_a_situation(serve, show) -> None:
    page = show(serve(HOUSEHOLD + EVENING))
    page.set_viewport_size({"width": 1280, "height": 800})
    finding(page, "contradict each other").first.get_by_role("button", name="Show this situation").click()
    expect(page.locator(".contradiction")).to_be_visible()
    editor(page).focus()
    page.keyboard.press("Control+End")
    _picture(page, "serve-situation")


def test_a_missed_deadline_on_the_timeline(serve, show) -> None:
    page = show(serve(SMOKE))
    page.set_viewport_size({"width": 1280, "height": 860})
    page.get_by_role("tab", name="Timeline").click()
    place(page, "trigger", "SmokeDetected", 0)
    place(page, "executed", "SoundAlarm", 8)
    place(page, "wait", None, 320)
    expect(page.locator(".windows li").filter(has_text="call operator")).to_contain_text("missed")
    _picture(page, "serve-timeline")


def test_a_contradiction_in_a_report(browser: Browser, cli: Cli) -> None:
    page = browser.new_page(viewport={"width": 1100, "height": 900})
    page.set_content(cli("report", "ward.sleec", files={"ward.sleec": FALL}).out)
    card = page.locator(".card").filter(has_text="fall_alarm")
    expect(card).to_contain_text("Verified repairs")
    _picture(card, "report")
    page.close()


def _picture(page: Page | Locator, name: str) -> None:
    folder = ROOT / "docs" / "assets" if os.environ.get("UPDATE_DOCUMENTS") else SCREENSHOTS
    folder.mkdir(exist_ok=True)
    page.screenshot(path=folder / f"{name}.png")
