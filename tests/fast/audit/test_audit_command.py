"""The command: verdicts, exit codes, positions, several logs, and bad input."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from sleec_runtime.audit.observation import RawMessage, read_line, write_line
from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.ros.messages import MissionEvent
from sleec_verify.audit import mission
from sleec_verify.audit.readers import json_lines
from sleec_verify.audit.settings import Settings
from sleec_verify.audit.state_file import StateFile
from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.formats import VALIDATOR
from tests.support.hostile_json import HOSTILE, places, replaced
from tests.support.schemas import SCHEMAS

RULES = """\
RULE curtains WHEN CurtainRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes
"""
START = '{"time": 0, "conditions": {"UserUndressed": false}}\n'
REQUEST = '{"time": 10, "event": "CurtainRequest"}\n'
OPEN = '{"time": 10.2, "executed": "OpenCurtains"}\n'
END = '{"time": 900, "domain": null}\n'
FALL = '{"time": 20, "event": "UserFell"}\n'
COMMAND = ("audit", "m.jsonl", "--ruleset", "rules.sleec")


def files(log: str | bytes, **others: str) -> dict[str, Any]:
    return {"rules.sleec": RULES, "m.jsonl": log, **others}


def report(cli: Cli, log: str, *options: str, **others: str) -> Any:
    ran = cli(*COMMAND, "--format", "json", *options, files=files(log, **others))
    found = json.loads(ran.out)
    jsonschema.validate(found, SCHEMAS["check"])
    return found["rulesets"][0]


def codes(ruleset: Any) -> list[str]:
    return [finding["code"] for finding in ruleset["findings"]]


def test_a_mission_that_follows_the_rules_passes(cli: Cli) -> None:
    ran = cli(*COMMAND, files=files(START + REQUEST + OPEN))
    assert ran.code == 0
    assert "1 check passed" in ran.out


def test_json_has_times_coverage_and_response_times(cli: Cli) -> None:
    late = '{"time": 400, "executed": "CallNurse"}\n'
    found = report(cli, START + REQUEST + OPEN + FALL + late + END)
    assert codes(found) == ["SLEEC701", "SLEEC705"]
    assert found["checks"][0]["verdict"] == "refuted"
    audit = found["audit"]
    (mission,) = audit["missions"]
    missed = mission["deviations"][0]
    assert (missed["kind"], missed["time"], missed["triggered"]) == ("missed", 320, 20)
    assert (missed["from"], missed["until"], missed["rule"], missed["clause"]) == (20, 320, "fall", 0)
    assert [clause["times"] for clause in audit["coverage"]] == [1, 0, 1]
    assert [(one["obligation"], one["executed"], one["missed"]) for one in audit["responses"]] == [
        ("OpenCurtains", 1, 0),
        ("CallNurse", 0, 1),
    ]
    assert audit["responses"][0]["seconds"]["max"] == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("log", "reason"),
    [
        (REQUEST + OPEN, "values that were not reported"),
        (START, "no rule is triggered"),
        ("\n\n", "no rule is triggered"),
        ("", "no rule is triggered"),
        (FALL, "ends before a window closes"),
        (START + REQUEST + OPEN + '{"time": 11, "eve', "a part of a log cannot be used"),
        (START + REQUEST + OPEN + '{"time": 11, "conditions": {"UserUndressed": 3}}\n', "do not fit"),
        (START + REQUEST + OPEN + '{"time": 5, "event": "UserFell"}\n' + END, "not in chronological order"),
    ],
)
def test_what_is_not_known_is_never_a_pass(log: str, reason: str, cli: Cli) -> None:
    found = report(cli, log)
    assert (found["checks"][0]["verdict"], reason in found["checks"][0]["reason"]) in (
        ("unknown", True),
        ("refuted", True),
    )
    assert cli(*COMMAND, files=files(log)).code in ((3,) if found["checks"][0]["verdict"] == "unknown" else (1,))


def test_late_observations_are_sorted(cli: Cli) -> None:
    late = REQUEST + OPEN + '{"time": 9, "conditions": {"UserUndressed": false}}\n' + END
    assert codes(report(cli, late)) == ["SLEEC706", "SLEEC710"]
    assert codes(report(cli, late, "--max-lag", "2")) == []


def test_findings_have_the_formats_of_check(cli: Cli) -> None:
    given = files(START + REQUEST + "{\n" + END)
    document = json.loads(cli(*COMMAND, "--format", "sarif", files=given).out)
    VALIDATOR.validate(document)
    places = {}
    for result in document["runs"][0]["results"]:
        place = result["locations"][0]["physicalLocation"]
        places[result["ruleId"]] = place["artifactLocation"]["uri"], place["region"]["startLine"]
    assert places == {"SLEEC701": ("rules.sleec", 1), "SLEEC708": ("m.jsonl", 3)}
    (failure,) = ElementTree.fromstring(cli(*COMMAND, "--format", "junit", files=given).out).iter("failure")
    assert "`OpenCurtains` has not been executed" in failure.attrib["message"]


HUGE = 10**400
"""A float cannot have this value."""


@pytest.mark.parametrize("form", FORMATS)
def test_numbers_of_any_size(form: str, cli: Cli, tmp_path: Path) -> None:
    rules = """\
