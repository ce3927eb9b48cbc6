"""Logs, mappings and states of audits."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.mapping import TopicMapping
from sleec_runtime.audit.mapping_file import parse_mapping
from sleec_runtime.audit.observation import RawMessage, read_line, write_line
from sleec_runtime.audit.state import restore, save
from sleec_runtime.errors import SleecError
from sleec_runtime.language import parse
from sleec_verify.audit.findings import result_of
from sleec_verify.audit.mission import Mission
from sleec_verify.audit.mission_result import AuditSummary
from sleec_verify.audit.settings import Settings
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from tests.fuzz.property import check_error, unless_refused
from tests.support.paths import ROOT

RULES = parse("""
MEASURE Age: number
MEASURE wait: integer
MEASURE Risk: low < high
CONDITION Dark
ASSUME Age >= 0
EXCLUSIVE Open, Close
NEVER Open AND Dark
RELATION Ring PRECEDES Close
RULE door WHEN Ring THEN Open UNLESS Risk > low IN WHICH CASE Close UNLESS Age < 6 IN WHICH CASE NOT Open
RULE fall WHEN Fall THEN Call WITHIN 5 minutes OTHERWISE Shout WITHIN wait seconds
RULE nap WHEN Open THEN NOT Ring WITHIN 2 TO 5 seconds
DOMAIN home
RULE walk WHEN Fall THEN Close
""")
MAPPING = """\
domain = {topic = "/mode", field = "data", values = {home = 1}}
[conditions]
Dark = {topic = "/light", field = "lux[-1].value", below = 10, until = 20}
[measures]
Age = {topic = "/age", field = "data", scale = 0.5, offset = -1}
Risk = {topic = "/age", field = "risk", values = {low = 0, high = "x"}}
[events]
Ring = [{topic = "/ring"}, {action = "/ring", goal = "accepted"}]
Fall = {topic = "/age", field = "fall"}
[obligations]
Open = {topic = "/ring", field = "data", equals = "open"}
"""
LINES = """\
{"time": 0, "conditions": {"Dark": false, "Age": 36.5, "wait": 3, "Risk": "low"}}
{"time": 1.25, "event": "Ring"}
{"time": 1.5, "executed": "Open"}
{"time": 2, "domain": "home"}
{"time": 3, "event": "Fall"}
{"time": 4, "topic": "/ring", "type": "std_msgs/msg/String", "message": {"data": "open"}}
{"time": 5, "topic": "/light", "message": {"lux": [{"value": NaN}, {"value": 3}]}}
{"time": 900, "topic": "/age", "message": {"data": 3, "risk": "x", "fall": true}}
"""
GOALS: dict[str, object] = {"status_list": [{"status": 2, "goal_info": {"goal_id": {"uuid": [1]}}}]}
MESSAGES: tuple[dict[str, object], ...] = (
    {},
    {"data": True},
    {"data": 3.5},
    {"data": "open", "lux": [{"value": 1}]},
    {"status_list": [{}]},
    GOALS,
)


def log(data: bytes, folder: Path) -> None:
    """Every format shows the result, and an audit that resumes after each line has the same."""
    sources = parse_mapping(MAPPING, "mapping.toml", RULES).sources
    settings = Settings(sources=sources, max_lag=data.count(b"\n") % 2)
    path = folder / "mission.jsonl"
    path.write_bytes(data)
    whole = Mission(str(path), RULES, settings)
    try:
        whole.read()
    except SleecError as error:
        check_error(error)
        return
    parts = Mission(str(path), RULES, settings)
    for end in (len(data) // 2, len(data)):
        path.write_bytes(data[:end])
        state = json.loads(json.dumps(parts.state()))
        parts = Mission(str(path), RULES, settings)
        parts.resume(state)
        if unless_refused(parts.read) is None and end < len(data):
            parts = Mission(str(path), RULES, settings)
    result, other = whole.finish(), parts.finish()
    assert result.records == other.records
    outcome = CheckedRuleset(RULES, (result_of([result], RULES, 0.0),), "at", audit=AuditSummary((result,), 1))
    for form in FORMATS:
        "".join(renderer(form)([outcome], PLAIN))


def mapping(data: bytes, folder: Path) -> None:
    """A mapping that is accepted gives messages a meaning, or says what does not fit."""
    text = data.decode("utf-8", "replace")
    read = unless_refused(parse_mapping, text, "mapping.toml", RULES)
    if read is None:
        return
    found = TopicMapping(read.sources)
    for source in read.sources:
        for fields in MESSAGES:
            list(found.observations(RawMessage(1, source.topic, None, fields)))


def state(data: bytes, folder: Path) -> None:
    """A state that is accepted is saved and restored as the same, and the audit ends."""
    try:
        saved = json.loads(data)
    except (ValueError, RecursionError):
        return
    auditor = unless_refused(restore, RULES, saved)
    if auditor is None:
        return
    again = save(auditor)
    assert save(restore(RULES, json.loads(json.dumps(again)))) == again
    auditor.finish(10**6)


def log_seeds() -> Iterator[bytes]:
    yield LINES.encode()
    yield LINES.encode() + write_line(RawMessage(901, "/ring/_action/status", None, GOALS)).encode()
    yield (ROOT / "examples" / "household_mission.jsonl").read_bytes()


def mapping_seeds() -> Iterator[bytes]:
    yield MAPPING.encode()


def state_seeds() -> Iterator[bytes]:
    auditor = Auditor(RULES)
    yield json.dumps(save(auditor)).encode()
    path = TopicMapping(parse_mapping(MAPPING, "mapping.toml", RULES).sources)
    for line in LINES.splitlines():
        item = read_line(line)
        for observation in path.observations(item) if isinstance(item, RawMessage) else [item]:
            auditor.observe(observation)  # type: ignore[arg-type]
        yield json.dumps(save(auditor)).encode()
