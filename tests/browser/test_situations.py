"""A user tries the rules in situations."""

from __future__ import annotations

from playwright.sync_api import expect

from sleec_verify.wording.names import spoken
from tests.browser.actions import editor, flip, write

RULES = """READING priority
MEASURE UserAge: number
MEASURE Risk: low < high

RULE curtains
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest AND ExplainWhy
UNLESS UserAge < 16 IN WHICH CASE AskParents
UNLESS Risk = high IN WHICH CASE NOT OpenCurtains
"""


def test_a_switch_changes_what_is_required(serve, show) -> None:
    page = show(serve(RULES))
    flip(page, "curtain open request")
    answer = page.locator(".answer")
    expect(answer).to_contain_text("“risk” and “user age” are not given")
    expect(answer).to_contain_text("The robot must")
    expect(answer.locator(".must")).to_have_text("The robot mustopen curtains")
    expect(editor(page).locator(".mark-deciding").first).to_contain_text("WHEN")
    flip(page, "user undressed")
    expect(answer.locator(".must li")).to_have_text(["explain why", "refuse request"])
    expect(answer.get_by_text("exception 1 applies")).to_be_visible()
    expect(editor(page).locator(".mark-deciding").first).to_contain_text("UNLESS")
    expect(answer.locator(".must li span").first).to_have_attribute("title", "ExplainWhy")


def test_numbers_and_scales_count(serve, show) -> None:
    page = show(serve(RULES))
    flip(page, "curtain open request")
    page.get_by_role("slider", name="user age").fill("12")
    expect(page.locator(".answer .must li")).to_have_text(["ask parents"])
    page.get_by_role("spinbutton", name="user age").fill("40")
    page.get_by_role("combobox", name="risk").select_option("high")
    expect(page.locator(".answer .must-not li")).to_have_text(["open curtains"])


def test_numbers_can_be_typed(serve, show) -> None:
    page = show(serve(RULES))
    field = page.get_by_role("spinbutton", name="user age")
    for text, number in (("36.6", "36.6"), ("0.05", "0.05"), ("-2.5", "-2.5"), ("1e3", "1000"), ("12.", "12")):
        field.fill("")
        field.press_sequentially(text)
        expect(page.locator(".chosen li")).to_have_text(f"user age: {number}×")
        field.blur()
        expect(field).to_have_value(number)
    field.press("Control+a")
    field.press("-")
    expect(page.locator(".chosen")).to_have_count(0)
    field.blur()
    page.get_by_role("slider", name="user age").fill("12")
    expect(field).to_have_value("12")


def test_the_answer_stays_while_a_rule_is_half_written(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_role("spinbutton", name="user age").fill("12")
    flip(page, "curtain open request")
    expect(page.locator(".answer .must")).to_be_visible()
    write(page, RULES + "\nWHEN")
    expect(page.locator(".answer").get_by_text("This answer is for the last complete text")).to_be_visible()
    expect(page.locator(".answer .must")).to_be_visible()
    write(page, RULES.replace("AskParents", "CallParents"))
    expect(page.locator(".answer .must li")).to_have_text(["call parents"])


def test_names_read_as_in_the_sentences_of_the_server(serve, show) -> None:
    names = ["CallADoctor", "AEDNeeded", "within10Minutes", "hasB12", "TürÖffnen", "r_moderate", "Bed12", "B", "R2D2x"]
    names += ["der Patient fällt", "don’tCall", "\u0928\u092e\u0938\u094d\u0924\u0947"]
    page = show(serve(f"WHEN Bell THEN Open UNLESS {' OR '.join(names)} IN WHICH CASE Wait\n"))
    shown = page.get_by_role("group", name="What is true").locator("label")
    expect(shown).to_have_text([spoken(name) for name in sorted(names)])


def test_other_languages(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_label("Language").select_option("de")
    expect(page.get_by_role("button", name="Speichern", exact=True)).to_be_visible()
    flip(page, "curtain open request")
    expect(page.locator(".answer")).to_contain_text("Der Roboter muss")
    expect(page.locator(".answer .steps")).to_contain_text("„curtain open request“ tritt ein")
    expect(page.locator(".verdict")).to_contain_text("Bewiesen: Die Regeln widersprechen einander nie.")
    page.get_by_role("button", name="Zeigen", exact=True).click()
    expect(page.locator(".search-answer")).to_contain_text("und sonst nichts")
    page.get_by_label("Sprache").select_option("it")
    expect(page.locator(".search-answer")).to_have_count(0)
    expect(page.locator(".answer")).to_contain_text("Il robot deve")
    expect(page.locator(".verdict")).to_contain_text("Dimostrato")
    page.get_by_label("Lingua").select_option("de")
    page.reload()
    expect(page.get_by_role("button", name="Speichern", exact=True)).to_be_visible()
    expect(page.locator("html")).to_have_attribute("lang", "de")
