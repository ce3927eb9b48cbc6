"""Runs the audits of logs: sequentially in this process, or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.mission import Mission
from sleec_verify.audit.mission_result import MissionResult, UnauditedLog
from sleec_verify.audit.settings import Settings
from sleec_verify.cli.progress import Progress
from sleec_verify.results.internal_error import internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.audit.state_file import StateFile


def audit_here(
    logs: Sequence[str], ruleset: Ruleset, settings: Settings, saved: StateFile | None, picture: str | None
) -> list[MissionResult | UnauditedLog]:
    """Audits logs in this process. A log that cannot be read does not stop the others.

    `saved` has the states of earlier runs. The timeline of the last log is written to the file `picture`.
    """
    results: list[MissionResult | UnauditedLog] = []
    with Progress() as progress:
        for log in logs:
            with internal_errors_of(log):
                mission = Mission(log, ruleset, settings)
                recorder = None if picture is None else mission.record_timeline()
                if saved is not None:
                    saved.resume(mission)
                try:
                    _read(mission, partial(_show, progress.on(log)), saved)
                except UnreadableLog as error:
                    results.append(UnauditedLog(log, error.message, error.hint))
                    continue
                results.append(mission.finish())
                if picture is not None and recorder is not None:
                    from sleec_verify.files.placement import write_whole
                    from sleec_verify.report.mission_plot import plot

                    write_whole(picture, plot(recorder.finish()).encode())
    return results


def audit_on_cluster(
    address: str, logs: Sequence[str], ruleset: Ruleset, settings: Settings
) -> list[MissionResult | UnauditedLog]:
    """Audits logs on the Dask cluster of the scheduler at `address`. Raises FleetError."""
    from sleec_verify.audit.fleet import audit_on

    with Progress() as progress:
        shown = progress.on(address)

        def show(done: int, total: int) -> None:
            if shown is not None:
                shown("audit", done, total)

        return audit_on(address, logs, ruleset, settings, show)


def _show(report: Callable[[str, int, int], None] | None, fraction: float) -> None:
    if report is not None:
        report("audit", round(100 * fraction), 100)


def _read(mission: Mission, progress: Callable[[float], None], saved: StateFile | None) -> None:
    if saved is None:
        mission.read(progress)
        return
    with saved.interrupts_deferred():
        mission.read(progress, partial(saved.pause, mission))
    saved.save(mission)
