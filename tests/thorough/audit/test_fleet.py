"""Audits on a cluster: a scheduler and worker processes."""

from __future__ import annotations

import shlex
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import sleec_runtime
import sleec_verify
from sleec_runtime.audit.quantiles import Quantiles
from sleec_runtime.language import parse
from sleec_verify.audit import fleet
from sleec_verify.audit.fleet import FleetError, audit_on, code_hash
from sleec_verify.audit.mission import Mission
from sleec_verify.audit.mission_result import MissionResult, UnauditedLog
from sleec_verify.audit.settings import Settings
from tests.support.cli import Cli, cli
from tests.support.clusters import Cluster
from tests.support.paths import ROOT

__all__ = ["cli"]

RULES = """
RULE curtains WHEN CurtainRequest THEN OpenCurtains WITHIN 10 seconds
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains WITHIN 5 seconds
"""


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    with Cluster(tmp_path_factory.mktemp("cluster")) as cluster:
        for _ in range(2):
            cluster.add_worker()
        yield cluster


def write_log(path: Path, number: int, requests: int) -> str:
    """A mission with its own deviations: every `number`-th request is ignored."""
    lines = ['{"time": 0, "conditions": {"UserUndressed": false}}']
    for at in range(20, 20 * (requests + 1), 20):
        lines.append(f'{{"time": {at}, "event": "CurtainRequest"}}')
        if at // 20 % (number + 2):
            lines.append(f'{{"time": {at + 1}, "executed": "OpenCurtains"}}')
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def numbers(quantiles: Quantiles) -> tuple[object, ...]:
    """Not `vars`: in Python 3.13.0, the garbage collector empties what that shares with an object that has gone."""
    return dict(quantiles.buckets), quantiles.least, quantiles.greatest


def plain(outcome: MissionResult | UnauditedLog) -> tuple[object, ...]:
    """A result that can be compared."""
    if isinstance(outcome, UnauditedLog):
        return tuple(outcome)
    counted = outcome.coverage.clauses, outcome.coverage.triggered
    times = {
        key: (value.missed, numbers(value.seconds), numbers(value.shares))
        for key, value in outcome.response_times.by_response.items()
    }
    others = {name: value for name, value in outcome._asdict().items() if name not in ("coverage", "response_times")}
    return (others, counted, times)


@pytest.mark.slow
def test_a_cluster_gives_the_results_of_one_process_also_if_workers_end(cluster: Cluster, tmp_path: Path) -> None:
    ruleset, settings = parse(RULES), Settings(tolerance=0)
    logs = [write_log(tmp_path / f"log{number}.jsonl", number, 400) for number in range(7)]
    expected = []
    for log in logs:
        mission = Mission(log, ruleset, settings)
        mission.read()
        expected.append(plain(mission.finish()))
    assert len({str(one[1:]) for one in expected}) == len(logs)
    ended: list[int] = []

    def replace_workers(done: int, total: int) -> None:
        """Ends the workers at work, with what they hold."""
        if done == 2:
            for worker in cluster.workers:
                worker.kill()
                ended.append(worker.wait())
            cluster.add_worker()
        assert total == len(logs)

    found = audit_on(cluster.address, logs, ruleset, settings, replace_workers)
    assert len(ended) == 2
    assert [plain(one) for one in found] == expected
    backwards = audit_on(cluster.address, logs[::-1], ruleset, settings)
    assert [plain(one) for one in backwards[::-1]] == expected


def test_a_log_that_a_worker_cannot_read_does_not_stop_the_others(cluster: Cluster, cli: Cli, tmp_path: Path) -> None:
    write_log(tmp_path / "good.jsonl", 100, 3)
    (tmp_path / "bad.jsonl").write_bytes(b"\x00")
    arguments = ("audit", "missing.jsonl", "good.jsonl", "bad.jsonl", "--ruleset", "rules.sleec", "--format", "concise")
    here = cli(*arguments, files={"rules.sleec": RULES})
    there = cli(*arguments, "--scheduler", cluster.address)
    assert here.code == there.code == 2
    assert "missing.jsonl does not exist" in there.out
    assert "bad.jsonl: unusable: " in there.out
    # Workers know the logs by their absolute paths.
    assert there.out.replace(f"{tmp_path}/", "") == here.out.replace(f"{tmp_path}/", "")


def test_the_command_of_the_page_works(cluster: Cluster, cli: Cli, tmp_path: Path) -> None:
    page = (ROOT / "docs" / "audit-fleet.md").read_text(encoding="utf-8")
    (line,) = [line for line in page.splitlines() if line.startswith("sleec-verify audit /data")]
    write_log(tmp_path / "log.jsonl", 100, 3)
    names = {"/data/logs/*.mcap": "log.jsonl", "tcp://10.0.0.1:8786": cluster.address}
    arguments = [names.get(word, word) for word in shlex.split(line)[1:]]
    ran = cli(*arguments, files={"rules.sleec": RULES, "robot.toml": "tolerance = 2\n"})
    assert ran.code == 0
    assert "tolerance 2 s" in ran.out


@pytest.mark.slow
def test_workers_with_other_code_are_rejected(cluster: Cluster, tmp_path: Path) -> None:
    for package in (sleec_runtime, sleec_verify):
        folder = Path(str(package.__file__)).parent
        shutil.copytree(folder, tmp_path / folder.name, ignore=shutil.ignore_patterns("__pycache__"))
    with (tmp_path / "sleec_verify" / "__init__.py").open("a") as changed:
        changed.write("\n# Another version.\n")
    log = write_log(tmp_path / "log.jsonl", 5, 3)
    with Cluster(tmp_path) as other:
        other.add_worker()
        with pytest.raises(FleetError, match="another version of sleec-verify: tcp://127"):
            audit_on(other.address, [log], parse(RULES), Settings())
    assert [type(one) for one in audit_on(cluster.address, [log], parse(RULES), Settings())] == [MissionResult]


def test_a_worker_that_joins_later_is_compared_as_well(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = write_log(tmp_path / "log.jsonl", 5, 3)
    monkeypatch.setattr(fleet, "_check_workers", lambda client: None)
    monkeypatch.setattr(fleet, "code_hash", lambda: "other")
    (outcome,) = audit_on(cluster.address, [log], parse(RULES), Settings())
    assert isinstance(outcome, UnauditedLog)
    assert "another version" in outcome.message


def test_a_scheduler_that_cannot_be_used_is_reported_quickly(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fleet, "_CONNECTING", 1.0)
    monkeypatch.setattr(fleet, "_STARTING", 1.0)
    write_log(tmp_path / "log.jsonl", 5, 3)
    files = {"rules.sleec": RULES}
    for address in ("tcp://127.0.0.1:1", "tls://127.0.0.1:1", "nonsense://x", "", "no such host:1"):
        began = time.monotonic()
        ran = cli("audit", "log.jsonl", "--ruleset", "rules.sleec", "--scheduler", address, files=files)
        assert ran.code == 2
        assert "no Dask scheduler answers at" in ran.err
        assert time.monotonic() - began < 20
    with Cluster(tmp_path) as without_workers, pytest.raises(FleetError, match="has no workers"):
        audit_on(without_workers.address, [], parse(RULES), Settings())


def test_the_hash_of_the_code_is_that_of_its_files() -> None:
    assert len(code_hash()) == 64
    assert code_hash() == code_hash.__wrapped__()
