"""The report as a page and as Markdown: all that matters is on it, and nothing in it runs or is loaded."""

from __future__ import annotations

import io
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from sleec_runtime.language import parse
from sleec_verify.report.document.names import names
from tests.support.cli import Cli
from tests.support.paths import ROOT

CONFLICT = """READING cascade
// <script>alert(1)</script> <img src=x onerror=alert(1)>
RULE light
WHEN Fall THEN TurnOnLight
RULE dark
WHEN Fall THEN NOT TurnOnLight
UNLESS LightRequested IN WHICH CASE TurnOnLight
UNLESS Age < 16 IN WHICH CASE CallNurse
"""
VOID = ("br", "meta")


class Page(HTMLParser):
    """The elements of a page, if every element is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.attributes: list[tuple[str, str | None]] = []
        self.text = ""
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes += attrs
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" not in self.open:
            self.text += data


def test_the_page_shows_verdicts_findings_repairs_and_tables(cli: Cli) -> None:
    ran = cli("report", "rules.sleec", "-o", "report.html", files={"rules.sleec": CONFLICT})
    assert (ran.code, ran.out) == (1, "")
    text = Path("report.html").read_text("utf-8")
    page = Page(text)
    words = " ".join(page.text.split())
    for expected in (
        "1 contradiction, with a situation that shows it, in the 2 rules of rules.sleec (exceptions read",
        "It happens when “fall” occurs and “light requested” is false.",
        "Verified repairs",
        "“light requested” is true?No:The robot must not turn on light",
        "Yes: go on",
        "The robot must call nurse".lower(),
        "below 16",
        "sleec-verify check --reading cascade rules.sleec",
        "Where the readings differ",
        "Contradiction: turn on light is both required and forbidden",
    ):
        assert expected.lower() in words.lower()
    cli("report", "rules.sleec", "-o", "again.html")
    assert Path("again.html").read_text("utf-8") == text


def test_nothing_on_the_page_runs_or_is_loaded(cli: Cli) -> None:
    name = "<b onclick=alert(1)>`x`.sleec"
    ran = cli("report", name, "broken.sleec", files={name: CONFLICT, "broken.sleec": "RULE <script>\nWHEN"})
    assert ran.code == 2
    page = Page(ran.out)
    assert page.tags.isdisjoint({"script", "img", "link", "iframe", "object", "form", "b"})
    assert not [name for name, _ in page.attributes if name.startswith("on") or name in ("src", "style")]
    assert all((value or "").startswith("#") for name, value in page.attributes if name == "href")
    assert ("content", "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'") in (
        page.attributes
    )
    assert "<script>alert(1)</script>" in page.text
    assert "Nothing was checked" in page.text


@pytest.mark.parametrize("form", ["html", "markdown"])
def test_advice_that_is_a_question_has_one_mark(form: str, cli: Cli) -> None:
    text = "WHEN DoorOpened THEN CloseDoor\nPURPOSE p EXISTS CloseDoors\n"
    out = cli("report", "rules.sleec", "--format", form, files={"rules.sleec": text}).out
    assert "did you mean" in out.lower()
    assert "?." not in out


def test_ids_are_unique_and_links_lead_to_them(cli: Cli) -> None:
    ran = cli("report", "a/rules.sleec", "b/rules.sleec", files={f"{one}/rules.sleec": CONFLICT for one in "ab"})
    page = Page(ran.out)
    ids = [value for name, value in page.attributes if name == "id"]
    assert len(ids) == len(set(ids))
    targets = {(value or "")[1:] for name, value in page.attributes if name == "href"}
    targets |= {one for name, value in page.attributes if name == "aria-labelledby" for one in (value or "").split()}
    assert targets <= set(ids)


def test_markdown_interprets_nothing_of_the_rules(cli: Cli) -> None:
    ran = cli("report", "a_*b*.sleec", "--format", "markdown", files={"a_*b*.sleec": CONFLICT})
    assert ran.code == 1
    assert "## `a_*b*.sleec`" in ran.out
    assert "- Repair: add to rule" in ran.out
    assert re.search(r"\| below 16 \|", ran.out)
    assert "<script>" not in ran.out


def test_markdown_makes_no_link_to_people_issues_or_pages(cli: Cli) -> None:
    base = "<img src=x> @all #12 GH-3 www.x.org 'a' & `b`.sleec"
    files = {base: CONFLICT.replace("Wait", "Go"), "rules.sleec": CONFLICT}
    out = cli("report", "rules.sleec", "--base", base, "--format", "markdown", files=files).out
    (summary,) = (line for line in out.splitlines() if "What changed since" in line)
    assert "&lt;img src=x&gt; @\u200ball #\u200b12 GH-\u200b3 www.\u200bx.org 'a' &amp; `b`" in summary
    assert "<img" not in out


def test_an_undecided_ruleset_is_never_shown_as_fine(cli: Cli) -> None:
    ran = cli("report", str(ROOT / "rulesets" / "hospital-ward.sleec"), "--timeout", "0.000001", "--no-cache")
    assert ran.code == 3
    page = Page(ran.out)
    assert "Unknown: sleec-verify" in page.text
    assert "Proved" not in page.text


@pytest.mark.parametrize(("text", "code"), [("", 2), ("RULE a\nWHEN", 2), ("WHEN A THEN B\n", 0)])
def test_small_texts_have_a_report(cli: Cli, text: str, code: int) -> None:
    ran = cli("report", "rules.sleec", files={"rules.sleec": text})
    assert ran.code == code
    Page(ran.out)


INPUTS = ("rules.sleec", "old.sleec", "proofs/manifest.json", "proofs/deep/proof.lrat")


@pytest.mark.parametrize("name", INPUTS)
def test_an_output_that_is_an_input_is_rejected(name: str, cli: Cli) -> None:
    options = ("--base", "old.sleec", "--certificate", "proofs", "-o", name)
    ran = cli("report", "rules.sleec", *options, files=dict.fromkeys(INPUTS, CONFLICT))
    assert ran.code == 2
    assert "is an input" in ran.err
    assert Path(name).read_text("utf-8") == CONFLICT


def test_the_page_shows_what_changed_since_a_file(cli: Cli) -> None:
    old = CONFLICT.replace("WHEN Fall THEN TurnOnLight", "WHEN Fall THEN Wait")
    ran = cli("report", "new.sleec", "--base", "old.sleec", files={"old.sleec": old, "new.sleec": CONFLICT})
    page = Page(ran.out)
    assert "What changed since old.sleec" in page.text
    assert "New conflict: dark and light: turn on light is now both required and forbidden" in page.text
    ran = cli("report", "new.sleec", "--base", "none")
    assert ran.code == 2
    assert "--base none is neither a file nor a version in git" in ran.err


@pytest.mark.parametrize("form", ["html", "markdown"])
def test_a_new_reading_and_new_assumptions_are_changes(form: str, cli: Cli) -> None:
    old = f"{CONFLICT}RULE late\nWHEN Fall THEN CallNurse WITHIN 5 minutes\n"
    new = old.replace("READING cascade", "READING priority\nASSUME NOT (Dark AND LightRequested)")
    ran = cli("report", "a.sleec", "--base", "b.sleec", "--format", form, files={"b.sleec": old, "a.sleec": new})
    page = ran.out if form == "markdown" else Page(ran.out).text
    _, changes = page.split("What changed since b.sleec")
    assert "reading was cascade and is now priority" in changes
    assumption = "ASSUME NOT (Dark AND LightRequested)"
    assert f"ewer situations are possible, with the new assumption: {assumption}" in changes
    assert "comparison covers the responses of each rule" in changes
    assert "Rule dark when" in page


def test_the_page_shows_what_a_certificate_proves(cli: Cli) -> None:
    rules = "READING cascade\nWHEN A THEN B\n"
    cli("certify", "rules.sleec", "-o", "proofs", files={"rules.sleec": rules})
    ran = cli("report", "rules.sleec", "--certificate", "proofs")
    assert ran.code == 0
    assert "valid certificate of rules.sleec" in Page(ran.out).text
    changed = {"rules.sleec": rules.replace("B", "C")}
    assert cli("report", "rules.sleec", "--certificate", "proofs", files=changed).code == 2


def test_the_page_speaks_other_languages(cli: Cli) -> None:
    ran = cli("report", "rules.sleec", "--language", "de", files={"rules.sleec": CONFLICT})
    assert "Geprüft: die 2 Regeln von rules.sleec (Ausnahmen als Kaskade gelesen; ohne Annahmen;" in Page(ran.out).text
    assert '<html lang="de">' in ran.out


def test_a_finding_with_time_has_a_picture(cli: Cli) -> None:
    rules = "READING cascade\nRULE a\nWHEN A THEN B WITHIN 5 minutes\nRULE b\nWHEN A THEN NOT B WITHIN 9 minutes\n"
    page = Page(cli("report", "rules.sleec", files={"rules.sleec": rules}).out)
    assert "Timeline of finding 2" in page.text
    assert "svg" in page.tags


def test_constraints_of_a_domain_hold_in_its_tables_only(cli: Cli) -> None:
    rules = """RULE door