MEASURE Patience: integer
RULE a WHEN A THEN X WITHIN Patience days OTHERWISE Y
RULE b WHEN A THEN NOT Z WITHIN Patience TO Patience days
"""
    log = "".join(
        f'{{"time": {time}, "conditions": {{"Patience": {value}}}}}\n{{"time": {time}, "event": "A"}}\n'
        f'{{"time": {time + 1}, "executed": "X"}}\n{{"time": {time + 2}, "event": "A"}}\n'
        for time, value in enumerate((HUGE, -HUGE, "1e900", 5, "5e-900", HUGE), 1)
    )
    log += f'{{"time": {HUGE}, "event": "A"}}\n'
    plot = tmp_path / "plot.svg"
    given = {"rules.sleec": rules, "m.jsonl": log}
    ran = cli(*COMMAND, "--format", form, "--plot", str(plot), "--late-start", files=given)
    assert ran.code in (1, 3)
    assert "internal error" not in ran.out + ran.err
    ElementTree.parse(plot)


def test_without_a_mapping_the_topics_of_the_log_are_named(cli: Cli) -> None:
    (finding,) = report(cli, '{"time": 12, "topic": "/button", "message": {"data": true}}\n')["findings"]
    assert finding["message"].endswith("nothing was audited; map its topics to the names of the rules: /button")


def test_what_happened_before_a_late_start_is_unknown(cli: Cli) -> None:
    log = START + OPEN + '{"time": 12, "topic": "/button", "message": {"data": true}}\n' + END
    mapping = {
        "m.toml": 'domain = {topic = "/mode", field = "data"}\n'
        'events.CurtainRequest = {topic = "/button", field = "data"}\n'
    }
    assert codes(report(cli, log, "--mapping", "m.toml", **mapping)) == ["SLEEC701", "SLEEC712", "SLEEC705"]
    assert codes(report(cli, log, "--mapping", "m.toml", "--late-start", **mapping)) == [
        "SLEEC711",
        "SLEEC712",
        "SLEEC705",
    ]


def test_the_tolerance_is_that_of_the_option_or_the_mapping(cli: Cli) -> None:
    log = START + REQUEST + '{"time": 13, "executed": "OpenCurtains"}\n'
    mapping = {"m.toml": "tolerance = 5"}
    assert codes(report(cli, log)) == ["SLEEC701", "SLEEC705"]
    assert codes(report(cli, log, "--mapping", "m.toml", **mapping)) == []
    assert codes(report(cli, log, "--mapping", "m.toml", "--tolerance", "0", **mapping)) == ["SLEEC701", "SLEEC705"]


def test_irrelevant_topics_change_nothing(cli: Cli) -> None:
    lines = (START, REQUEST, OPEN, FALL)
    other = '{"time": %d, "topic": "/camera", "message": {"data": [1]}}\n'
    with_others = "".join(line + other % (20 + number) for number, line in enumerate(lines))
    first, second = report(cli, "".join(lines)), report(cli, with_others)
    assert codes(first) == codes(second) == ["SLEEC707"]


def test_a_position_resumes_a_log_that_grows(cli: Cli, tmp_path: Path) -> None:
    log = START + REQUEST + OPEN + FALL
    assert codes(report(cli, log, "--state", "state.json")) == ["SLEEC707"]
    half = '{"time": 400, "ev'
    assert codes(report(cli, log + half, "--state", "state.json")) == ["SLEEC707", "SLEEC708"]
    grown = report(cli, log + END, "--state", "state.json")
    assert codes(grown) == ["SLEEC701"]
    assert grown["audit"] == report(cli, log + END)["audit"]
    assert report(cli, log + END, "--state", "state.json")["audit"] == grown["audit"]


@pytest.mark.parametrize(
    ("state", "options", "problem"),
    [
        ("nonsense", (), "is not the state of an audit"),
        ("{}", (), "is not the state of an audit"),
        (None, ("--tolerance", "3"), "another mapping or other options"),
    ],
)
def test_another_state_is_refused(state: str | None, options: tuple[str, ...], problem: str, cli: Cli) -> None:
    if state is None:
        report(cli, START + REQUEST + OPEN, "--state", "state.json")
        ran = cli(*COMMAND, "--state", "state.json", *options)
    else:
        ran = cli(*COMMAND, "--state", "state.json", files=files(START, **{"state.json": state}))
    assert ran.code == 2
    assert problem in ran.err


def test_a_damaged_state_is_refused(cli: Cli, tmp_path: Path) -> None:
    report(cli, START + REQUEST + OPEN + FALL, "--state", "state.json")
    saved = json.loads((tmp_path / "state.json").read_text(encoding="utf-8"))
    for place in places(saved["logs"]):
        for new in HOSTILE:
            text = replaced(saved, ("logs", *place), new)
            if text == json.dumps(saved):
                continue
            (tmp_path / "state.json").write_text(text, encoding="utf-8")
            with pytest.raises(SnapshotRefused):
                StateFile("state.json", Settings())


def test_a_log_that_changed_is_refused(cli: Cli) -> None:
    report(cli, START + REQUEST + OPEN, "--state", "state.json")
    ran = cli(*COMMAND, "--state", "state.json", files={"m.jsonl": START})
    assert ran.code == 2
    assert "has changed since the position was saved" in ran.err


@pytest.mark.parametrize("options", [(), ("--max-lag", "5"), ("--state", "state.json")])
@pytest.mark.parametrize("name", ["UserUndressed", "battery"])
def test_only_the_values_that_cannot_be_read_are_unknown(name: str, options: tuple[str, ...], cli: Cli) -> None:
    rules = f"MEASURE battery: number\n{RULES}RULE dock WHEN Low THEN Dock UNLESS battery > 5\n"
    values = {"UserUndressed": "true", "battery": "9"} | {name: "NaN"}
    text = ", ".join(f'"{key}": {value}' for key, value in values.items())
    # At first, the line is half written.
    log = f'{START}{{"time": 5, "conditions": {{{text}}}}}'
    report(cli, log, *options, **{"rules.sleec": rules})
    found = report(cli, f"{log}\n{REQUEST}{END}", *options, **{"rules.sleec": rules})
    assert codes(found) == (["SLEEC706"] if name == "UserUndressed" else []) + ["SLEEC708"]
    assert found["checks"][0]["verdict"] == "unknown"


@pytest.mark.parametrize(
    ("log", "names"),
    [
        ("", "`CallNurse`, `OpenCurtains`, `UserFell`"),
        (OPEN, None),
        (write_line(RawMessage(11, "/mission", None, {"data": MissionEvent(trigger="UserFell").to_json()})), None),
    ],
)
@pytest.mark.parametrize("options", [(), ("--state", "state.json")])
def test_an_event_without_an_entry_in_the_mapping_is_named(
    log: str, names: str | None, options: tuple[str, ...], cli: Cli
) -> None:
    others = {"m.toml": '[events]\nCurtainRequest = {topic = "/curtains"}\n'}
    message = '{"time": 10, "topic": "/curtains", "message": {}}\n'
    for end in ("", END):
        found = report(cli, f"{START}{message}{log}\n{end}", "--mapping", "m.toml", *options, **others)
        wanted = f"the mapping has no entry for {names}, so the audit cannot see when they occur"
        named = [one["message"] for one in found["findings"] if one["code"] == "SLEEC712"]
        assert named == ([] if names is None else [wanted])


def test_several_logs_are_several_missions(cli: Cli) -> None:
    others = {"n.jsonl": START + FALL + END}
    ran = cli("audit", "m.jsonl", "n.jsonl", "--ruleset", "rules.sleec", files=files(START + REQUEST + OPEN, **others))
    assert ran.code == 1
    assert "n.jsonl: at 320 s, `CallNurse` has not been executed" in ran.out
    assert "clause coverage: 2 of 3" in ran.out


def test_many_deviations_are_counted(cli: Cli) -> None:
    requests = "".join(f'{{"time": {10 + number * 5}, "event": "CurtainRequest"}}\n' for number in range(50))
    found = report(cli, START + requests + END)
    assert codes(found) == ["SLEEC701"] * 20
    assert found["audit"]["missions"][0]["unlisted"] == 30
    assert "30 more deviations of the same kinds are not listed" in found["checks"][0]["reason"]


@pytest.mark.parametrize(
    ("log", "problem"),
    [
        (b"\x00\x01\xff\xfe" * 50, "is not a log of JSON lines"),
        (b'{"time": "now", "event": "A"}\n', '"time" is a number of seconds'),
        (b'{"time": -1, "event": "A"}\n', '"time" is a number of seconds'),
        (b'{"time": NaN, "event": "A"}\n', '"time" is a number of seconds'),
        (b'{"event": "A"}\n', 'the key "time" is missing'),
    ],
)
def test_a_file_that_is_not_a_log_is_an_error(log: bytes, problem: str, cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "bad.jsonl").write_bytes(log)
    ran = cli("audit", str(tmp_path / "bad.jsonl"), "--ruleset", "rules.sleec", files=files(""))
    assert ran.code == 2
    assert problem in ran.err + ran.out


def test_a_missing_log_is_an_error(cli: Cli) -> None:
    ran = cli("audit", "missing.jsonl", "--ruleset", "rules.sleec", files=files(""))
    assert ran.code == 2
    assert "file missing.jsonl does not exist" in ran.err


@pytest.mark.parametrize("option", ["--tolerance", "--max-lag"])
@pytest.mark.parametrize("seconds", ["nan", "-nan", "inf", "-inf", "1e400", "1e13", "-1", "x"])
def test_a_time_that_is_no_number_of_seconds_is_refused(option: str, seconds: str, cli: Cli) -> None:
    ran = cli(*COMMAND, option, seconds, files=files(START))
    assert ran.code == 2
    assert f"Invalid value for '{option}'" in ran.err


LONG = "x" * 300


@pytest.mark.parametrize("name", ["missing", "missing.mcap", "missing.parquet", LONG, f"{LONG}.mcap", f"{LONG}.db3"])
@pytest.mark.parametrize("more", [(), ("--suggest-mapping",)])
def test_a_log_that_cannot_be_opened_is_named(name: str, more: tuple[str, ...], cli: Cli) -> None:
    ran = cli("audit", name, "--ruleset", "rules.sleec", *more, files=files(START))
    assert ran.code == 2
    assert ran.err.startswith(("error: file missing", f"error: {name} cannot be read: "))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows has no pipes in folders")
@pytest.mark.parametrize("name", ["a.jsonl", "a.mcap", "a.db3", "a.parquet", "bag/metadata.yaml", "bag/a.mcap"])
@pytest.mark.parametrize("more", [(), ("--suggest-mapping",)])
def test_a_pipe_is_not_waited_for(name: str, more: tuple[str, ...], cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "bag").mkdir()
    (tmp_path / "bag" / "metadata.yaml").touch()
    (tmp_path / name).unlink(missing_ok=True)
    os.mkfifo(tmp_path / name)
    ran = cli("audit", name.split("/")[0], "--ruleset", "rules.sleec", *more, files=files(START))
    assert ran.code == 2
    assert f"{name} is not a regular file" in ran.err


def test_a_mapping_that_does_not_fit_the_rules_is_an_error(cli: Cli) -> None:
    mapping = {"m.toml": "[events]\nCurtainReqest = {topic = '/t'}"}
    ran = cli(*COMMAND, "--mapping", "m.toml", files=files(START, **mapping))
    assert ran.code == 2
    assert "m.toml: [events] CurtainReqest: the ruleset has no event" in ran.err
    assert "did you mean `CurtainRequest`?" in ran.err


def test_a_message_without_the_mapped_field_is_reported(cli: Cli) -> None:
    mapping = {"m.toml": '[conditions]\nUserUndressed = {topic = "/user", field = "undressed"}'}
    log = '{"time": 1, "topic": "/user", "message": {"undresed": false}}\n' + REQUEST + OPEN
    found = report(cli, log, "--mapping", "m.toml", **mapping)
    assert codes(found) == ["SLEEC706", "SLEEC708"]
    assert "did you mean `undresed`?" in found["findings"][1]["message"]


def test_the_output_and_the_state_are_different_files(cli: Cli) -> None:
    assert cli(*COMMAND, "-o", "x", "--state", "x", files=files(START)).code == 2
    assert cli(*COMMAND, "--state", "m.jsonl").code == 2


def test_an_interrupt_saves_a_position_that_resumes(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mission, "_PACE", 2)
    log = START + REQUEST + OPEN + FALL + END
    expected = report(cli, log)["audit"]

    def interrupting(line: bytes) -> object:
        if b"OpenCurtains" in line:
            os.kill(os.getpid(), signal.SIGINT)
        return read_line(line)

    monkeypatch.setattr(json_lines, "read_line", interrupting)
    assert cli(*COMMAND, "--state", "state.json").code == 130
    monkeypatch.setattr(json_lines, "read_line", read_line)
    saved = json.loads((tmp_path / "state.json").read_text())
    assert 3 <= saved["logs"]["m.jsonl"]["position"][1] <= 4
    assert report(cli, log, "--state", "state.json")["audit"] == expected


def test_a_log_without_a_domain_gets_a_note(cli: Cli) -> None:
    rules = "DOMAIN home\nRULE a WHEN A THEN X\nDOMAIN ward\nRULE b WHEN A THEN Y\n"
    for domain in ("null", '"home"'):
        log = f'{{"time": 0, "domain": {domain}}}\n{{"time": 1, "event": "A"}}\n'
        ran = cli(*COMMAND, files={"rules.sleec": rules, "m.jsonl": log})
        assert "are combined" not in ran.err
    ran = cli(*COMMAND, files={"m.jsonl": '{"time": 1, "event": "A"}\n'})
    assert "the rules of the domains home and ward are combined" in ran.err
    assert "are combined" not in cli(*COMMAND, "--domain", "home").err


def test_the_auditor_needs_neither_contextpy3_nor_a_solver() -> None:
    code = (
        "import sys\n"
        "before = set(sys.modules)\n"  # measuring coverage imports json
        "import sleec_runtime.audit.auditor, sleec_runtime.audit.mapping_file, sleec_runtime.audit.state\n"
        "print(*{'contextpy3', 'sleec_verify', 'json'} & (set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
