"""Results of checks that are kept, or else new ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.checks import Progress
    from sleec_verify.cli.cache.store import Cache
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.results.finding import CheckResult


def cache_of_environment() -> Cache | None:
    """The cache that the environment selects. Problems are reported. Raises `SleecError`."""
    from sleec_verify.cli.cache.store import Cache
    from sleec_verify.cli.output import note

    return Cache.of_environment(note)


def results(
    ruleset: Ruleset, scope: Scope, cache: Cache | None, progress: Progress | None = None
) -> tuple[CheckResult, ...]:
    """The results of the checks of a ruleset. What decides is imported only where none are kept."""
    kept = None if cache is None else cache.kept(ruleset, scope)
    if kept is not None:
        return kept
    from sleec_verify.checks import run_checks

    found = run_checks(ruleset, None, scope.domain, progress, scope.untimed, chains=scope.chains)
    if cache is not None:
        cache.keep(ruleset, scope, found)
    return found
