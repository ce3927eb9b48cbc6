"""A user writes rules, sees findings, and loses nothing."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.actions import editor, finding, flip, lines, write
from tests.browser.server import Recorder

CURTAINS = "WHEN CurtainOpenRequest THEN OpenCurtains\n"
CONFLICT = CURTAINS + "\nWHEN CurtainOpenRequest THEN NOT OpenCurtains\n"
SCRIPT = """// <img src=x onerror="window.pwned = 1"><script>window.pwned = 1</script>
RULE curtains
WHEN the <b onclick=pwned>bell</b> rings THEN open
"""


def test_a_conflict_appears_and_goes(serve, show) -> None:
    page = show(serve(CURTAINS))
    write(page, CONFLICT)
    found = finding(page, "conflict").first
    expect(found).to_contain_text("Error")
    expect(editor(page).locator(".mark-error").first).to_be_visible()
    found.locator("button.sentence").press("Enter")
    expect(editor(page)).to_be_focused()
    expect(editor(page).locator(".mark-selected").first).to_be_visible()
    write(page, CURTAINS)
    expect(found).to_have_count(0)


def test_half_a_rule_keeps_the_last_verdict_and_marks_it_as_old(serve, show) -> None:
    page = show(serve(CONFLICT))
    expect(finding(page, "conflict").first).to_be_visible()
    write(page, CONFLICT + "\nWHEN")
    expect(page.locator(".problem-title")).to_be_visible()
    expect(page.get_by_text("from the last complete text").first).to_be_visible()
    expect(finding(page, "conflict").first).to_be_visible()
    expect(editor(page).locator(".mark-problem").first).to_be_visible()


def test_findings_without_an_answer_are_marked_as_old(serve, show) -> None:
    page = show(serve(CURTAINS))
    waiting = []
    page.route("**/api/check", lambda route: waiting.append(route))
    write(page, CONFLICT)
    expect(page.locator(".verdict.stale")).to_contain_text("Proved")
    expect(page.get_by_text("from an earlier text")).to_be_visible()
    expect(page.locator(".answer").get_by_text("This answer is for an earlier text")).to_be_visible()
    waiting[-1].continue_()
    expect(page.locator(".verdict")).to_contain_text("The rules contradict each other")
    expect(page.locator(".old")).to_have_count(0)
    page.unroute("**/api/check")
    refusal = {"message": "internal error", "hint": None}
    page.route("**/api/check", lambda route: route.fulfill(status=400, json=refusal))
    write(page, CURTAINS)
    expect(page.get_by_role("alert")).to_contain_text("internal error")
    expect(page.locator(".verdict.stale")).to_contain_text("The rules contradict each other")


def test_the_timeline_of_a_half_written_text_is_marked_as_old(serve, show) -> None:
    page = show(serve(CURTAINS))
    page.get_by_role("tab", name="Timeline").click()
    page.get_by_role("button", name="Add", exact=True).click()
    expect(page.locator(".windows li")).to_have_count(1)
    write(page, CURTAINS + "WHEN")
    expect(page.locator(".timeline").get_by_text("This answer is for the last complete text")).to_be_visible()


def test_a_change_that_is_taken_back_at_once_leaves_no_problem(serve, show) -> None:
    page = show(serve(CONFLICT))
    expect(finding(page, "conflict").first).to_be_visible()
    for _ in range(3):
        write(page, CONFLICT)  # it is empty in between
    page.get_by_role("combobox", name="Language").select_option("it")
    expect(page.locator(".verdict")).to_contain_text("Le regole si contraddicono")
    page.get_by_role("combobox", name="Lingua").select_option("en")
    expect(page.locator(".verdict")).to_contain_text("The rules contradict")
    expect(page.locator(".problem-title")).to_have_count(0)


def test_a_draft_survives_a_reload_and_can_be_discarded(serve, show) -> None:
    page = show(serve(CURTAINS))
    with page.expect_response(lambda response: response.url.endswith("/api/draft")):
        write(page, CONFLICT)
    page.reload()
    expect(page.get_by_text("This is your unsaved draft")).to_be_visible()
    expect(lines(page)).to_have_text(CONFLICT.split("\n"))
    page.get_by_role("button", name="Discard the draft").click()
    expect(lines(page)).to_have_text(CURTAINS.split("\n"))


def test_saving_writes_the_file(serve, show) -> None:
    server = serve(CURTAINS)
    page = show(server)
    write(page, CONFLICT)
    expect(page.get_by_text("Not saved yet")).to_be_visible()
    page.get_by_role("tab", name="Situation").focus()
    page.keyboard.press("Control+s")
    expect(page.locator(".announcement")).to_have_text("The file is saved.")
    expect(page.locator("header").get_by_text("✓ Saved")).to_be_visible()
    assert server.path.read_text(encoding="utf-8") == CONFLICT


def test_a_killed_server_loses_nothing(serve, show) -> None:
    server = serve(CURTAINS)
    page = show(server)
    flip(page, "curtain open request")
    write(page, CURTAINS + "// typed before\n")
    server.kill()
    write(page, CONFLICT)
    flip(page, "curtain open request")
    expect(page.get_by_role("alert")).to_contain_text("The server does not answer")
    expect(page.get_by_text(re.compile("from (an earlier|the last complete) text"))).to_be_visible()
    again = serve(CURTAINS)
    assert again.port == server.port
    assert again.address != server.address, "each start has a new token"
    expect(page.get_by_role("alert")).to_have_count(0)
    expect(lines(page)).to_have_text(CONFLICT.split("\n"))
    expect(finding(page, "conflict").first).to_be_visible()
    expect(page.locator(".answer")).to_contain_text("Nothing happens yet")
    expect(show(again).get_by_text("This is your unsaved draft")).to_be_visible()
    page.reload()
    expect(page.get_by_text("This is your unsaved draft")).to_be_visible()
    expect(lines(page)).to_have_text(CONFLICT.split("\n"))
    editor(page).focus()
    page.keyboard.press("Control+s")
    expect(page.locator("header").get_by_text("✓ Saved")).to_be_visible()
    assert server.path.read_text(encoding="utf-8") == CONFLICT


def test_a_page_sends_nothing_to_another_program_at_its_port(serve, show) -> None:
    server = serve(CURTAINS)
    page = show(server)
    server.kill()
    expect(page.get_by_role("alert")).to_contain_text("The server does not answer")
    with Recorder(server.port) as other:
        write(page, CONFLICT)
        expect(page.get_by_role("alert")).to_contain_text("This page has lost its server")
    assert set(other.requests) == {("/api/resumption", None, b"")}
    serve(CURTAINS)
    expect(page.get_by_role("alert")).to_have_count(0)


def test_two_pages_keep_their_own_text_when_they_are_reloaded(serve, show) -> None:
    server = serve(CURTAINS)
    first, second = show(server), show(server)
    write(first, CURTAINS + "// first\n")
    write(second, CURTAINS + "// second\n")
    for page, said in ((first, "// first"), (second, "// second")):
        page.reload()
        expect(editor(page)).to_contain_text(said)


def test_two_pages_on_one_file_never_overwrite_each_other(serve, show) -> None:
    server = serve(CURTAINS)
    first, second = show(server), show(server)
    write(second, CURTAINS + "// mine\n")
    write(first, CONFLICT)
    first.keyboard.press("Control+s")
    expect(second.get_by_role("alert")).to_contain_text("changed on disk while you were writing")
    second.get_by_role("button", name="Save", exact=True).click()
    assert server.path.read_text(encoding="utf-8") == CONFLICT
    second.get_by_role("button", name="Keep my version").click()
    expect(second.get_by_role("alert")).to_have_count(0)
    assert server.path.read_text(encoding="utf-8") == CURTAINS + "// mine\n"
    expect(editor(first)).to_contain_text("// mine")


def test_an_unsaved_text_survives_a_save_on_another_page(serve, show) -> None:
    server = serve(CURTAINS)
    first, second = show(server), show(server)
    write(first, CONFLICT)
    with second.expect_response(lambda response: response.url.endswith("/api/draft")):
        write(second, CURTAINS + "// mine\n")
    first.keyboard.press("Control+s")
    with second.expect_response(lambda response: response.url.endswith("/api/draft")):
        expect(second.get_by_role("alert")).to_contain_text("changed on disk while you were writing")
    first.close()
    second.close()
    third = show(server)
    expect(third.get_by_role("alert")).to_contain_text("changed on disk while you were writing")
    expect(editor(third)).to_contain_text("// mine")


def test_a_file_that_cannot_be_read_leaves_the_text(serve, show) -> None:
    server = serve(CURTAINS)
    page = show(server)
    server.path.write_bytes(b"\xff\xfe")
    expect(page.get_by_role("alert")).to_contain_text("The page can no longer read rules.sleec")
    expect(editor(page)).to_contain_text("OpenCurtains")
    server.path.write_text(CURTAINS, encoding="utf-8")
    expect(page.get_by_role("alert")).to_have_count(0)


def test_their_version_can_be_taken(serve, show) -> None:
    server = serve(CURTAINS)
    page = show(server)
    write(page, CURTAINS + "// mine\n")
    server.path.write_text(CONFLICT, encoding="utf-8")
    page.get_by_role("button", name="Take the other version").click()
    expect(lines(page)).to_have_text(CONFLICT.split("\n"))


def test_script_in_names_and_comments_is_text(serve, show) -> None:
    page = show(serve(SCRIPT))
    write(page, SCRIPT + "\nWHEN <script>window.pwned=1</script> THEN a\n")
    expect(page.locator(".problem-title")).to_be_visible()
    write(page, CURTAINS + SCRIPT.splitlines()[0])
    expect(page.locator(".problem-title")).to_have_count(0)
    assert page.evaluate("window.pwned") is None
    assert page.locator("#page script, #page img").count() == 0


def test_characters_that_change_the_order_of_a_line_are_marked(serve, show) -> None:
    page = show(serve(CURTAINS + "// \u202e\u2066 reversed \u202a\u200b\x08\n"))
    expect(editor(page).locator(".cm-specialChar")).to_have_count(5)
    expect(editor(page).locator(".cm-specialChar").first).to_have_attribute(
        "aria-label", re.compile("right-to-left override")
    )
