"""Checks rules and keeps the evidence for each verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING

from sleec_runtime.certificate.coverage import Use
from sleec_runtime.certificate.manifest import Required
from sleec_verify.certificates.check_evidence import CheckEvidence
from sleec_verify.certificates.conflict_freedom import conflict_free
from sleec_verify.certificates.manifest import Evidence, manifest
from sleec_verify.certificates.recorder import RecordedQuestion, Recorder
from sleec_verify.certificates.refutation import Disjunction, disjunctions
from sleec_verify.certificates.theory.theory_questions import not_modelled
from sleec_verify.certificates.trace_evidence import TEMPLATES, TRACES, CheckTemplates, CheckTrace, file_text
from sleec_verify.checks import Checking, checks_for
from sleec_verify.encoding.trace_scope import speaks_of_traces
from sleec_verify.query.question import is_possible
from sleec_verify.results.finding import Proved, Unknown
from sleec_verify.traces.partition import partition_of

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.query.ruleset_index import RulesetIndex
    from sleec_verify.results.finding import CheckResult
    from sleec_verify.results.json_values import Json


NOTHING_REQUIRED = Required()


@dataclass(frozen=True)
class Certificate:
    """The content of the folder: the manifest, and every other file by its name. `use` is the use that it covers."""

    use: Use
    required: Required
    shown: tuple[Evidence, ...]
    manifest: dict[str, Json]
    files: dict[str, str]

    @property
    def results(self) -> tuple[CheckResult, ...]:
        return tuple(one.result for one in self.shown)

    def contents(self) -> Iterator[tuple[str, bytes]]:
        """Every file, the manifest last."""
        from sleec_runtime.certificate.coverage import MANIFEST
        from sleec_runtime.certificate.manifest import canonical

        yield from ((name, text.encode()) for name, text in self.files.items())
        yield MANIFEST, canonical(self.manifest)


def certify(
    ruleset: Ruleset,
    domain: str | None = None,
    untimed: Untimed = "at",
    progress: Callable[[str, int, int], None] | None = None,
    required: Required = NOTHING_REQUIRED,
    chains: bool = True,
) -> Certificate:
    """Run every check of the ruleset, as `run_checks` does. Then refute the unsatisfiable questions again, with proofs.
    `domain` applies to rules that have domains. `required` is written to the manifest; `check_certificate` decides
    whether it holds."""
    if not ruleset.domains:
        domain = None
    shown, files = [], {}
    traces: list[CheckTrace] = []
    templates: list[CheckTemplates] = []
    for rebuilt in rebuild(ruleset, domain, untimed, progress, chains=chains):
        shown.append(rebuilt.shown())
        for name, formula in rebuilt.formulas.items():
            files[f"{name}.cnf"] = rebuilt.dimacs(name)
            files[f"{name}.lrat"] = formula.lrat()
        traces += rebuilt.traces
        templates += rebuilt.templates
    for name, entries in ((TRACES, traces), (TEMPLATES, templates)):
        if entries:
            files[name] = file_text(entries)
    digests = {name: sha256(text.encode()).hexdigest() for name, text in files.items()}
    meaning = untimed if speaks_of_traces(ruleset) else None
    whole = manifest(ruleset, domain, meaning, chains, required, shown, digests)
    return Certificate(Use(ruleset.reading, domain, untimed, chains), required, tuple(shown), whole, files)


def rebuild(
    ruleset: Ruleset,
    domain: str | None,
    untimed: Untimed,
    progress: Callable[[str, int, int], None] | None = None,
    examining: bool = False,
    chains: bool = True,
) -> Iterator[CheckEvidence]:
    """The verdicts, computed from the text of the rules, with the formulas to refute. With `examining`, every model of
    a solver is checked."""
    recorder = Recorder(examining)
    checking = Checking(ruleset, domain, untimed, recorder, chains=chains)
    for index in (checking.whole, *checking.by_domain.values()):
        _ask_what_is_possible(index)
    assumed, models = recorder.take()
    recorder.take_traces()
    domains = {id(index.ruleset): (domain, index) for domain, index in checking.by_domain.items()}
    reasons = (not_modelled(index.ruleset, chains) for index in checking.by_domain.values())
    uncovered = "; ".join(dict.fromkeys(filter(None, reasons))) or None
    timed = any(partition_of(index).traces is not None for index in checking.by_domain.values())
    names = checks_for(ruleset)
    for done, name in enumerate(names):
        if progress is not None:
            progress(name, done, len(names))
        result = checking.result(name)
        asked, found = recorder.take()
        traces = tuple(CheckTrace(name, *domains[id(one.ruleset)], one) for one in recorder.take_traces())
        templates = tuple(CheckTemplates(name, *domains[id(one.ruleset)], one) for one in recorder.take_free())
        if name == "assumptions":
            asked, found = assumed + asked, models + found
        if name == "conflict":
            asked = _conflict(checking, recorder, result, asked, timed)
        if isinstance(result.verdict, Unknown):
            asked, traces, templates = [], (), ()
        formulas = _named(name, asked, name == "conflict" and isinstance(result.verdict, Proved))
        yield CheckEvidence(result, found, formulas, traces, templates, uncovered, timed)


def _ask_what_is_possible(index: RulesetIndex) -> bool:
    """Whether any situation is possible. Asked first, so that it is not part of the first check that needs it."""
    return not index.assumptions or is_possible(index)


def _conflict(
    checking: Checking, recorder: Recorder, result: CheckResult, asked: list[RecordedQuestion], timed: bool
) -> list[RecordedQuestion]:
    if not isinstance(result.verdict, Proved):
        # Its findings have witnesses, and that there are no further causes is not claimed. That no response complies
        # with the rules of a conflict is refuted.
        return [one for one in asked if any(one.questions.values())]
    if timed:
        return asked
    free = [conflict_free(partition_of(index).situations) for index in checking.by_domain.values()]
    assert all(free), "no cause of a conflict was found"
    return recorder.take()[0]


def _named(name: str, asked: list[RecordedQuestion], always: bool) -> dict[str, Disjunction]:
    """The formulas by the names of their files. With `always`, there is one even without questions."""
    if not asked and not always:
        return {}
    formulas = list(disjunctions(asked))
    if len(formulas) == 1:
        return {name: formulas[0]}
    return {f"{name}-{number}": formula for number, formula in enumerate(formulas, 1)}
