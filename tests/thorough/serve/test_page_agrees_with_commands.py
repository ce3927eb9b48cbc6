"""What the page shows is what the commands and the evaluator say, for random texts that are edited step by step."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import Context, Ruleset, Span, Value
from sleec_verify.encoding.trace_scope import speaks_of_traces
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.explanation import explain
from tests.support.cli import Cli
from tests.support.pages import Page, page_on
from tests.support.text_edits import edited_texts
from tests.support.timed_english import timed_english

SEEDS = range(8)


def rulesets(seed: int, edits: int = 2) -> list[tuple[str, Ruleset]]:
    """The texts of a seed that are rulesets."""
    found = []
    for text in edited_texts(seed, edits, timed=True):
        try:
            found.append((text, parse(text)))
        except LanguageError:
            continue
    return found


def random_context(ruleset: Ruleset, random: Random) -> Context:
    values: dict[str, Value] = {name: random.random() < 0.5 for name in sorted(ruleset.conditions)}
    for name, measure in sorted(ruleset.measures.items()):
        values[name] = random.choice(measure.values or (-1, 0, 1, 2))
    return Context(frozenset(name for name in sorted(ruleset.triggers) if random.random() < 0.4), values)


def merged(new: list[Any], old: list[Any], key: str) -> list[Any]:
    """What the page shows: an answer leaves out the content that the page has."""
    known = {one[key]: one for one in old}
    return [{**known.get(one[key], {}), **one} for one in new]


@pytest.mark.parametrize("seed", SEEDS)
def test_findings_are_those_of_check(seed: int, cli: Cli, tmp_path: Path) -> None:
    page = page_on(tmp_path)
    shown: list[Any] = []
    since = None
    for text, ruleset in rulesets(seed, edits=4):
        answer = page.post("check", text=text, since=since)
        since, shown = answer["version"], merged(answer["findings"], shown, "id")
        concise = cli("check", "a.sleec", "--format", "concise", "--no-cache", files={"a.sleec": text}).out
        assert [line.removeprefix("a.sleec:") for line in concise.splitlines()[:-1]] == [
            in_concise_form(one, ruleset) for one in shown
        ], text
        (every,) = json.loads(cli("check", "a.sleec", "--format", "json", "--no-cache").out)["rulesets"]
        witnesses = [(one["message"], one["witness"] and one["witness"]["conditions"]) for one in every["findings"]]
        for one in shown:
            assert (
                one["sentence"].partition("; domain")[0],
                one["witness"] and one["witness"]["conditions"],
            ) in witnesses
        verdicts = {one["name"]: one["verdict"] for one in every["checks"]}
        assert {one["name"]: one["verdict"] for one in answer["checks"]} == verdicts


def in_concise_form(finding: Any, ruleset: Ruleset) -> str:
    """A finding of the page, as ``check --format concise`` writes it after the name of the file."""
    place = ruleset.source.place(Span(finding["start"], finding["end"]))
    return f"{place.line}:{place.column}: {finding['severity']}[{finding['code']}] {finding['sentence']}"


@pytest.mark.parametrize("seed", SEEDS)
def test_situations_are_those_of_entail(seed: int, cli: Cli, tmp_path: Path) -> None:
    page, random = page_on(tmp_path), Random(seed)
    for text, ruleset in rulesets(seed):
        for _ in range(3):
            context = random_context(ruleset, random)
            sent: dict[str, Any] = {"triggers": sorted(context.triggers), "conditions": dict(context.conditions)}
            answer = page.post("situation", text=text, **sent)
            given = ",".join(f"{name}={str(value).lower()}" for name, value in context.conditions.items())
            options = ["--when", ",".join(sent["triggers"]), "--given", given, "--format", "json"]
            ran = cli("entail", "a.sleec", *options, files={"a.sleec": text})
            expected = json.loads(ran.out)
            for field in ("obligations", "prohibitions", "consistent"):
                assert answer[field] == expected[field], (text, context)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_search_shows_holds(seed: int, tmp_path: Path) -> None:
    page, random = page_on(tmp_path), Random(seed)
    for text, ruleset in rulesets(seed, edits=1):
        contexts = [random_context(ruleset, random) for _ in range(60)]
        for name in sorted(ruleset.obligations):
            answer = page.post("search", text=text, question={"kind": "obligation", "obligation": name})
            if answer["answer"] == "found":
                shown = page.post("situation", text=text, **answer["situation"])
                assert name in shown["obligations"]
                assert shown["consistent"]
            elif answer["answer"] == "none":
                for context in contexts:
                    found = entail(ruleset, context)
                    assert name not in found.obligations or found.broken_assumptions, (text, context)
        for rule in ruleset.rules:
            question = {"kind": "exception", "rule": rule.label, "clause": len(rule.hedges)}
            answer = page.post("search", text=text, question=question)
            if answer["answer"] == "found":
                shown = page.post("situation", text=text, **answer["situation"])
                assert (rule.label, len(rule.hedges)) in [(one["label"], one["clause"]) for one in shown["rules"]]


@pytest.mark.parametrize("seed", SEEDS)
def test_comparisons_are_those_of_diff(seed: int, cli: Cli, tmp_path: Path) -> None:
    page = page_on(tmp_path)
    texts = [text for text, _ in rulesets(seed)]
    for old, new in pairwise(texts):
        answer = page.post("compare", old=old, new=new)
        ran = cli("diff", "a.sleec", "b.sleec", "--format", "json", files={"a.sleec": old, "b.sleec": new})
        assert answer.pop("sentences")
        assert without_paths(answer) == without_paths(json.loads(ran.out)), (old, new)


def without_paths(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: without_paths(one) for key, one in value.items() if key not in ("path", "ruleset")}
    return [without_paths(one) for one in value] if isinstance(value, list) else value


@pytest.mark.parametrize("seed", SEEDS)
def test_windows_are_those_of_entail(seed: int, tmp_path: Path) -> None:
    page, random = page_on(tmp_path), Random(seed)
    for text, ruleset in rulesets(seed, edits=3):
        situations = [(4 * number, random_context(ruleset, random)) for number in range(6)]
        situations = [(time, one) for time, one in situations if entail(ruleset, one).consistent]
        events = [
            {"time": time, "triggers": sorted(one.triggers), "conditions": dict(one.conditions)}
            for time, one in situations
        ]
        answer = page.post("timeline", text=text, events=events)
        if speaks_of_traces(ruleset):
            found = {(one["obligation"], one["negated"], one["from"], one["to"]) for one in answer["windows"]}
            assert found == {
                (due.event, due.negated, time + due.start, None if due.end is None else time + due.end)
                for time, one in situations
                for due in explain(ruleset, one).schedule
                if due.after is None and due.start is not None
            }, (text, events)
        late = {f"`{one['rule']}`" for one in answer["windows"] if one["state"] in ("missed", "broken")}
        assert late == {one.split()[1].rstrip(",") for one in answer["problems"] if one.startswith("rule ")}


@pytest.mark.parametrize("seed", range(16))
def test_late_windows_are_what_the_evaluator_finds(seed: int, tmp_path: Path) -> None:
    page, random, text = page_on(tmp_path), Random(seed), timed_english(seed)
    ruleset = parse(text)
    replaced = {line.split()[1] for line in text.splitlines() if "OTHERWISE" in line or "ELSE" in line}
    for _ in range(3):
        events = []
        for time in sorted(random.sample(range(200), 5)):
            context = random_context(ruleset, random)
            done = [name for name in sorted(ruleset.obligations) if random.random() < 0.3]
            conditions = dict(context.conditions)
            events.append(
                {"time": time, "triggers": sorted(context.triggers), "conditions": conditions, "executed": done}
            )
        answer = page.post("timeline", text=text, events=events)
        late = {one["rule"] for one in answer["windows"] if one["state"] in ("missed", "broken")}
        broken = {one.split("`")[1] for one in answer["problems"] if one.startswith("rule ")}
        assert late - replaced <= broken, (text, events)
        assert broken - contradicted(answer["windows"]) <= late, (text, events)


def contradicted(windows: list[Any]) -> set[str]:
    """The rules that require and forbid the same, so that they cannot be followed before a window is over."""
    required = {(one["rule"], one["obligation"]) for one in windows if not one["negated"]}
    return {one["rule"] for one in windows if one["negated"] and (one["rule"], one["obligation"]) in required}


@pytest.mark.parametrize("seed", SEEDS)
def test_an_applied_repair_removes_its_finding_and_adds_none(seed: int, page_texts: Page) -> None:
    for text, _ in rulesets(seed, edits=0):
        before = page_texts.post("check", text=text)["findings"]
        wanted = next((one for one in before if one["repairs"]), None)
        if wanted is None:
            continue
        for repair in page_texts.post("repairs", text=text, finding=wanted["id"])["repairs"]:
            after = page_texts.post("check", text=repair["text"])["findings"]
            assert (wanted["code"], wanted["sentence"]) not in [(one["code"], one["sentence"]) for one in after]
            assert len([one for one in after if one["severity"] == "error"]) <= len(
                [one for one in before if one["severity"] == "error"]
            )
            relation = page_texts.post("compare", old=text, new=repair["text"])["relation"]
            assert (relation == "equivalent") == repair["keeps_meaning"], repair["title"]


@pytest.fixture
def page_texts(tmp_path: Path) -> Page:
    return page_on(tmp_path)
