"""Write the baseline of the gate: all current findings."""

from __future__ import annotations

import os
from collections.abc import Sequence, Set
from typing import TYPE_CHECKING

import click

from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import read_file
from sleec_verify.changes.gate import baseline_text, findings_now, no_baseline, read_baseline
from sleec_verify.cli import exits
from sleec_verify.cli.output import tell
from sleec_verify.files.placement import require_writable, write_whole
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_verify.changes.gate import Check, Config, Key
    from sleec_verify.changes.revisions.single_file import Tree


def write_baseline(now: Tree, config: Config, paths: Sequence[str], file: str | None, check: Check) -> int:
    """Write the current findings to `file`, or to the baseline of `config`. With `paths`, entries of other rulesets are
    kept.

    Raises:
        SleecError: a file cannot be read or written.
    """
    if file is None and config.baseline is None:
        raise click.UsageError("name the baseline file: --baseline FILE, or baseline in the configuration")
    target = file or now.repository.here(config.at(config.baseline or ""))
    require_writable(target, ())
    before = _before(target)
    places = now.repository.now(paths or [now.called(config.at(one)) for one in config.rulesets])
    keys = findings_now(places, config.targets, check, now.repository.here)
    if paths:
        about = {*places, *(one.code for one in config.targets)}
        keys |= {one for one in before if one[0] not in about}
    write_whole(target, baseline_text(keys).encode())
    tell(f"{target}: {counted(len(keys), 'finding')}")
    return exits.HOLDS


def _before(target: str) -> Set[Key]:
    """What the file holds already: only a baseline is replaced by one."""
    return known_findings(target) if os.path.lexists(target) else frozenset()


def known_findings(file: str) -> Set[Key]:
    """The findings of a baseline file.

    Raises:
        SleecError: it cannot be read, or is not a baseline.
    """
    try:
        return read_baseline(read_file(file), file)
    except FileNotFoundError:
        raise no_baseline(file) from None
    except OSError as error:
        raise SleecError(f"{file} cannot be read: {error.strerror}") from None
