"""Tying verdicts to the rules: the oracle makes the formula of a check by what is proved, and judges its refutation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_verify.finding import Proved
from sleec_verify.theory.oracle import NoAnswer, NotRefuted

if TYPE_CHECKING:
    from pathlib import Path

    from sleec_runtime.model import Ruleset
    from sleec_verify.certificates.manifest import Shown

MOST_SECONDS = 60.0
"""How long the oracle may take over one question. Many obligations that exclude one another take it long, and chains of
hundreds of hedges."""


@dataclass(frozen=True)
class Tied:
    """Whether the verdict of a check is proved, from the rules as they are read; if not, why that was not looked at."""

    check: str
    proved: bool
    reason: str | None = None


class NotTied(Exception):
    """The verdict of `check` is not what is proved of the rules."""

    def __init__(self, check: str, reason: str) -> None:
        super().__init__(f"the verdict of {check} is not what is proved of the rules: {reason}")


def tie(shown: Iterable[Shown], ruleset: Ruleset, domain: str | None, oracle: Path | None) -> Iterator[Tied | NotTied]:
    """Have the oracle prove the verdicts that rest on refutations, in each domain: for each such check how it went."""
    checks = list(_to_tie(shown))
    if oracle is None:
        yield from (Tied(check, False, "the oracle is not built (make proofs)") for check in checks)
        return
    if checks:
        domains = ruleset.domains if domain is None else (domain,)
        parts = [ruleset.in_domain(name) for name in domains] or [ruleset]
        found = [_in_one_domain(checks, part, oracle) for part in parts]
        for check in checks:
            # What is refused in one domain is refused, what is not looked at in one is not proved.
            each = [one[check] for one in found]
            yield min(each, key=lambda one: (isinstance(one, Tied), isinstance(one, Tied) and one.proved))


def _to_tie(shown: Iterable[Shown]) -> Iterator[str]:
    """The checks that are proved, by a proof."""
    from sleec_verify.theory.proving import WHATS

    by_name = {one.result.name: one for one in shown}
    for check in WHATS:
        if isinstance(by_name[check].result.verdict, Proved) and by_name[check].files:
            yield check


def _in_one_domain(checks: Sequence[str], ruleset: Ruleset, oracle: Path) -> dict[str, Tied | NotTied]:
    from sleec_verify.theory.proving import Theory, not_modelled

    reason = not_modelled(ruleset)
    if reason is not None:
        return {check: Tied(check, False, reason) for check in checks}
    found: dict[str, Tied | NotTied] = {}
    with Theory(oracle, ruleset, MOST_SECONDS) as theory:
        for check in checks:
            try:
                theory.prove(check)
            except NoAnswer as error:
                found[check] = Tied(check, False, str(error.message))
            except NotRefuted as error:
                found[check] = NotTied(check, str(error.message))
            else:
                found[check] = Tied(check, True)
    return found
