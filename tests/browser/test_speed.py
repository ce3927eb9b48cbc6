"""The speed of the page against the same work in process, in one run, and 2,000 rules.

Where the work in process takes about a millisecond, the smallest request of this browser takes longer than the bound of
the ratio. There, the bound has the time of such requests more, measured at the same time. Other programs delay whole
series of keystrokes, so the quietest of some rounds counts.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median, quantiles
from typing import NamedTuple

from playwright.sync_api import Page, expect

from benchmarks.random_rules import random_rules
from benchmarks.serving import KEYSTROKE, SWITCH, cone
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.checks.incremental.checking import IncrementalChecks
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.situation_text import parse_situation
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.results.finding import Finding
from tests.browser.actions import editor, flip

REQUESTS_OF_SWITCH = 2
"""One request, the click and drawing: 9 to 12 ms on a quiet machine, whose smallest request takes 5 to 7 ms."""

REQUESTS_OF_KEYSTROKE = 5
"""One request, the change in the editor and drawing, where the check of a rule takes less than a millisecond."""

MANY = 5
"""The bound of a keystroke in 2,000 rules, compared with parsing them."""

ROUNDS, TURNS = 3, 20

RULE = "RULE r0\nWHEN T0 THEN O0\nUNLESS C0 IN WHICH CASE P0\n"

WATCH_KEYS = """() => {
  window.times = [];
  let started = null;
  addEventListener("keydown", (event) => event.key === "x" && (started = performance.now()), true);
  new MutationObserver(() => {
    if (started !== null) window.times.push(performance.now() - started);
    started = null;
  }).observe(document.querySelector(".findings"), { childList: true, subtree: true, characterData: true });
}"""

FLIP = """([name, required]) => new Promise((resolve) => {
  const answer = document.querySelector(".answer");
  const started = performance.now();
  new MutationObserver((_, observer) => {
    if (answer.querySelector(".must li").textContent !== required) return;
    observer.disconnect();
    resolve(performance.now() - started);
  }).observe(answer, { childList: true, subtree: true, characterData: true });
  [...document.querySelectorAll("[role=switch]")].find((one) => one.closest("label").title === name).click();
})"""

EMPTY = """async () => {
  const started = performance.now();
  const token = new URLSearchParams(location.search).get("token");
  await (await fetch("/api/disk", { headers: { "X-Sleec-Token": token } })).json();
  return performance.now() - started;
}"""


def rules(count: int) -> str:
    return "\n".join(RULE.replace("0", str(number)) for number in range(count))


def milliseconds(work: Callable[[], object]) -> float:
    started = time.perf_counter()
    work()
    return (time.perf_counter() - started) * 1000


def time_of_check(text: str) -> float:
    return milliseconds(lambda: run_checks(parse(text)))


def high(times: list[float]) -> float:
    """The 95th percentile."""
    return float(quantiles(times, n=20)[-1])


class Round(NamedTuple):
    """What a round took in the browser, and its bound, in milliseconds."""

    took: float
    bound: float
    details: str = ""


def assert_fast(measure: Callable[[], Round]) -> None:
    """At least one of a few rounds is within its bound."""
    rounds: list[Round] = []
    while not rounds or (rounds[-1].took > rounds[-1].bound and len(rounds) < ROUNDS):
        rounds.append(measure())
    assert rounds[-1].took <= rounds[-1].bound, rounds


def test_a_switch_answers_at_once_on_1000_rules(serve, show) -> None:
    ruleset = parse(rules(1000), "rules.sleec")
    context = parse_situation(ruleset, "T0", "C0")
    page = show(serve(rules(1000)))
    flip(page, "T0")
    expect(page.locator(".answer .must")).to_be_visible()

    def switches() -> Round:
        took, entailments, empty = [], [], []
        for required in ["P0", "O0"] * (TURNS // 2):
            took.append(page.evaluate(FLIP, ["C0", required]))
            entailments.append(milliseconds(lambda: entail(ruleset, context)))
            empty.append(page.evaluate(EMPTY))
        bound = SWITCH * median(entailments) + REQUESTS_OF_SWITCH * median(empty)
        return Round(median(took), bound, f"entail {median(entailments):.1f}, empty request {median(empty):.1f}")

    assert_fast(switches)


def test_a_keystroke_brings_fresh_findings_on_100_rules(serve, show) -> None:
    text = random_rules(100)
    checks = IncrementalChecks()
    page = show(serve(text))
    page.evaluate(WATCH_KEYS)

    def keystrokes() -> Round:
        nonlocal text
        cones = []
        for _ in range(TURNS):
            # The first conflict disappears, because its clause requires something else.
            ruleset = parse(text)
            (start, end), *others = (one.span for one in errors(ruleset, checks))
            page.locator(".finding.error .sentence").first.click()
            page.keyboard.press("ArrowRight")
            press_key(page)
            text = f"{text[:end]}x{text[end:]}"
            changed = parse(text)
            label = next(rule.label for rule in changed.rules if rule.span.start <= start < rule.span.end)
            cones.append(time_of_check(cone(changed, label)))
            expect(page.locator(".verdict")).to_contain_text(f" {len(errors(changed, checks))} errors")
            assert others
        took = page.evaluate("window.times.splice(0)")
        return Round(high(took), KEYSTROKE * high(cones), f"medians: {median(took):.1f}, cone {median(cones):.1f}")

    assert_fast(keystrokes)


def errors(ruleset: Ruleset, checks: IncrementalChecks) -> list[Finding]:
    """The errors, as the page lists them."""
    found = CheckedRuleset(ruleset, checks.results(ruleset)).deduplicated
    return [one for one in found if one.severity == "error"]


def press_key(page: Page) -> None:
    """Type an x, and wait for fresh findings."""
    before = page.evaluate("window.times.length")
    page.keyboard.press("x")
    page.wait_for_function("(before) => window.times.length > before", arg=before)


def test_a_keystroke_in_a_rule_that_shares_nothing_with_99_others(serve, show) -> None:
    changed = "\nRULE last\nWHEN T THEN O\nUNLESS C"
    page = show(serve(rules(99) + changed))
    editor(page).focus()
    page.keyboard.press("Control+End")
    page.evaluate(WATCH_KEYS)

    def keystrokes() -> Round:
        cones, empty = [], []
        for _ in range(TURNS):
            press_key(page)
            cones.append(time_of_check(changed))
            empty.append(page.evaluate(EMPTY))
        took = page.evaluate("window.times.splice(0)")
        bound = KEYSTROKE * median(cones) + REQUESTS_OF_KEYSTROKE * median(empty)
        return Round(median(took), bound, f"cone {median(cones):.1f}, empty request {median(empty):.1f}")

    assert_fast(keystrokes)
    expect(page.locator(".finding.note")).to_contain_text("UNLESS cx")


def test_2000_rules_are_usable(serve, show) -> None:
    text = f"{rules(2000)}\nRULE last\nWHEN T THEN O\nUNLESS C"
    page = show(serve(text))
    editor(page).focus()
    page.keyboard.press("Control+End")
    page.evaluate(WATCH_KEYS)

    def keystrokes() -> Round:
        parsing = []
        for _ in range(5):
            press_key(page)
            parsing.append(milliseconds(lambda: parse(text)))
        took = page.evaluate("window.times.splice(0)")
        return Round(median(took), MANY * median(parsing))

    assert_fast(keystrokes)
    page.keyboard.type("yyyyyyyyyy")
    expect(page.locator(".finding.note")).to_contain_text("xyyyyyyyyyy”")
    page.get_by_role("searchbox", name="Filter names").fill("T1999")
    flip(page, "T1999")
    expect(page.locator(".answer .must li")).to_have_text(["O1999"])
    assert page.get_by_role("switch").count() < 200
