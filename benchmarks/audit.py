"""Measure the audit of a long log: observations for each second of processor time, and the largest memory.

The log has reports, triggers and executions of the household rules and of a rule with a window. The memory is to be the
same for a log that is ten times as long.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

HOUSEHOLD = Path(__file__).parents[1] / "rulesets" / "household.sleec"
WINDOW = "\nDOMAIN everywhere\nRULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 minutes\n"
LENGTHS = (100_000, 1_000_000)
_RESPONSES = {
    "HumanOnFloor": "CallEmergencyServices",
    "CurtainOpenRequest": "OpenCurtains",
    "MorningComes": "OfferWalk",
}
_CONDITIONS = ("UserUndressed", "UserDistressed", "UserResponsive", "UserWithCompanion")


def write_log(path: Path, lines: int) -> None:
    """Writes a log in which the robot follows the rules, with about this many lines."""
    chance = Random(1)
    with path.open("w", encoding="utf-8") as log:
        log.write('{"time": 0, "domain": "household"}\n')
        log.write(f'{{"time": 0, "conditions": {{{", ".join(f"{_quoted(name)}: false" for name in _CONDITIONS)}}}}}\n')
        for second in range(1, lines // 4 + 1):
            name = chance.choice(_CONDITIONS)
            event = chance.choice(tuple(_RESPONSES))
            log.write(f'{{"time": {second}.125, "conditions": {{"{name}": true}}}}\n')
            log.write(f'{{"time": {second}.25, "conditions": {{"{name}": false}}}}\n')
            log.write(f'{{"time": {second}.5, "event": "{event}"}}\n')
            log.write(f'{{"time": {second}.625, "executed": "{_RESPONSES[event]}"}}\n')


def _quoted(name: str) -> str:
    return f'"{name}"'


def measure(log: Path, rules: Path, *options: str) -> tuple[float, float]:
    """The seconds of processor time of an audit, and its largest memory in MiB."""
    program = str(Path(sys.executable).with_name("sleec-verify"))
    command = [program, "audit", str(log), "--ruleset", str(rules), *options]
    process = subprocess.Popen([*command, "--format", "concise"], stdout=subprocess.PIPE)
    assert process.stdout is not None
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(output.decode())
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main() -> None:
    with TemporaryDirectory() as folder:
        rules = Path(folder, "rules.sleec")
        rules.write_text(HOUSEHOLD.read_text(encoding="utf-8") + WINDOW, encoding="utf-8")
        for lines in LENGTHS:
            log = Path(folder, "mission.jsonl")
            write_log(log, lines)
            seconds, memory = measure(log, rules)
            print(f"{lines:9,} lines   {lines / seconds:8,.0f} lines/s   {memory:5.0f} MiB")
