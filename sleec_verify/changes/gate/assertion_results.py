"""Checks assertions for the rulesets that they are about."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Atom, Ruleset, Source, leaves, measures_of
from sleec_verify.changes.gate.result import GateResult, RulesetExamination
from sleec_verify.results.internal_error import InternalError, internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.errors import Problem
    from sleec_verify.changes.assertions.assertion import Assertion, AssertionResult
    from sleec_verify.changes.assertions.vocabulary import Vocabulary


class AssertionSources:
    """The assertions of the configuration and the command line, as texts, with the content of assertion files."""

    def __init__(self, texts: Sequence[str] = (), sources: Sequence[Source] = ()) -> None:
        self.texts = texts
        self.sources = sources

    def __bool__(self) -> bool:
        return bool(self.texts or self.sources)


class RulesetVersions(NamedTuple):
    """A ruleset in its current version and in that of the base."""

    new: Ruleset
    old: Ruleset


def verify_assertions(
    found: GateResult, asked: Sequence[RulesetVersions], asserting: AssertionSources
) -> tuple[AssertionResult, ...]:
    """The answers. An assertion is checked for each ruleset that uses one of its names, now or in the base. A
    deleted ruleset obliges nothing."""
    from sleec_runtime.errors import LanguageError
    from sleec_verify.changes.assertions.parser import parse_assertion, parse_assertions
    from sleec_verify.changes.assertions.verification import verify
    from sleec_verify.changes.assertions.vocabulary import Vocabulary

    vocabulary = Vocabulary(side for sides in asked for side in sides)
    said: list[Assertion] = []
    for text in asserting.texts:
        said.append(parse_assertion(text, vocabulary, "assertion"))
    problems: list[tuple[Source, tuple[Problem, ...]]] = []
    for source in asserting.sources:
        try:
            said += parse_assertions(source, vocabulary)
        except LanguageError as error:
            problems.append((source, error.problems))
    if problems:
        raise LanguageError(*problems[0])
    answers = []
    for new, old in asked:
        path = found.paths[new.source.path]
        try:
            with internal_errors_of(path):
                known = _names(Vocabulary((new, old)))
                answers += [verify(new, one, known=vocabulary) for one in said if not known.isdisjoint(_names_in(one))]
        except InternalError as error:
            examined = next((one for one in found.examined if one.path == path), None)
            if examined is None:
                found.examined.append(examined := RulesetExamination(path))
            examined.errors.append(error)
    return tuple(answers)


def _names(vocabulary: Vocabulary) -> set[str]:
    return {*vocabulary.triggers, *vocabulary.conditions, *vocabulary.obligations, *vocabulary.measures}


def _names_in(assertion: Assertion) -> set[str]:
    names = {literal.name for literal in assertion.literals}
    for leaf in leaves(assertion.when):
        names.update((leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf))
    return names