WHEN Supper THEN HoldDoor
RULE tray
WHEN Supper THEN CarryTray UNLESS Late
DOMAIN home
NEVER HoldDoor AND CarryTray
ASSUME NOT Late
DOMAIN ward
RULE other
WHEN Ward THEN Stay
"""
    ran = cli("report", "rules.sleec", "--no-repairs", "--format", "markdown", files={"rules.sleec": rules})
    assert "- In home, it is assumed that “late” is false (line 7)." in ran.out
    own, together = ran.out.split("Rules with the same trigger, together")
    assert "**Rule tray when “supper” occurs**" in own
    ward, home = together.split("In home:")
    assert "Contradiction: `CarryTray` and `HoldDoor` are required, but the NEVER in line 6 excludes this" in home
    assert "| yes |" not in home
    assert "Contradiction" not in ward
    assert "| yes |" in ward


def test_a_text_in_domains_only_has_its_constraints_in_its_tables(cli: Cli) -> None:
    rules = """DOMAIN home, ward
WHEN Bell THEN OpenDoor
WHEN Bell THEN CallNurse
WHEN Bell THEN LockDoor
EXCLUSIVE OpenDoor, CallNurse
"""

    def tables(text: str, *options: str) -> str:
        ran = cli("report", "a.sleec", "--no-repairs", "--format", "markdown", *options, files={"a.sleec": text})
        return ran.out.partition("Rules with the same trigger, together")[2]

    one = "the EXCLUSIVE in line 5 excludes this"
    assert "In home and ward:" in tables(rules)
    assert tables(rules).count(one) == 1
    rules += "DOMAIN ward\nEXCLUSIVE OpenDoor, LockDoor\n"
    for domain, contradictions in (("home", 1), ("ward", 2)):
        shown = tables(rules, "--domain", domain)
        assert shown.count("In ") == shown.count(f"In {domain}:") == 1
        assert shown.count("excludes this") == contradictions


def test_the_names_have_every_rule_that_uses_them() -> None:
    rules = """EVENT Ring BY environment
