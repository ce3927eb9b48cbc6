"""The audit of many logs on a Dask cluster. Each log is one task, because a mission is read in order."""

from __future__ import annotations

import pickle
from asyncio import TimeoutError  # noqa: A004 - in Python 3.10, this is not the built-in one
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from sleec_runtime.errors import SleecError
from sleec_runtime.support.messages import listed, represent
from sleec_verify.audit.mission import Mission
from sleec_verify.audit.mission_result import MissionResult, UnauditedLog
from sleec_verify.audit.settings import Settings

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset

_CONNECTING = 5.0
"""Seconds to wait for the scheduler."""
_STARTING = 30.0
"""Seconds to wait for the first worker."""


class FleetError(SleecError):
    """A cluster that cannot be used: not reachable, without workers, or with another version of sleec-verify."""


Outcome = Union[MissionResult, UnauditedLog]


class OtherCode(Exception):
    """The code of the worker is not that of the client."""


def audit_on(
    address: str,
    logs: Sequence[str],
    ruleset: Ruleset,
    settings: Settings,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> list[Outcome]:
    """The results of the audits of `logs` on the cluster of the scheduler at `address`, in the order of `logs`.

    If a worker ends, its logs are audited again by others. `progress` receives how many logs are done, and of how many.
    Workers read the logs by their absolute paths.

    Raises:
        FleetError: the cluster cannot be used.
    """
    distributed = _library()
    with _connected(distributed, address) as client:
        _check_workers(client)
        # One task has the rules. If the worker that holds them ends, the scheduler repeats this task.
        rules = client.submit(_same, pickle.dumps((ruleset, settings)), pure=False)
        tasks = {
            client.submit(_audit, str(Path(log).absolute()), log, rules, code_hash(), pure=False): log for log in logs
        }
        outcomes: dict[str, Outcome] = {}
        try:
            for future in distributed.as_completed(tasks, loop=client.loop):
                log = tasks[future]
                outcomes[log] = _outcome(future, log)
                progress(len(outcomes), len(tasks))
        finally:
            client.cancel(list(tasks))
    return [outcomes[log] for log in logs]


@lru_cache(maxsize=1)
def code_hash() -> str:
    """The SHA-256 of the modules of this installation."""
    import sleec_runtime
    import sleec_verify

    digest = sha256()
    for package in (sleec_runtime, sleec_verify):
        folder = Path(package.__file__ or "").parent
        for path in sorted(folder.rglob("*.py")):
            digest.update(f"{path.relative_to(folder).as_posix()}\0".encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()


def _same(content: bytes) -> bytes:
    return content


def _audit(path: str, name: str, rules: bytes, code: str) -> Outcome:
    """Runs on a worker: audits the log at `path`, which the user calls `name`."""
    if code != code_hash():
        raise OtherCode
    ruleset, settings = pickle.loads(rules)
    try:
        mission = Mission(path, ruleset, settings)
        mission.read()
        return mission.finish()._replace(path=name)
    except SleecError as error:
        return UnauditedLog(name, error.message, error.hint)


def _library() -> Any:
    try:
        import distributed
    except ImportError as error:
        problem = f"--scheduler needs a library that is not installed: {error.name}"
        raise FleetError(problem, "install the extra `fleet` of sleec-verify") from None
    return distributed


@contextmanager
def _connected(distributed: Any, address: str) -> Iterator[Any]:
    """A client of the scheduler."""
    try:
        client = distributed.Client(address, timeout=_CONNECTING, set_as_default=False)
    except Exception as error:  # noqa: BLE001 - Dask may raise any exception, such as a TypeError for TLS without keys
        reason = str(error).partition("\n")[0]
        hint = "start it with `dask scheduler`, and give its address, such as tcp://10.0.0.1:8786"
        raise FleetError(f"no Dask scheduler answers at {represent(address)}: {reason}", hint) from None
    try:
        yield client
    finally:
        client.close()


def _check_workers(client: Any) -> None:
    """Waits for a worker, and compares the code of all workers with ours. Later workers are compared at each task."""
    try:
        client.wait_for_workers(1, timeout=_STARTING)
    except TimeoutError:
        raise FleetError("the scheduler has no workers", "start some with `dask worker ADDRESS`") from None
    found: Mapping[str, object] = client.run(code_hash, on_error="return")
    without = sorted(worker for worker, code in found.items() if not isinstance(code, str))
    others = sorted(worker for worker, code in found.items() if isinstance(code, str) and code != code_hash())
    if without or others:
        what = "do not have sleec-verify" if without else "have another version of sleec-verify"
        raise FleetError(
            f"some workers {what}: {listed(without or others)}", "install the version of this machine on every worker"
        )


def _outcome(future: Any, log: str) -> Outcome:
    error = future.exception()
    if error is None:
        result: Outcome = future.result()
        return result
    if isinstance(error, OtherCode):
        return UnauditedLog(
            log, "a worker has another version of sleec-verify", "install the same version on every worker"
        )
    if type(error).__name__ == "KilledWorker":
        return UnauditedLog(
            log, "every worker that audited this log ended", "check the logs and the memory use of the workers"
        )
    return UnauditedLog(log, f"the audit failed on a worker: {type(error).__name__}: {error}")
