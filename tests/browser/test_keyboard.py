"""A user without a mouse: Tab, arrow keys, Space and Enter reach and do everything, and the focus is never lost."""

from __future__ import annotations

from playwright.sync_api import Locator, Page, expect

from tests.browser.actions import editor

RULES = """WHEN BellRings THEN OpenDoor
UNLESS Asleep IN WHICH CASE Wait
"""
CONFLICT = "\nWHEN BellRings AND Night THEN NOT OpenDoor\n"
FOCUSED = "one => one === document.activeElement"


def tab_to(page: Page, wanted: Locator) -> None:
    """Press Tab until an element has the focus."""
    for _ in range(60):
        if wanted.evaluate(FOCUSED):
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"Tab does not reach {wanted}")


def test_everything_without_a_mouse(serve, show) -> None:
    server = serve(RULES)
    page = show(server)
    tab_to(page, page.locator(".editor"))
    page.keyboard.press("Control+End")
    page.keyboard.insert_text(CONFLICT)
    expect(page.locator(".finding.error").first).to_be_visible()
    page.keyboard.press("Escape")
    tab_to(page, page.get_by_role("button", name="Show this situation").first)
    page.keyboard.press("Enter")
    expect(page.locator(".contradiction")).to_be_visible()
    expect(page.get_by_role("tabpanel")).to_be_focused()
    tab_to(page, page.get_by_role("button", name="Remove “bell rings” from the situation"))
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Remove “night” from the situation")).to_be_focused()
    page.keyboard.press("Enter")
    tab_to(page, page.get_by_role("button", name="Show repairs").first)
    page.keyboard.press("Enter")
    tab_to(page, page.get_by_role("button", name="Apply").first)
    page.keyboard.press("Space")
    expect(page.locator(".finding.error")).to_have_count(0)
    expect(editor(page)).to_be_focused()
    page.keyboard.press("Control+z")
    expect(page.locator(".finding.error").first).to_be_visible()
    page.keyboard.press("Control+z")
    page.keyboard.press("Escape")

    tab_to(page, page.get_by_role("tab", name="Situation"))
    tab_to(page, page.get_by_role("switch", name="bell rings"))
    page.keyboard.press("Space")
    expect(page.locator(".answer .must li")).to_have_text(["open door"])
    tab_to(page, page.get_by_role("textbox", name="Name of the case"))
    page.keyboard.type("the door opens")
    page.keyboard.press("Enter")
    expect(page.locator(".save-case .done")).to_be_visible()

    tab_to(page, page.get_by_role("tab", name="Situation"))
    page.keyboard.press("ArrowRight")
    tab_to(page, page.get_by_role("spinbutton", name="Time"))
    page.keyboard.press("Enter")
    tab_to(page, page.get_by_role("slider", name="bell rings"))
    page.keyboard.press("ArrowRight")
    expect(page.get_by_role("slider", name="bell rings")).to_have_attribute("aria-valuetext", "1 s")
    page.keyboard.press("Delete")
    expect(page.get_by_role("combobox", name="What")).to_be_focused()

    tab_to(page, page.get_by_role("tab", name="Timeline"))
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    tab_to(page, page.get_by_role("button", name="Run all cases"))
    page.keyboard.press("Enter")
    expect(page.locator(".case.passed")).to_be_visible()
    page.keyboard.press("Control+s")
    expect(page.locator(".announcement")).to_have_text("The file is saved.")


def test_the_focus_moves_to_the_text_when_a_banner_goes(serve, show) -> None:
    server = serve(RULES)
    page = show(server)
    server.path.write_text(RULES + "// theirs", encoding="utf-8")
    expect(editor(page)).to_contain_text("// theirs")
    editor(page).focus()
    page.keyboard.insert_text("// mine\n")
    server.path.unlink()
    expect(page.get_by_role("alert")).to_contain_text("was deleted")
    expect(editor(page)).to_contain_text("// mine")
    page.keyboard.press("Escape")
    tab_to(page, page.get_by_role("button", name="Save again"))
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert")).to_have_count(0)
    expect(editor(page)).to_be_focused()
    assert server.path.read_text(encoding="utf-8") == "// mine\n" + RULES + "// theirs"


def test_a_file_that_is_deleted_leaves_the_text(serve, show) -> None:
    server = serve(RULES)
    page = show(server)
    server.path.unlink()
    expect(page.get_by_role("alert")).to_contain_text("was deleted")
    expect(editor(page)).to_contain_text("BellRings")
    server.path.write_text(RULES, encoding="utf-8")
    expect(page.get_by_role("alert")).to_have_count(0)
