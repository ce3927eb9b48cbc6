"""Ties verdicts to the rules: the oracle (extracted from Coq) builds the formula of a check, and checks its proof."""

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
"""The time limit of the oracle for one question. Many obligations that exclude each other are slow, and so are chains
of hundreds of hedges."""


@dataclass(frozen=True)
class VerdictBinding:
    """Whether the part of a verdict that depends on refutations is proved from the parsed rules. If it was not
    examined, the reason."""

    check: str
    proved: bool
    reason: str | None = None


class UnboundVerdict(Exception):
    """The verdict of `check` differs from what is proved about the rules."""

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
"""The checks, with their verdicts that depend on refutations. `vacuous-conflict` skips rules that nothing triggers, so
it may depend on some if it is proved. The evidence of all other verdicts is situations or the text."""


def bind_verdicts(
    shown: Iterable[Evidence], ruleset: Ruleset, domain: str | None, oracle: Path | None, chains: bool = True
) -> Iterator[VerdictBinding | UnboundVerdict]:
    """Let the oracle prove the verdicts that depend on refutations, in each domain. Returns the result for each such
    check. If a verdict is refuted, the findings are proved. Conflicts over time are never proved: that no response
    complies is not stated about the rules."""
    shown = list(shown)
    yield from (
        VerdictBinding(
            "conflict", False, "that no response complies with the rules is not proved for conflicts over time"
        )
        for one in shown
        if one.result.name == "conflict" and isinstance(one.result.verdict, Refuted) and one.traces
    )
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
