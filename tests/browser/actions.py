"""What a user does on the page."""

from __future__ import annotations

from playwright.sync_api import Locator, Page


def editor(page: Page) -> Locator:
    return page.get_by_role("textbox", name="Text of the rules")


def write(page: Page, text: str) -> None:
    """Replace the whole text with the keyboard."""
    editor(page).focus()
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")  # text over a selection lets Chromium copy styles, and report that it may not
    page.keyboard.insert_text(text)


def lines(page: Page) -> Locator:
    """The lines in the editor, of a file that fits on the screen."""
    return editor(page).locator(".cm-line")


def flip(page: Page, name: str) -> None:
    """Press the switch with the keyboard."""
    page.get_by_role("switch", name=name, exact=True).focus()
    page.keyboard.press("Space")


def finding(page: Page, said: str) -> Locator:
    return page.locator(".finding").filter(has_text=said)


def place(page: Page, what: str, name: str | None, time: int) -> None:
    """Place an event on the timeline."""
    page.get_by_role("combobox", name="What").select_option(what)
    if name is not None:
        page.get_by_role("combobox", name="Name").select_option(name)
    page.get_by_role("spinbutton", name="Time", exact=True).fill(str(time))
    page.get_by_role("button", name="Add", exact=True).click()
