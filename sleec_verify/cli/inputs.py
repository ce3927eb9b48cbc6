"""Rulesets for the paths on the command line."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.language import load
from sleec_runtime.support.suggestions import nearest
from sleec_verify.cli.output import note, note_link
from sleec_verify.files.folders import SUFFIX, rulesets_below
from sleec_verify.report.outcome import UnusableInput
from sleec_verify.results.internal_error import internal_errors_of
from sleec_verify.wording.phrases import listed, quoted, shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Reading, Ruleset


class UnknownDomain(SleecError):
    """A domain that no ruleset has."""


def files(paths: Iterable[str], skipped: Callable[[str], None] = lambda _: None) -> Iterator[str | UnusableInput]:
    """The files of `paths`, each once. A folder means all ``*.sleec`` files below it, sorted. `skipped` is called for
    each link that is not followed."""
    seen = set()
    for path in paths:
        closed: list[UnusableInput] = []
        found = _below(path, closed, skipped) if os.path.isdir(path) else [path]
        yield from closed
        if not found and not closed:
            yield UnusableInput(path, UnreadableFile(f"there is no {SUFFIX} file below {path}", "name a file"))
        for file in found:
            if file not in seen:
                seen.add(file)
                yield file


def _below(folder: str, closed: list[UnusableInput], skipped: Callable[[str], None]) -> list[str]:
    """The texts of rules below `folder`; the folders that may not be read go to `closed`."""

    def tell(error: OSError) -> None:
        place = os.fspath(error.filename)
        closed.append(UnusableInput(place, UnreadableFile(f"the folder {place} cannot be read: {error.strerror}")))

    return rulesets_below(folder, tell, skipped)


def rulesets(paths: Iterable[str], reading: Reading | None, domain: str | None) -> list[Ruleset | UnusableInput]:
    """Each ruleset below `paths`, in `reading` if one is asked for, or what is wrong with it.

    Raises:
        UnknownDomain: the rulesets have domains, and none of them is `domain`.
    """
    found = [path if isinstance(path, UnusableInput) else _load(path, reading) for path in files(paths, note_link)]
    if domain is not None:
        named = {name for one in found if not isinstance(one, UnusableInput) for name in one.domains}
        if named and domain not in named:
            raise unknown_domain(domain, sorted(named))
        if not named and any(not isinstance(one, UnusableInput) for one in found):
            _note_no_domains(domain)
    return found


def one_ruleset(path: str, reading: Reading | None, domain: str | None) -> Ruleset:
    """The one ruleset in the file at `path`.

    Raises:
        UnreadableFile, LanguageError: it is not a ruleset.
        UnknownDomain: it has domains, and none of them is `domain`.
    """
    with internal_errors_of(path):
        ruleset = load(path)
    if domain is not None and ruleset.domains and domain not in ruleset.domains:
        raise unknown_domain(domain, ruleset.domains)
    if domain is not None and not ruleset.domains:
        _note_no_domains(domain)
    return ruleset if reading is None else ruleset.read_as(reading)


def note_mixed_domains(ruleset: Ruleset) -> None:
    """Write a note if rules of several domains are combined because --domain is missing."""
    if len(ruleset.domains) > 1:
        note(f"the rules of the domains {listed(ruleset.domains)} are combined; choose one domain with --domain")


def _note_no_domains(domain: str) -> None:
    note(f"no rule has a domain, so all rules apply in {quoted(shortened(domain))}")


def _load(path: str, reading: Reading | None) -> Ruleset | UnusableInput:
    try:
        return one_ruleset(path, reading, None)
    except SleecError as error:
        return UnusableInput("<stdin>" if path == "-" else path, error)


def unknown_domain(domain: str, named: Sequence[str]) -> UnknownDomain:
    """The error for a domain that is not one of `named`."""
    near = nearest(domain, named)
    hint = f"did you mean {quoted(near)}?" if near else f"the domains are {', '.join(named)}"
    return UnknownDomain(f"no domain is called {quoted(shortened(domain))}", hint)