EVENT Answer, Knock, Wait
MEASURE patience: integer
ASSUME patience >= 1 AND patience <= 3
RULE r
WHEN Ring THEN Wait ELSE Answer WITHIN patience minutes
"""
    assert [(one.name, one.kind, one.rules) for one in names(parse(rules))] == [
        ("Knock", "trigger", ()),
        ("Ring", "trigger", ("r",)),
        ("patience", "measure", ("r",)),
        ("Answer", "obligation", ("r",)),
        ("Wait", "obligation", ("r",)),
    ]


@pytest.mark.parametrize(
    ("kind", "ranges"),
    [
        ("integer", ["at least 0 and at most 17", "exactly 18", "at least 19"]),
        ("number", ["at least 0 and below 18", "at least 18 and at most 18.5", "above 18.5"]),
    ],
)
def test_ranges_of_whole_numbers_have_whole_limits(kind: str, ranges: list[str], cli: Cli) -> None:
    rules = f"""READING cascade
MEASURE age: {kind}
ASSUME age >= 0
WHEN A AND age >= 18 THEN B UNLESS age > 18.5 IN WHICH CASE C
"""
    ran = cli("report", "a.sleec", "--no-repairs", "--format", "markdown", files={"a.sleec": rules})
    assert re.findall(r"^\| ([^|]*\d) \|", ran.out, re.MULTILINE) == ranges


def test_every_verdict_that_does_not_hold_has_a_finding_or_a_reason(cli: Cli) -> None:
    rules = """READING cascade
MEASURE x: integer
WHEN A THEN B
UNLESS x > 5 IN WHICH CASE C
UNLESS x < 3 IN WHICH CASE D
WHEN A AND x > 5 AND x < 3 THEN E
"""
    ran = cli("report", "a.sleec", "--no-repairs", files={"a.sleec": rules})
    rows = re.findall(r"<tr>(?:(?!</tr>).)*✗ does not hold(?:(?!</tr>).)*</tr>", ran.out, re.DOTALL)
    assert len(rows) == 4
    assert all('href="#ruleset-1-finding-' in row for row in rows)


def test_the_page_has_the_text_of_what_findings_name(cli: Cli) -> None:
    rules = """READING cascade
