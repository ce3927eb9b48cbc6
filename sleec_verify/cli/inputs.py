"""From the paths on the command line to rulesets."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.language import load
from sleec_runtime.language.suggest import nearest
from sleec_verify.report.outcome import Unusable

if TYPE_CHECKING:
    from sleec_runtime.model import Reading, Ruleset

SUFFIX = ".sleec"


class UnknownDomain(SleecError):
    """A domain that no ruleset names."""


def files(paths: Iterable[str]) -> Iterator[str | Unusable]:
    """The files that `paths` mean: a folder stands for every ``*.sleec`` below it, sorted. None comes twice."""
    seen = set()
    for path in paths:
        found = _below(path) if os.path.isdir(path) else [path]
        if not found:
            yield Unusable(path, UnreadableFile(f"there is no {SUFFIX} file below {path}", "name a file"))
        for file in found:
            if file not in seen:
                seen.add(file)
                yield file


def _below(folder: str) -> list[str]:
    return sorted(
        os.path.join(parent, name) for parent, _, names in os.walk(folder) for name in names if name.endswith(SUFFIX)
    )


def rulesets(paths: Iterable[str], reading: Reading | None, domain: str | None) -> list[Ruleset | Unusable]:
    """Each ruleset below `paths`, in `reading` if one is asked for, or what is wrong with it.

    Raises:
        UnknownDomain: the rulesets have domains, and none of them is `domain`.
    """
    found = [path if isinstance(path, Unusable) else _load(path, reading) for path in files(paths)]
    if domain is not None:
        named = {name for one in found if not isinstance(one, Unusable) for name in one.domains}
        if named and domain not in named:
            raise _unknown_domain(domain, sorted(named))
    return found


def one_ruleset(path: str, reading: Reading | None, domain: str | None) -> Ruleset:
    """The one ruleset in the file at `path`.

    Raises:
        UnreadableFile, LanguageError: it is not a ruleset.
        UnknownDomain: it has domains, and none of them is `domain`.
    """
    ruleset = load(path)
    if domain is not None and ruleset.domains and domain not in ruleset.domains:
        raise _unknown_domain(domain, ruleset.domains)
    return ruleset if reading is None else ruleset.read_as(reading)


def _load(path: str, reading: Reading | None) -> Ruleset | Unusable:
    try:
        return one_ruleset(path, reading, None)
    except SleecError as error:
        return Unusable("<stdin>" if path == "-" else path, error)


def _unknown_domain(domain: str, named: Sequence[str]) -> UnknownDomain:
    near = nearest(domain, named)
    hint = f"did you mean {near}?" if near else f"there are {', '.join(named)}"
    return UnknownDomain(f"there is no domain {domain}", hint)
