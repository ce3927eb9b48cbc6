"""``sleec-verify audit``."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING

import click

from sleec_runtime.model import LONGEST
from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import note_mixed_domains, one_ruleset
from sleec_verify.cli.output import complain, report
from sleec_verify.encoding.trace_scope import speaks_of_traces
from sleec_verify.report import FORMATS
from sleec_verify.report.outcome import CheckedRuleset, UnusableInput
from sleec_verify.results.finding import Severity
from sleec_verify.results.internal_error import InternalError, internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.audit.settings import Settings
    from sleec_verify.encoding.scope import Scope


_EXCLUSIVE = {
    "--suggest-mapping": ("--mapping", "--state", "--plot", "--scheduler"),
    "--scheduler": ("--state", "--plot"),
    "--plot": ("--state",),
}
"""Options that cannot be used together. A picture needs the whole mission, and a cluster saves no positions."""


@click.command(
    "audit",
    short_help="Check recorded missions against the rules.",
    epilog="Example: sleec-verify audit examples/household_mission.jsonl --ruleset rulesets/household.sleec",
)
@click.argument("logs", metavar="LOG…", nargs=-1, required=True, type=options.PATH)
@click.option("--ruleset", "path", metavar="FILE", required=True, type=options.PATH, help="The file with the rules.")
@click.option(
    "--mapping",
    metavar="FILE",
    type=options.PATH,
    help="A TOML file that maps topics and fields of the log to names of the rules.",
)
@options.scope(options.reading, options.domain, options.untimed, options.chains)
@click.option(
    "--tolerance",
    metavar="SECONDS",
    type=options.Seconds(LONGEST),
    help="Allow for this delay in the log: an obligation may be executed this much later. [default: 1, or that of the "
    "mapping]",
)
@click.option(
    "--max-lag",
    metavar="SECONDS",
    type=options.Seconds(LONGEST),
    default=0,
    help="Sort observations by time if they are at most this late.",
)
@click.option(
    "--late-start",
    "late",
    is_flag=True,
    help="The mission began before the log: what happened and was required before is unknown.",
)
@click.option(
    "--state",
    metavar="FILE",
    type=options.PATH,
    help="Continue from the position in this file, if it exists, and save the position there, also after Ctrl-C.",
)
@click.option(
    "--plot",
    "picture",
    metavar="FILE",
    type=options.PATH,
    help="Also write the timeline of the mission to this file, as a picture in SVG.",
)
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Audit the logs on the Dask cluster of this scheduler, such as tcp://10.0.0.1:8786.",
)
@click.option(
    "--suggest-mapping",
    is_flag=True,
    help="Write a draft of a mapping from the topics in the logs and the names in the rules, and audit nothing.",
)
@options.fail_level
@options.output_format(*FORMATS)
@options.output
@options.max_size
def command(
    logs: tuple[str, ...],
    path: str,
    mapping: str | None,
    scope: Scope,
    tolerance: float | None,
    max_lag: float,
    late: bool,
    state: str | None,
    picture: str | None,
    scheduler: str | None,
    suggest_mapping: bool,
    fail_level: Severity,
    form: str,
    output: str | None,
) -> int:
    """Check that recorded missions followed the rules. LOG is a file of JSON lines, a ROS 2 bag or a Parquet table.
    Each log is one mission.

    A decision that depends on values missing from the log is inconclusive, with exit code 3 if there are no
    findings.
    """
    from sleec_runtime.errors import UnreadableLog
    from sleec_verify.audit.findings import result_of
    from sleec_verify.audit.mission_result import AuditSummary, MissionResult, UnauditedLog
    from sleec_verify.audit.state_file import StateFile
    from sleec_verify.cli.audit_runs import audit_here, audit_on_cluster
    from sleec_verify.files.placement import require_writable

    logs = tuple(dict.fromkeys(logs))
    given = {"--mapping": mapping, "--state": state, "--plot": picture, "--scheduler": scheduler}
    _check_options({name for name, value in given.items() if value is not None}, suggest_mapping, logs)
    written = [name for name in (output, state, picture) if name is not None]
    for name in written:
        require_writable(name, (path, *logs, *([] if mapping is None else [mapping])))
    if len(set(written)) < len(written):
        raise click.UsageError("-o, --state and --plot cannot name the same file")
    if suggest_mapping:
        from sleec_verify.cli.mapping_draft import suggest_mapping as suggest

        return suggest(logs, one_ruleset(path, scope.reading, None), output)
    started = perf_counter()
    try:
        with internal_errors_of(path):
            ruleset = one_ruleset(path, scope.reading, scope.domain)
            settings = _settings(ruleset, mapping, scope, tolerance, max_lag)._replace(late=late)
        saved = None if state is None else StateFile(state, settings)
        if scheduler is None:
            outcomes = audit_here(logs, ruleset, settings, saved, picture)
        else:
            outcomes = audit_on_cluster(scheduler, logs, ruleset, settings)
    except InternalError as error:
        complain(error)
        report([UnusableInput(error.path, error)], form, output)
        return exits.UNUSABLE
    missions = tuple(one for one in outcomes if isinstance(one, MissionResult))
    problems = [one for one in outcomes if isinstance(one, UnauditedLog)]
    unread = [UnusableInput(one.path, UnreadableLog(one.message, one.hint)) for one in problems]
    for unusable in unread:
        complain(unusable.error)
    if not missions:
        report(unread, form, output)
        return exits.UNUSABLE
    if scope.domain is None and not all(mission.entered for mission in missions):
        note_mixed_domains(ruleset)
    result = result_of(missions, ruleset, perf_counter() - started)
    timed = settings.untimed if speaks_of_traces(ruleset) else None
    summary = AuditSummary(missions, settings.tolerance)
    report([CheckedRuleset(ruleset, (result,), timed, audit=summary), *unread], form, output)
    return exits.UNUSABLE if unread else exits.code([result], fail_level)


def _check_options(given: set[str], suggest_mapping: bool, logs: tuple[str, ...]) -> None:
    """Rejects options that exclude each other. Raises click.UsageError."""
    chosen = given | ({"--suggest-mapping"} if suggest_mapping else set())
    for one, others in _EXCLUSIVE.items():
        for other in others:
            if {one, other} <= chosen:
                raise click.UsageError(f"{one} cannot be used with {other}")
    if "--plot" in given and len(logs) > 1:
        raise click.UsageError("--plot shows one mission; name one log")


def _settings(ruleset: Ruleset, mapping: str | None, scope: Scope, tolerance: float | None, max_lag: float) -> Settings:
    from sleec_runtime.model import exact
    from sleec_verify.audit.settings import Settings

    timed = speaks_of_traces(ruleset)
    settings = Settings(
        scope.domain,
        untimed=scope.untimed if timed else "at",
        chains=scope.chains or timed,
        max_lag=exact(max_lag) or 0,
    )
    if mapping is not None:
        settings = settings.with_mapping(mapping, ruleset)
    seconds = exact(tolerance)
    return settings if seconds is None else settings._replace(tolerance=seconds)
