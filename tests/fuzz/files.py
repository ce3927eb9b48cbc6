"""Files besides rules: the configuration, cases, baselines and the cache."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.evaluation.due import due
from sleec_runtime.language import parse, parse_source
from sleec_runtime.language.common.source import decode_source
from sleec_verify.changes.gate.baseline import baseline_text, key, read_baseline
from sleec_verify.changes.gate.config import OWN, SHARED, read_config
from sleec_verify.changes.gate.keys import is_assertion
from sleec_verify.checks import run_checks
from sleec_verify.cli.cache.entry import encode, head
from sleec_verify.cli.cache.store import Cache
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.scenarios.expectations import unexpected
from sleec_verify.encoding.scope import Scope
from sleec_verify.results.finding import CheckResult
from tests.fuzz.property import unless_refused

TIMED = parse("""
MEASURE n: integer
RULE fall WHEN Fall THEN Call WITHIN n minutes OTHERWISE Alarm
RULE rest WHEN Rest THEN NOT Speak WITHIN 55 minutes
""")
RULESET = parse_source(
    decode_source(
        "fuzz.sleec",
        b"""\
MEASURE Age: number
MEASURE Steps: integer
MEASURE Risk: low < middle < high
CONSTANT LegalAge = 18
EXCLUSIVE Open, Close
DOMAIN home
WHEN Ring THEN Open UNLESS Age < LegalAge AND Steps > 2 IN WHICH CASE (Close AND NOT Speak) UNLESS Risk >= middle
WHEN the night begins THEN Close UNLESS too warm IN WHICH CASE Open
DOMAIN ward
WHEN Ring AND Asleep THEN Speak
""",
    )
)


def configuration(data: bytes, folder: Path) -> None:
    """Settings are read or refused, and their paths stay inside the repository."""
    del folder  # nothing is written
    path = f"sub/{SHARED if b'[tool' in data else OWN}"
    config = unless_refused(read_config, data, path, path)
    if config is not None:
        paths = [config.at(one) for one in (*config.rulesets, *filter(None, [config.baseline]))]
        paths += [config.at(one) for one in config.assertions if not is_assertion(one)]
        paths += [target.at(one) for target in config.targets for one in (target.code, target.rules)]
        assert all(not one.startswith("/") and one.split("/")[0] != ".." for one in paths)


def cases(data: bytes, folder: Path) -> None:
    """Each case that is read is a situation of the rules. Each scenario is compared with what the rules require."""
    path = folder / "fuzz.cases.toml"
    path.write_bytes(data)
    rules = TIMED if b"steps" in data else RULESET
    found = unless_refused(read_cases, path, rules)
    for case in () if found is None else found.situations:
        assert set(case.obligations) <= rules.obligations
        due(rules, case.context())
    for scenario in () if found is None else found.scenarios:
        unless_refused(lambda one: list(unexpected(rules, one)), scenario)


def cases_seeds() -> Iterator[bytes]:
    yield b"""\
reading = "priority"
[[case]]
name = "a guest rings"
domain = "home"
when = ["Ring", "the night begins"]
given = { Age = 17.5, Steps = 3, Risk = "middle", "too warm" = true }
obligations = ["Close"]
prohibitions = ["Speak"]
reaches = ["rule_1.hc1"]
[[case]]
when = "Ring"
given = "Asleep, Age=LegalAge"
conflict = true
"""
    yield b"""\
[[case]]
name = "nobody comes"
steps = [{ at = 0, when = ["Fall"], given = { n = 2 } }, { at = "5 minutes", when = ["Rest"] }]
end = "1 hour"
completions = [{ name = "Call", since = 0, at = "never" }]
obligations = [
  { name = "Call", from = 0, to = 120, rule = "fall" },
  { name = "Alarm", from = 120, to = 120, instead_of = "Call", overdue = true },
]
prohibitions = [{ name = "Speak", from = 300, to = "1 hour" }]
"""


def baseline(data: bytes, folder: Path) -> None:
    """What is read is written again as the same."""
    del folder  # nothing is written
    known = unless_refused(read_baseline, data, "baseline.json")
    if known is not None:
        assert read_baseline(baseline_text(known).encode(), "baseline.json") == known


def baseline_seeds() -> Iterator[bytes]:
    findings = (finding for result in _results() for finding in result.findings)
    yield baseline_text(key("fuzz.sleec", RULESET, finding) for finding in findings).encode()


def cache(data: bytes, folder: Path) -> None:
    """An entry with any content, whose hash fits, is read or ignored."""
    kept = Cache(str(folder), lambda message: None)
    path = kept.path(RULESET, Scope())
    assert path is not None
    Path(path).parent.mkdir(exist_ok=True)
    Path(path).write_bytes(head(path, data) + b"\n" + data)
    results = kept.kept(RULESET, Scope())
    assert results is None or all(isinstance(result, CheckResult) for result in results)


def cache_seeds() -> Iterator[bytes]:
    yield encode(_results())


def _results() -> tuple[CheckResult, ...]:
    return run_checks(RULESET)
