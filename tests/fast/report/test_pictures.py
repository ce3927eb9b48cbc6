"""Pictures of rules: they are complete, nothing hides anything else, and they say what the evaluator computes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from random import Random
from typing import get_args
from xml.etree.ElementTree import Element, fromstring

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.language import parse
from sleec_runtime.model import Clause, Reading, Rule, Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.report.document.questions import questions
from sleec_verify.report.pictures.rule_flow import rule_flow
from sleec_verify.report.pictures.rule_graph import rule_graph
from sleec_verify.report.pictures.timeline import timeline_picture
from sleec_verify.wording.names import spoken
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.strategies import contexts, rulesets

SVG = "{http://www.w3.org/2000/svg}"
CARE = """
RULE curtains
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest AND NOT OpenCurtains
RULE air
WHEN CurtainOpenRequest AND UserUndressed THEN CallNurse WITHIN 5 minutes
RULE nurse
WHEN CallNurse THEN LogCall
RULE quiet
WHEN CurtainOpenRequest THEN NOT CallNurse WITHIN 10 minutes
"""


def elements(picture: str, tag: str) -> Iterator[Element]:
    yield from fromstring(picture).iter(f"{SVG}{tag}")


def boxes(picture: str) -> list[tuple[float, float, float, float]]:
    """The sides of the boxes with text: left, top, right, bottom."""
    found = []
    for box in elements(picture, "rect"):
        if box.get("rx"):
            x, y, width, height = (float(box.get(name, "")) for name in ("x", "y", "width", "height"))
            found.append((x, y, x + width, y + height))
    return found


def assert_readable(picture: str) -> None:
    """Boxes do not overlap, everything is within the page, and there are words for screen readers."""
    root = fromstring(picture)
    _, _, width, height = map(float, root.get("viewBox", "").split())
    for one, other in combinations(boxes(picture), 2):
        apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
        assert apart, (one, other)
    for left, top, right, bottom in boxes(picture):
        assert 0 <= left < right <= width
        assert 0 <= top < bottom <= height
    title, description = root.find(f"{SVG}title"), root.find(f"{SVG}desc")
    assert title is not None
    assert description is not None
    assert title.text
    assert description.text
    assert root.get("aria-labelledby") == f"{title.get('id')} {description.get('id')}"


def test_the_graph_shows_all_that_rules_share() -> None:
    picture = rule_graph(parse(CARE, "care.sleec"))
    assert_readable(picture)
    words = [text.text for text in elements(picture, "text")]
    for name in ("curtain open request", "curtains", "air", "user undressed", "refuse request", "log call"):
        assert name in words
    assert "4 rules, 2 triggers, 1 shared condition, 4 responses, 1 response triggers rules" in words
    kinds = [shape.get("class") for shape in elements(picture, "path")]
    assert (kinds.count("forbids"), kinds.count("edge")) == (2, 4 + 4)


@pytest.mark.parametrize("rules", [30, 100])
def test_a_large_graph_is_a_grid(rules: int) -> None:
    random = Random(rules)
    text = "".join(
        f"RULE rule_{number}\nWHEN Event{random.randrange(rules // 3)} THEN Act{random.randrange(rules)}\n"
        f"UNLESS Fact{random.randrange(30)} IN WHICH CASE NOT Act{random.randrange(rules)}\n"
        for number in range(rules)
    )
    picture = rule_graph(parse(text), "it")
    assert_readable(picture)
    assert len(picture) < 6_000 * rules
    words = [text.text for text in elements(picture, "text")]
    assert all(f"rule_{number}" in words for number in range(rules))


@settings(max_examples=25)
@given(rulesets(), st.sampled_from(get_args(Reading)), st.data())
def test_a_flow_leads_to_the_clause_that_decides(ruleset: Ruleset, reading: Reading, data: st.DataObject) -> None:
    context = data.draw(contexts(ruleset))
    for rule in ruleset.rules:
        assert_readable(rule_flow(rule, reading))
        if rule.trigger not in context.triggers:
            continue
        asked, last = questions(rule, reading)
        clause: Clause | None = last
        for one in asked:
            if holds(one.condition, context, ruleset.measures) == one.deciding:
                clause = one.response
                break
        decision = decide(rule, context, reading, ruleset.measures)
        deciding = None if decision is None else list(rule.clauses())[decision.clause]
        assert deciding is clause or (clause is not None and _is_nested(rule, clause, deciding))


def _is_nested(rule: Rule, clause: object, deciding: object) -> bool:
    """Whether the clause that decides is in the chain of `clause`, which a flow does not draw."""
    inner = list(getattr(clause, "hedges", ()))
    return any(one is deciding or _is_nested(rule, one, deciding) for one in inner)


def test_the_flow_of_a_rule_is_in_plain_language() -> None:
    rule = parse(CARE).rules[0]
    (description,) = elements(rule_flow(rule, "cascade"), "desc")
    assert description.text == (
        "When “curtain open request” occurs: unless “user undressed” is true, the robot must open curtains; otherwise, "
        "the robot must refuse request and must not open curtains."
    )
    title = next(elements(rule_flow(rule, "cascade", "de"), "title"))
    assert title.text == "Ablauf der Regel curtains"


def test_a_timeline_shows_events_and_windows() -> None:
    ruleset = parse(CARE)
    (result,) = run_checks(ruleset, ["conflict"])
    finding = next(one for one in result.findings if one.timeline is not None)
    assert finding.timeline is not None
    picture = timeline_picture(finding.timeline, finding.message)
    assert_readable(picture)
    words = [text.text for text in elements(picture, "text")]
    assert {"5 minutes", "10 minutes", "call nurse", spoken("CurtainOpenRequest")} <= set(words)
    title = next(elements(timeline_picture(finding.timeline, finding.message, "de"), "title"))
    assert "„call nurse“ ist zugleich geboten und verboten" in (title.text or "")
    kinds = [shape.get("class") for shape in elements(picture, "rect")]
    assert "met" in kinds
    assert "prohibited" in kinds


def test_long_times_do_not_overlap() -> None:
    text = "CONSTANT Long = 999999999999\nWHEN A THEN B WITHIN Long seconds\nWHEN A THEN NOT B WITHIN Long seconds\n"
    (result,) = run_checks(parse(text), ["conflict"])
    (finding,) = result.findings
    assert finding.timeline is not None
    picture = timeline_picture(finding.timeline, finding.message)
    labels = [text.text or "" for text in elements(picture, "text") if text.get("class") == "small middle"]
    assert " ".join(reversed(labels[1:])) == "11574074 days 1 hour 46 minutes 39 seconds"
    assert max(map(len, labels)) <= 22


def test_a_window_without_an_instant_has_no_bar() -> None:
    ruleset = parse("MEASURE w: integer\nASSUME w >= -3 AND w <= 5\nWHEN A THEN B WITHIN w minutes\n")
    (result,) = run_checks(ruleset, ["conflict"])
    (finding,) = result.findings
    assert finding.timeline is not None
    picture = timeline_picture(finding.timeline, finding.message)
    assert all(float(bar.get("width", "0")) > 0 for bar in elements(picture, "rect"))
    words = [text.text for text in elements(picture, "text")]
    assert "rule_1" in words
    assert "-3 minutes" not in words
    (description,) = elements(picture, "desc")
    assert "; rule `rule_1` requires" in (description.text or "")


@pytest.mark.parametrize("name", ["rule-graph", "rule-flow", "rule-timeline"])
def test_the_pictures_in_the_documentation_are_up_to_date(name: str) -> None:
    path = "rulesets/studies/dairy-farm.sleec"
    ruleset = parse((ROOT / path).read_text(encoding="utf-8"), path)
    if name == "rule-graph":
        picture = rule_graph(ruleset)
    elif name == "rule-flow":
        picture = rule_flow(ruleset.by_label["entry"], ruleset.reading)
    else:
        (result,) = run_checks(ruleset, ["conflict"])
        found = next(one for one in result.findings if one.timeline is not None and "floor" in one.rules)
        assert found.timeline is not None
        picture = timeline_picture(found.timeline, found.message)
    shown = ROOT / "docs" / "assets" / f"{name}.svg"
    if os.environ.get("UPDATE_DOCUMENTS"):
        shown.write_text(picture, encoding="utf-8")
    assert shown.read_text(encoding="utf-8") == picture


def test_script_in_names_is_text() -> None:
    picture = rule_graph(parse(CARE, "<script>alert(1)</script>&.sleec"))
    assert not list(elements(picture, "script"))
    assert "&lt;script&gt;" in picture


def test_check_writes_pictures(cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "care.sleec", "--svg", "pictures", files={"care.sleec": CARE})
    assert ran.err == "pictures: 6 pictures\n"
    names = sorted(path.name for path in Path("pictures").iterdir())
    assert names == [
        "care-graph.svg",
        "care-rule-air.svg",
        "care-rule-curtains.svg",
        "care-rule-nurse.svg",
        "care-rule-quiet.svg",
        "care-timeline-SLEEC101.svg",
    ]
    Path("file").touch()
    ran = cli("check", "care.sleec", "--svg", "file")
    assert ran.code == 2
    assert "file cannot be made" in ran.err


def test_each_picture_has_a_file_of_its_own_in_the_folder(cli: Cli) -> None:
    labels = ["air", "Air", "air-2", "air.2", "con", "é" * 99, "窓" * 99, "窓" * 98, "x.y", "x_y"]
    text = "".join(f"RULE {label}\nWHEN Bell THEN Open\n" for label in labels)
    name = f"{'窓' * 70}.sleec"
    ran = cli("check", name, f"b/{name}", "--svg", "pictures", files={name: text, f"b/{name}": text})
    assert "22 pictures" in ran.err
    files = os.listdir("pictures")
    assert len({file.casefold() for file in files}) == 22
    shown = {fromstring(Path("pictures", file).read_bytes()).findtext(f"{SVG}title") or "" for file in files}
    assert all(any(label in title for title in shown) for label in labels)
