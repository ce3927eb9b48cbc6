"""A user places events on a timeline, and saves situations as cases."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.actions import flip, place, write

RULES = """EVENT SmokeDetected, SoundAlarm, CallOperator

RULE smoke
WHEN SmokeDetected THEN SoundAlarm WITHIN 10 seconds AND CallOperator WITHIN 1 TO 5 minutes
UNLESS Drill
"""


def test_an_event_moves_by_keyboard_and_mouse(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_role("tab", name="Timeline").click()
    place(page, "trigger", "SmokeDetected", 0)
    alarm = page.locator(".windows li").filter(has_text="sound alarm")
    expect(alarm).to_contain_text("0 s to 10 s, pending")
    place(page, "executed", "SoundAlarm", 8)
    expect(alarm).to_contain_text("fulfilled")
    marker = page.get_by_role("slider", name="sound alarm")
    marker.focus()
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    expect(marker).to_have_attribute("aria-valuetext", "12 s")
    expect(alarm).to_contain_text("missed")
    box, lane = marker.bounding_box(), page.locator(".lane").first.bounding_box()
    assert box is not None
    assert lane is not None
    page.mouse.move(box["x"] + 4, box["y"] + 10)
    page.mouse.down()
    page.mouse.move(lane["x"] + 3, box["y"] + 10, steps=4)
    page.mouse.up()
    expect(alarm).to_contain_text("fulfilled")
    marker.focus()
    page.keyboard.press("Delete")
    expect(marker).to_have_count(0)


def test_a_timeline_knows_conditions_and_what_is_missed(serve, show) -> None:
    page = show(serve(RULES))
    page.get_by_role("tab", name="Timeline").click()
    place(page, "trigger", "SmokeDetected", 0)
    place(page, "wait", None, 400)
    expect(page.locator(".windows .window-state")).to_have_text(["missed", "missed"])
    place(page, "true", "Drill", 0)
    expect(page.locator(".windows li")).to_have_count(0)


def test_a_finding_about_time_is_shown_on_the_timeline(serve, show) -> None:
    page = show(
        serve(
            RULES.replace("EVENT", "MEASURE Age: number\nEVENT")
            + "\nRULE quiet\nWHEN SmokeDetected AND Age > 70 THEN NOT CallOperator WITHIN 9 minutes\n"
        )
    )
    found = page.locator(".finding.error").first
    expect(found.get_by_role("button", name="Show this situation")).to_have_count(0)
    found.get_by_role("button", name="Show on the timeline").click()
    expect(page.get_by_role("slider", name="smoke detected")).to_be_visible()
    expect(page.locator(".windows li")).to_contain_text(["sound alarm", "call operator", "must not call operator"])
    expect(page.locator(".timeline .refusal")).to_contain_text("it is impossible to follow every rule")
    expect(page.locator(".lanes .impossible-from")).to_have_count(1)
    expect(page.locator(".windows .window-state.impossible").first).to_have_text("impossible to follow")


def test_a_case_is_saved_and_run(serve, show) -> None:
    text = "WHEN BellRings THEN OpenDoor\nUNLESS Asleep IN WHICH CASE Wait\n"
    server = serve(text)
    page = show(server)
    flip(page, "bell rings")
    flip(page, "asleep")
    expect(page.locator(".answer .must li")).to_have_text(["wait"])
    page.get_by_role("textbox", name="Name of the case").fill("sleeping people are left alone")
    page.get_by_role("button", name="Save this situation").click()
    cases = server.path.with_name("rules.cases.toml")
    expect(page.locator(".save-case .done")).to_contain_text(f"is saved in {cases}")
    page.get_by_role("tab", name="Cases").click()
    expect(page.get_by_text(f"The cases are in the file {cases}")).to_be_visible()
    expect(page.locator(".case.not-run")).to_contain_text("“asleep” is true. Expected: “wait” is required.")
    page.get_by_role("button", name="Run all cases").click()
    expect(page.locator(".case.passed")).to_contain_text("sleeping people are left alone")
    write(page, "WHEN BellRings THEN Wait\nUNLESS Asleep IN WHICH CASE OpenDoor\n")
    expect(page.locator(".case.not-run")).to_be_visible()
    page.get_by_role("button", name="Run all cases").click()
    expect(page.locator(".case.failed")).to_contain_text("The case expects “wait”")
    page.reload()
    page.get_by_role("tab", name="Cases").click()
    expect(page.locator(".case")).to_contain_text("sleeping people are left alone")


def test_cases_follow_the_text_and_their_file(serve, show) -> None:
    server = serve("WHEN BellRings THEN OpenDoor\n")
    page = show(server)
    server.path.unlink()
    write(page, "WHEN BellRings THEN Wait\n")
    flip(page, "bell rings")
    name = page.get_by_role("textbox", name="Name of the case")
    for _ in range(2):
        name.fill("doors stay closed")
        name.press("Enter")
        expect(page.locator(".save-case .done, .save-case .refusal")).to_be_visible()
    expect(page.locator(".save-case .refusal")).to_contain_text("already")
    expect(name).to_have_value("doors stay closed")
    page.get_by_role("tab", name="Cases").click()
    cases = server.path.with_name("rules.cases.toml")
    cases.write_text(cases.read_text(encoding="utf-8").replace("doors", "all doors"), encoding="utf-8")
    expect(page.locator(".case")).to_contain_text("all doors stay closed")
    write(page, "WHEN BellRings THEN Pause\n")
    expect(page.locator(".case")).to_contain_text("The case does not fit the rules")
    write(page, "WHEN BellRings THEN Wait\nWHEN")
    page.get_by_role("button", name="Run all cases").click()
    expect(page.locator(".case.failed")).to_be_visible()
    cases.write_text("not toml", encoding="utf-8")
    expect(page.get_by_role("tabpanel").get_by_role("alert")).to_contain_text("rules.cases.toml")


def test_the_domain_counts_for_the_timeline_and_is_that_of_a_finding(serve, show) -> None:
    text = "DOMAIN home\nRULE a\nWHEN Smoke THEN Alarm WITHIN 9 seconds\nDOMAIN ward\nRULE b\nWHEN Smoke THEN Call\n"
    page = show(serve(text + "RULE c\nWHEN Smoke AND Drill THEN NOT Call\n"))
    page.get_by_role("tab", name="Timeline").click()
    place(page, "trigger", "Smoke", 0)
    expect(page.locator(".windows li")).to_have_count(2)
    page.get_by_text("Reading and domain").click()
    page.get_by_role("combobox", name="Domain").select_option("home")
    expect(page.locator(".windows li")).to_contain_text(["alarm"])
    expect(page.locator(".windows li")).to_have_count(1)
    page.locator(".finding.error").first.get_by_role("button", name="Show this situation").click()
    expect(page.locator(".contradiction")).to_be_visible()
    expect(page.get_by_role("combobox", name="Domain")).to_have_value("ward")


def test_a_case_says_what_the_text_requires(serve, show) -> None:
    page = show(serve("WHEN BellRings THEN Open UNLESS a IN WHICH CASE Wait UNLESS b IN WHICH CASE Call\n"))
    page.get_by_text("Reading and domain").click()
    reading = page.get_by_role("combobox", name="Reading")
    reading.select_option("priority")
    flip(page, "bell rings")
    flip(page, "b")
    expect(page.locator(".answer .must li")).to_have_text(["call"])
    name = page.get_by_role("textbox", name="Name of the case")
    name.fill("one")
    name.press("Enter")
    expect(page.locator(".save-case .refusal")).to_contain_text("the cases use the reading cascade")
    reading.select_option("")
    name.press("Enter")
    expect(page.locator(".save-case .done")).to_be_visible()


def test_a_case_is_that_of_the_last_switch(serve, show) -> None:
    server = serve("WHEN BellRings THEN Open UNLESS Asleep IN WHICH CASE Wait\n")
    page = show(server)
    flip(page, "bell rings")
    expect(page.locator(".answer .must li")).to_have_text(["open"])
    page.get_by_role("textbox", name="Name of the case").fill("one")
    page.route("**/api/situation", lambda route: (page.wait_for_timeout(300), route.continue_()))
    page.get_by_role("switch", name="asleep").evaluate("one => one.click()")
    page.get_by_role("button", name="Save this situation").click()
    expect(page.locator(".save-case .done")).to_be_visible()
    assert 'obligations = ["Wait"]' in server.path.with_name("rules.cases.toml").read_text(encoding="utf-8")


def test_results_go_when_the_file_of_cases_changes(serve, show) -> None:
    server = serve("WHEN BellRings THEN Open\n")
    cases = server.path.with_name("rules.cases.toml")
    cases.write_text('[[case]]\nname = "one"\nwhen = ["BellRings"]\nobligations = ["Open"]\n', encoding="utf-8")
    page = show(server)
    page.get_by_role("tab", name="Cases").click()
    page.get_by_role("button", name="Run all cases").click()
    expect(page.locator(".case.passed")).to_be_visible()
    cases.write_text(cases.read_text(encoding="utf-8").replace('["Open"]', "[]"), encoding="utf-8")
    expect(page.locator(".case.not-run")).to_contain_text("nothing is required")
