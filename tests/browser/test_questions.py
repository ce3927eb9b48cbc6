"""A user repairs rules, asks for situations, and compares versions."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.actions import editor, finding, flip, lines, write

RULES = """READING priority

RULE curtains
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest

RULE fresh_air
WHEN CurtainOpenRequest AND AirIsBad THEN OpenWindow
"""
CONFLICT = RULES + "\nRULE quiet\nWHEN CurtainOpenRequest AND NightTime THEN NOT OpenCurtains\n"


def test_one_click_applies_a_repair_and_undo_takes_it_back(serve, show) -> None:
    page = show(serve(CONFLICT))
    found = finding(page, "contradict").first
    found.get_by_role("button", name="Show repairs").click()
    repair = found.locator(".repairs ol > li").first
    expect(repair.locator(".difference")).to_contain_text("+")
    repair.get_by_role("button", name="Apply").click()
    expect(page.locator(".finding.error")).to_have_count(0)
    expect(lines(page)).not_to_have_text(CONFLICT.split("\n"))
    page.get_by_role("button", name="Undo").click()
    expect(lines(page)).to_have_text(CONFLICT.split("\n"))
    expect(page.locator(".finding.error").first).to_be_visible()


def test_a_finding_sets_the_switches_to_its_situation(serve, show) -> None:
    page = show(serve(CONFLICT))
    finding(page, "contradict").first.get_by_role("button", name="Show this situation").click()
    expect(page.get_by_role("switch", name="night time")).to_be_checked()
    expect(page.locator(".contradiction")).to_be_visible()


def test_a_question_sets_the_switches(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_role("combobox", name="Obligation", exact=True).select_option("RefuseRequest")
    page.get_by_role("button", name="Show me").press("Enter")
    expect(page.get_by_role("switch", name="user undressed")).to_be_checked()
    expect(page.locator(".chosen li")).to_contain_text(["curtain open request", "user undressed"])
    page.get_by_role("button", name="Remove “user undressed” from the situation").click()
    expect(page.locator(".answer .must li")).to_have_text(["open curtains"])
    page.get_by_role("combobox", name="What to look for").select_option("together")
    first = page.get_by_role("combobox", name="Rule", exact=True).input_value()
    seconds = page.get_by_role("combobox", name="Second rule").locator("option")
    assert first not in [option.get_attribute("value") for option in seconds.all()]
    page.get_by_role("button", name="Show me").press("Enter")
    expect(page.get_by_role("switch", name="air is bad")).to_be_checked()
    page.get_by_role("combobox", name="What to look for").select_option("exception")
    page.get_by_role("button", name="Show me").press("Enter")
    expect(page.locator(".answer").get_by_text("exception 1 applies")).to_be_visible()
    page.get_by_role("combobox", name="What to look for").select_option("readings")
    page.get_by_role("button", name="Show me").press("Enter")
    expect(page.locator(".search-answer.none")).to_be_visible()


def test_an_answer_goes_when_it_no_longer_holds(serve, show) -> None:
    page = show(serve(RULES))
    said = page.locator(".search-answer")
    page.get_by_role("button", name="Show me").click()
    expect(said).to_contain_text("The switches show this situation")
    flip(page, "air is bad")
    expect(said).to_have_count(0)
    page.get_by_role("combobox", name="What to look for").select_option("readings")
    page.get_by_role("button", name="Show me").click()
    expect(said).to_contain_text("This is proved")
    write(page, RULES + "UNLESS a IN WHICH CASE Wait UNLESS b IN WHICH CASE Call\n")
    expect(said).to_have_count(0)
    page.get_by_role("button", name="Show me").click()
    expect(said).to_contain_text("The switches show this situation")
    page.get_by_text("Reading and domain").click()
    page.get_by_role("combobox", name="Reading").select_option("cascade")
    expect(said).to_have_count(0)


def test_two_versions_side_by_side(serve, show) -> None:
    page = show(serve(RULES))
    write(page, RULES.replace("OpenWindow", "StartFan"))
    expect(editor(page)).to_contain_text("StartFan")
    page.get_by_role("tab", name="Compare").click()
    expect(page.locator(".sides .cm-changedLine").first).to_be_visible()
    page.get_by_role("button", name="Compare what the texts require").click()
    expect(page.locator(".differences")).to_contain_text("start fan")
    page.get_by_role("button", name="Keep this version to compare later").click()
    expect(page.get_by_text("The two texts are the same.")).to_be_visible()
