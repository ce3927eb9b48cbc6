"""The traces of a certificate: each shows what it says to both evaluators, and nothing else is accepted."""

from __future__ import annotations

import hashlib
import json
import random
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import load, parse
from sleec_verify.certificates.certification import rebuild
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.trace_evidence import TRACES, CheckTrace
from sleec_verify.certificates.trace_replay import TraceReplay
from sleec_verify.certificates.verification import check_certificate
from tests.fast.certificates.test_refused import copied, reasons, rehash, rewrite
from tests.thorough.certificates.test_certificates import source, written

RULES = """def_start
  event Arrive
  event Leave
  event Greet
  event Follow
  event Ring
  measure asleep: boolean
  measure hurt: boolean
def_end
rule_start
  R1 when Arrive then Greet within 5 seconds unless asleep then Ring within 9 seconds
  R2 when Leave then not Greet within 10 seconds unless hurt
  R3 when Follow and {asleep} then Ring otherwise Greet
  R4 when Arrive then Greet within 9 seconds unless asleep then Ring within 20 seconds
rule_end
concern_start
  c1 when Arrive and {asleep} then Follow
concern_end
purpose_start
  p1 exists Leave while Ring
purpose_end
"""


def traces_of(text: str) -> list[CheckTrace]:
    return [trace for one in rebuild(parse(text), None, "at") for trace in one.traces]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with rules and their certificate."""
    folder = tmp_path_factory.mktemp("made")
    written(source(RULES, folder), folder / "c")
    return folder


def test_each_question_answered_by_a_trace_has_one() -> None:
    shown = {(t.check, t.found.shows, t.found.about[0][0]) for t in traces_of(RULES)}
    for rule in ("R1", "R2", "R3"):
        assert {("redundant-rule", "violation", rule), ("vacuous-conflict", "trigger", rule)} <= shown
    assert ("redundant-hedge", "violation-without-hedge", "R2") in shown
    assert {("concern", "concern", "c1"), ("purpose", "purpose", "p1"), ("conflict", "conflict", "R1")} <= shown
    # Without R1, a response complies with R2, and the reverse.
    assert {("conflict", "response", "R2"), ("conflict", "response", "R1")} <= shown


def changed(trace: CheckTrace) -> Iterator[CheckTrace]:
    """Traces that do not show what this one shows: without events, and about a clause that does not exist."""
    found = trace.found
    silent = tuple((time, frozenset[str](), values) for time, _, values in found.instants)
    yield replace(trace, found=found._replace(instants=silent))
    if found.shows in ("decision", "conflict"):
        label, _ = found.about[0]
        yield replace(trace, found=found._replace(about=((label, 9), *found.about[1:])))


def test_a_replay_confirms_what_is_shown_and_nothing_else() -> None:
    replay = TraceReplay(None)
    traces = traces_of(RULES)
    for trace in traces:
        assert replay.rejected(trace) is None, str(trace)
        for other in changed(trace):
            assert replay.rejected(other) == "the evaluator in Python", str(other)
    assert replay.result().by_oracle == 0
    assert list(replay.result().reasons) == ["the oracle is not built (make proofs)"]


def test_another_trace_is_rejected(made: Path, tmp_path: Path) -> None:
    for number, change in enumerate(CHANGES):
        folder = copied(made, tmp_path / str(number))
        path = folder / "c" / TRACES
        entries = json.loads(path.read_text())
        change(entries)
        path.write_text("[\n" + ",\n".join(map(json.dumps, entries)) + "\n]\n")
        assert reasons(folder) == {"file-changed", "witness"}
        rehash(folder)
        assert reasons(folder) == {"witness"}


CHANGES: list[Callable[[list[Any]], object]] = [
    lambda entries: entries.pop(),
    lambda entries: entries.append(entries[0]),
    lambda entries: entries.reverse(),
    lambda entries: entries[0]["instants"][-1].update(time=77),
    lambda entries: entries[0]["instants"][-1].update(events=[]),
    lambda entries: entries[0]["about"][0].update(clause=1),
    lambda entries: entries[1].update(entries[2]),
    lambda entries: entries[1].update(shows="violation"),
    lambda entries: entries[1].update(more=True),
]


def test_the_message_names_the_trace(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    path = folder / "c" / TRACES
    path.write_text(path.read_text().replace('"Leave"', '"Left"', 1))
    rehash(folder)
    with pytest.raises(CertificateRefused) as refusal:
        check_certificate(load(folder / "rules.sleec"), str(folder / "c"), IN_PYTHON)
    assert "traces.json does not show the conflict of `R1` and `R2` (conflict)" in str(refusal.value)


@pytest.mark.parametrize("text", ["", "[\n\n]\n", "[]", "\x00", "\u00e9" * 9])
def test_a_file_that_is_no_list_of_traces(made: Path, tmp_path: Path, text: str) -> None:
    folder = copied(made, tmp_path)
    (folder / "c" / TRACES).write_text(text, encoding="utf-8")
    rehash(folder)
    assert reasons(folder) == {"witness"}


def test_a_certificate_without_its_traces(made: Path, tmp_path: Path) -> None:
    folder = copied(made, tmp_path)
    (folder / "c" / TRACES).unlink()
    assert reasons(folder) == {"file-missing"}
    rewrite(folder, lambda manifest: manifest["files"].pop(TRACES))
    assert reasons(folder) == {"file-missing", "manifest"}


@pytest.mark.parametrize("name", ["manifest.json", "traces.json", "redundant-rule.cnf", "redundant-rule.lrat"])
def test_changed_bytes(made: Path, tmp_path: Path, name: str) -> None:
    """A change of any byte is rejected. If the hash is that of the changed file, only another refutation can be
    accepted."""
    draw = random.Random(name)
    folder = copied(made, tmp_path)
    path = folder / "c" / name
    data = path.read_bytes()
    for _ in range(3):
        place = draw.randrange(len(data))
        path.write_bytes(data[:place] + bytes([data[place] ^ draw.randrange(1, 256)]) + data[place + 1 :])
        assert reasons(folder)
        if name != "manifest.json":
            rehash(folder)
            found = reasons(folder)
            assert found or name.endswith(".lrat")
            rewrite(folder, lambda m: m["files"].update({name: hashlib.sha256(data).hexdigest()}))


def test_an_unknown_verdict_has_no_traces(monkeypatch: pytest.MonkeyPatch) -> None:
    """A witness that the replay rejects makes the verdict unknown, and is no evidence."""
    monkeypatch.setattr("sleec_verify.checks.replay_finding", lambda index, finding: False)
    (conflict,) = (one for one in rebuild(parse(RULES), None, "at") if one.result.name == "conflict")
    assert (conflict.shown().evidence, conflict.traces, conflict.templates) == ("none", (), ())
    assert [one.what for one in conflict.shown().uncertified] == ["the verdict"]
