"""The evidence for the verdict of a check, and what it does not show.

Whether the oracle ties a verdict to the rules is known only when a certificate is verified (`verdict_binding`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_verify.certificates.manifest import FORMULAS, Evidence, Uncertified
from sleec_verify.results.finding import Proved, Refuted, Unknown
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_verify.certificates.refutation import Disjunction
    from sleec_verify.certificates.trace_evidence import CheckTemplates, CheckTrace
    from sleec_verify.results.finding import CheckResult


BY_REFUTATION = ("conflict", "reading", "concern")
"""The checks that are proved by refutations alone."""


@dataclass(frozen=True)
class CheckEvidence:
    """The verdict of a check, the formulas whose refutations prove it, by the names of their files, the traces that it
    found, and the templates for rules without conflicts. `uncovered` is why the theory in Coq does not cover the
    rules. `timed` says whether some rules need traces."""

    result: CheckResult
    models: int
    formulas: dict[str, Disjunction]
    traces: tuple[CheckTrace, ...] = ()
    templates: tuple[CheckTemplates, ...] = ()
    uncovered: str | None = None
    timed: bool = False

    def shown(self) -> Evidence:
        refuted = sum(formula.questions for formula in self.formulas.values())
        files = (f"{name}.{kind}" for name in self.formulas for kind in ("cnf", "lrat"))
        missing = tuple(_uncertified(self, self.uncovered))
        return Evidence(self.result, refuted, self.models, tuple(files), len(self.traces), missing)

    def dimacs(self, name: str) -> str:
        return self.formulas[name].dimacs(f"what sleec-verify refutes for the check {self.result.name}")


def _uncertified(evidence: CheckEvidence, uncovered: str | None) -> Iterator[Uncertified]:
    """What the evidence of a check does not show. `uncovered` is why the theory in Coq does not cover the rules."""
    verdict = evidence.result.verdict
    if isinstance(verdict, Unknown):
        yield Uncertified("the verdict", f"it is unknown: {verdict.why}")
        return
    refuted = any(formula.questions for formula in evidence.formulas.values())
    if refuted and uncovered is not None:
        yield Uncertified(FORMULAS, uncovered)
    if refuted and evidence.result.name == "constant-condition" and uncovered is None:
        yield Uncertified(FORMULAS, "the theory does not cover parts of conditions")
    if isinstance(verdict, Proved) and evidence.models and not (refuted and evidence.result.name in BY_REFUTATION):
        yield Uncertified("the situations that answer questions", "they are not stored, and --check finds them again")
    if evidence.result.name == "conflict" and isinstance(verdict, Refuted) and evidence.traces:
        yield Uncertified(
            "that no response complies in the situation of a trace",
            "the refuted formula is about the facts that the search takes from the situation",
        )
        yield from _of_rules(evidence)
    if evidence.result.name == "conflict" and isinstance(verdict, Proved) and evidence.timed:
        yield Uncertified(
            "that pending demands, components, free events and induction describe all situations",
            "dominance is proved in Coq, and the other arguments are not",
        )
    if evidence.templates:
        yield from _of_templates(evidence)


def _of_rules(evidence: CheckEvidence) -> Iterator[Uncertified]:
    """The rules of conflicts for which no response complies with all others."""
    found = [trace.found for trace in evidence.traces]
    rules = sum(len({label for label, _ in one.about}) for one in found if one.shows == "conflict")
    missing = rules - sum(one.shows == "response" for one in found)
    if missing:
        yield Uncertified(
            f"that {counted(missing, 'rule')} of {rules} in conflicts over time cannot be left out",
            "the search found no response to the others at once",
        )


def _of_templates(evidence: CheckEvidence) -> Iterator[Uncertified]:
    yield Uncertified(
        "that a template serves all situations that its formula excludes",
        "evaluators confirm one example of each template",
    )
    templates = [template for one in evidence.templates for template in one.found.templates]
    missing = sum(template.example is None for template in templates)
    if missing:
        yield Uncertified(f"{counted(missing, 'template')} of {len(templates)}", "the search found no example at once")
