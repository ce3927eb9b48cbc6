"""Tying verdicts to the rules: the oracle makes the formula of a check by what is proved, and judges its refutation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_verify.certificates.theory.oracle import NoAnswer, NotRefuted
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Proved, Refuted

if TYPE_CHECKING:
    from pathlib import Path

    from sleec_runtime.model import Ruleset
    from sleec_verify.certificates.manifest import Evidence
    from sleec_verify.results.finding import CheckResult

MOST_SECONDS = 60.0
"""How long the oracle may take over one question. Many obligations that exclude each other take it long, and chains of
hundreds of hedges."""


@dataclass(frozen=True)
class VerdictBinding:
    """Whether the verdict of a check, as far as it rests on refutations, is proved from the rules as they are read; if
    not, why that was not looked at."""

    check: str
    proved: bool
    reason: str | None = None


class UnboundVerdict(Exception):
    """The verdict of `check` is not what is proved of the rules."""

    def __init__(self, check: str, reason: str) -> None:
        super().__init__(f"the verdict of {check} is not proved for the rules: {reason}")
        self.check = check


RESTING: Mapping[str, tuple[type, ...]] = {
    "conflict": (Proved,),
    "vacuous-conflict": (Proved, Refuted),
    "assumptions": (Refuted,),
    "dead-rule": (Refuted,),
    "dead-hedge": (Refuted,),
    "redundant-rule": (Refuted,),
    "redundant-hedge": (Refuted,),
    "reading": (Proved,),
    "constant-condition": (Refuted,),
    "concern": (Proved,),
    "purpose": (Refuted,),
}
"""The checks, with the verdicts that rest on refutations. `vacuous-conflict` passes over rules that nothing triggers,
so it may rest on some where it is proved. All others say what situations or the text show."""


def bind_verdicts(
    shown: Iterable[Evidence], ruleset: Ruleset, domain: str | None, oracle: Path | None, chains: bool = True
) -> Iterator[VerdictBinding | UnboundVerdict]:
    """Have the oracle prove the verdicts that rest on refutations, in each domain: for each such check how it went.
    Of verdicts that are refuted, the findings are proved."""
    results = [
        one.result
        for one in shown
        if isinstance(one.result.verdict, RESTING.get(one.result.name, ()))
        # Where nothing was refuted, what is proved is read off the text.
        and (one.files or isinstance(one.result.verdict, Refuted))
    ]
    if oracle is None:
        yield from (VerdictBinding(result.name, False, "the oracle is not built (make proofs)") for result in results)
        return
    if results:
        domains = ruleset.domains if domain is None else (domain,)
        parts = {name: ruleset.in_domain(name) for name in domains} or {"": ruleset}
        found = [_in_one_domain(results, name, part, oracle, chains) for name, part in parts.items()]
        for result in results:
            # What is refused in one domain is refused, what is not looked at in one is not proved.
            each = [one[result.name] for one in found]
            yield min(
                each, key=lambda one: (isinstance(one, VerdictBinding), isinstance(one, VerdictBinding) and one.proved)
            )


def _in_one_domain(
    results: Sequence[CheckResult], domain: str, ruleset: Ruleset, oracle: Path, chains: bool
) -> dict[str, VerdictBinding | UnboundVerdict]:
    from sleec_verify.certificates.theory.findings import FOUND, questions
    from sleec_verify.certificates.theory.theory_questions import Theory, not_modelled

    reason = not_modelled(ruleset, chains)
    if reason is not None:
        return {result.name: VerdictBinding(result.name, False, reason) for result in results}
    found: dict[str, VerdictBinding | UnboundVerdict] = {}
    index = RulesetIndex(ruleset)
    with Theory(oracle, ruleset, MOST_SECONDS) as theory:
        for result in results:
            check = result.name
            if check not in FOUND and isinstance(result.verdict, Refuted):
                found[check] = VerdictBinding(check, False, "the theory does not cover parts of conditions")
                continue
            try:
                if check in FOUND:
                    for question in questions(check, result.findings, domain, index, theory.numbered):
                        theory.prove(question)
                else:
                    theory.prove(check)
            except NoAnswer as error:
                found[check] = VerdictBinding(check, False, str(error.message))
            except NotRefuted as error:
                found[check] = UnboundVerdict(check, str(error.message))
            else:
                found[check] = VerdictBinding(check, True)
    return found