WHEN Bell THEN OpenDoor AND LockDoor
CONCERN open EXISTS Bell
  WHILE OpenDoor
PURPOSE shut EXISTS LockDoor
DOMAIN home
EXCLUSIVE OpenDoor, LockDoor
"""
    page = Page(cli("report", "a.sleec", "--no-repairs", files={"a.sleec": rules}).out)
    shown = page.text.split("Constraints, concerns and purposes")[1]
    assert shown.startswith(
        "LineKindText3concernCONCERN open EXISTS Bell WHILE OpenDoor5purposePURPOSE shut EXISTS LockDoor"
        "7constraint in homeEXCLUSIVE OpenDoor, LockDoor"
    )


@pytest.mark.parametrize("form", ["html", "markdown"])
def test_findings_and_problems_have_their_lines(form: str, cli: Cli) -> None:
    files = {"a.sleec": CONFLICT, "b.sleec": "RULE a\nWHEN <b> THEN c\n"}
    ran = cli("report", "a.sleec", "b.sleec", "--format", form, files=files)
    page = ran.out if form == "markdown" else Page(ran.out).text
    assert "(SLEEC101, line 4)" in page
    assert "Nothing was checked, because these rules cannot be read." in page
    assert ("b.sleec:2:6: error" if form == "html" else "- line 2: expected a trigger, but found `<`") in page


def test_another_rule_may_apply_where_the_rule_of_a_table_does_not(cli: Cli) -> None:
    rules = "WHEN A THEN B\nWHEN A AND c THEN D\n"
    for form in ("html", "markdown"):
        ran = cli("report", "a.sleec", "--format", form, files={"a.sleec": rules})
        assert "he rule does not apply" in ran.out
        assert "o rule applies" not in ran.out


def test_relations_are_assumptions_of_the_verdict(cli: Cli) -> None:
    rules = """EVENT Ring, Fire BY environment
EVENT OpenDoor
RELATION Ring
  EXCLUDES Fire
WHEN Ring THEN NOT OpenDoor
WHEN Fire THEN OpenDoor
"""
    page = Page(cli("report", "a.sleec", files={"a.sleec": rules}).out)
    assert "Proved: no course of events leads to a contradiction in the 2 rules of a.sleec" in page.text
    assert "under the assumption in line 3" in page.text
    assert "It is assumed that this relation holds: RELATION Ring EXCLUDES Fire (line 3)." in page.text
    assert "No situation is excluded" not in page.text


def test_what_cannot_be_compared_or_checked_is_said(cli: Cli) -> None:
    ran = cli("report", "a.sleec", "--base", "b.sleec", files={"a.sleec": CONFLICT, "b.sleec": "RULE"})
    assert ran.code == 2
    assert "b.sleec:1:5" in ran.err
    assert "The versions cannot be compared: the text has 1 problem." in Page(ran.out).text
    absurd = "ASSUME a AND NOT a\nWHEN t THEN b\nWHEN t THEN NOT b\n"
    ran = cli("report", "a.sleec", files={"a.sleec": absurd})
    assert "Nothing is proved: the assumptions of a.sleec exclude every situation" in Page(ran.out).text
    assert "Proved:" not in Page(ran.out).text
    ran = cli("report", "a.sleec", files={"a.sleec": ""})
    assert (ran.code, "Nothing was checked" in ran.out) == (2, True)


def test_a_missing_folder_and_an_input_are_no_output(cli: Cli) -> None:
    files = {"a.sleec": CONFLICT}
    ran = cli("report", "a.sleec", "-o", "nowhere/x.html", files=files)
    assert "the folder nowhere for x.html does not exist" in ran.err
    assert "a.sleec is an input" in cli("report", "a.sleec", "-o", "a.sleec").err
    assert Path("a.sleec").read_text("utf-8") == CONFLICT


def test_the_command_repeats_the_checks_of_standard_input(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    rules = b"READING cascade\nDOMAIN home, ward\nWHEN A THEN B\n"
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(rules)))
    ran = cli("report", "-")
    assert "sleec-verify check --reading cascade -" in Page(ran.out).text.split("SHA-256:")[1]
    assert "; examined in each of the domains home and ward; SHA-256" in Page(ran.out).text
