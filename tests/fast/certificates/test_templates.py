"""The templates of a certificate: continuations of the situations of rules that are in no conflict."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.language import parse
from sleec_verify.certificates.certification import rebuild
from sleec_verify.certificates.trace_evidence import TEMPLATES, CheckTemplates
from sleec_verify.certificates.trace_replay import TraceReplay
from sleec_verify.results.conflict_freedom import UsedTemplate
from tests.fast.certificates.test_refused import Manifest, copied, reasons, rehash, rewrite
from tests.support.cli import Cli
from tests.thorough.certificates.test_certificates import source, written

RULES = """RULE a WHEN A THEN X EVENTUALLY
RULE b WHEN B THEN NOT X WITHIN 3 seconds
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with rules that are in no conflict, and their certificate."""
    folder = tmp_path_factory.mktemp("made")
    written(source(RULES, folder), folder / "c")
    return folder


def templates_of(text: str) -> CheckTemplates:
    (found,) = (one for evidence in rebuild(parse(text), None, "at") for one in evidence.templates)
    return found


def test_a_template_and_its_example() -> None:
    (template,) = templates_of(RULES).found.templates
    (later,) = template.later
    assert (later.after, later.seconds, set(later.events)) == ("now", 4, {"X"})
    assert template.example is not None
    *history, now, end = template.example.instants
    assert template.example.now == len(history)
    assert "B" in now[1]
    assert (end[0] - now[0], set(end[1])) == (4, {"X"})


def test_an_example_that_violates_the_rules_is_rejected() -> None:
    made = templates_of(RULES)
    (template,) = made.found.templates
    assert template.example is not None
    *before, (time, events, values) = template.example.instants
    replay = TraceReplay(None)
    assert replay.rejected(made) is None
    for instants in (before, [*before, (time - 1, events, values)], [*before, (time, frozenset[str](), values)]):
        example = template.example._replace(instants=tuple(instants))
        assert replay.rejected(with_template(made, template._replace(example=example))) == "the evaluator in Python"


def with_template(made: CheckTemplates, template: UsedTemplate) -> CheckTemplates:
    return replace(made, found=made.found._replace(templates=(template,)))


CHANGES: list[Callable[[list[Any]], object]] = [
    lambda entries: entries.pop(),
    lambda entries: entries.append(entries[0]),
    lambda entries: entries[0]["rules"].pop(),
    lambda entries: entries[0]["templates"].pop(),
    lambda entries: entries[0]["templates"][0]["acts"].append("X"),
    lambda entries: entries[0]["templates"][0]["later"][0].update(seconds=5),
    lambda entries: entries[0]["templates"][0]["later"][0].update(after="a.0 X"),
    lambda entries: entries[0]["templates"][0].update(example=None),
    lambda entries: entries[0]["templates"][0]["example"]["instants"].pop(),
]


@pytest.mark.parametrize("number", range(len(CHANGES)))
def test_another_template_is_rejected(made: Path, tmp_path: Path, number: int) -> None:
    folder = copied(made, tmp_path)
    path = folder / "c" / TEMPLATES
    entries = json.loads(path.read_text())
    CHANGES[number](entries)
    path.write_text("[\n" + ",\n".join(map(json.dumps, entries)) + "\n]\n")
    assert reasons(folder) == {"file-changed", "template"}
    rehash(folder)
    assert reasons(folder) == {"template"}


def test_proofs_of_two_checks_swapped(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    manifest: Manifest = json.loads((folder / "c" / "manifest.json").read_text())
    conflict = folder / "c" / "conflict.lrat"
    (folder / "c" / "more.lrat").write_text(conflict.read_text())
    assert reasons(folder) == {"file-added"}
    (folder / "c" / "more.lrat").unlink()
    conflict.write_text(conflict.read_text().splitlines()[-1] + "\n")
    rehash(folder)
    assert reasons(folder) == {"proof"}
    assert set(manifest["files"]) >= {"conflict.cnf", "conflict.lrat", TEMPLATES}
    conflict.unlink()
    rewrite(folder, lambda m: m["files"].pop("conflict.lrat"))
    assert reasons(folder) == {"file-missing", "manifest"}


def test_the_last_question_is_named_in_the_formula(made: Path) -> None:
    formula = (made / "c" / "conflict.cnf").read_text()
    assert "\nc question 1: no situation of `a` and `b` is left without a template\n" in formula


# What is not certified ----------------------------------------------------------------------------------------


def missing(text: str) -> dict[str, list[str]]:
    return {
        evidence.result.name: [one.what for one in evidence.shown().uncertified]
        for evidence in rebuild(parse(text), None, "at")
        if evidence.shown().uncertified
    }


def test_what_is_not_certified_is_named(made: Path, cli: Cli) -> None:
    formulas = "that the formulas are those of the rules"
    pending = "that pending demands, components, free events and induction describe all situations"
    serves = "that a template serves all situations that its formula excludes"
    assert missing(RULES)["conflict"] == [formulas, pending, serves]
    assert missing(RULES.replace("EVENTUALLY", "WITHIN 2 seconds"))["conflict"] == [
        formulas,
        "that no response complies in the situation of a trace",
    ]
    assert missing("RULE a WHEN A THEN X\n")["dead-rule"] == ["the situations that answer questions"]
    manifest = json.loads((made / "c" / "manifest.json").read_text())
    assert [one["what"] for one in manifest["checks"][0]["uncertified"]] == [formulas, pending, serves]
    ran = cli("certify", "--check", str(made / "c"), str(made / "rules.sleec"))
    assert f"not certified for conflict: {serves}: evaluators confirm one example of each template\n" in ran.out
    told = json.loads(cli("certify", "--check", str(made / "c"), str(made / "rules.sleec"), "--format", "json").out)
    assert [one["what"] for one in told["uncertified"]["conflict"]] == [formulas, pending, serves]


def test_the_list_cannot_be_shortened(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    rewrite(folder, lambda m: m["checks"][0]["uncertified"].pop())
    assert reasons(folder) == {"manifest"}
