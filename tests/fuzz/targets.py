"""What is fuzzed, by name: a function from bytes, the inputs to begin with, and words that inputs are made of."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from sleec_runtime.language.dsl import keywords as dsl
from sleec_runtime.language.english import keywords
from tests.fuzz import audits, certificates, changes, files, made, messages, pending, python, questions, rules, wire
from tests.fuzz.property import cpu_limit
from tests.support.paths import ROOT

CORPUS = Path(__file__).with_name("corpus")
"""A folder for each target, with the inputs that once reached something new, or failed."""


class Target(NamedTuple):
    """`run` takes an input and a folder to write to; it raises where its property fails. `seeds` and `words` are
    where the fuzzer begins. Inputs are at most `max_bytes` long."""

    run: Callable[[bytes, Path], None]
    seeds: Callable[[], Iterable[bytes]]
    words: Iterable[str] = ()
    max_bytes: int = 2048


def run(target: Target, data: bytes, folder: Path) -> None:
    """Raises whatever shows that the property does not hold of this input; `folder` may be written to."""
    with cpu_limit():
        target.run(data, folder)


def corpus(name: str) -> list[Path]:
    """The kept inputs of a target."""
    return sorted((CORPUS / name).glob("*"))


def _blocks(kind: str, *patterns: str) -> Iterator[bytes]:
    """The blocks of this kind in the documents below the root."""
    block = re.compile(rf"^```{kind}\b[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    for path in _paths(patterns):
        yield from (found.encode() for found in block.findall(path.read_text(encoding="utf-8")))


def _files(*patterns: str) -> Iterator[bytes]:
    return (path.read_bytes() for path in _paths(patterns))


def _paths(patterns: Iterable[str]) -> Iterator[Path]:
    return (path for pattern in patterns for path in sorted(ROOT.glob(pattern)))


def _deep(before: str, opening: str) -> Iterator[bytes]:
    """Nesting that is too deep for a recursive reader; the fuzzer does not come upon it soon."""
    yield from (before.encode() + opening.encode() * (count // len(opening)) for count in (100, 2000))


_DOCS = ("README.md", "docs/*.md", "docs/tutorials/*.md")


def _english() -> Iterator[bytes]:
    yield from _blocks("sleec", *_DOCS)
    yield from _files("rulesets/*.sleec", "tests/fast/language/bad/*.sleec")
    yield from _deep("WHEN a THEN b UNLESS ", "(")


def _dsl() -> Iterator[bytes]:
    yield from _blocks("dsl", *_DOCS)
    yield from _files("tests/fast/language/bad/dsl-*.sleec")
    yield from _deep("def_start event A def_end rule_start R when A and ", "{")


def _python() -> Iterator[bytes]:
    yield from _blocks("python", *_DOCS)
    yield from _files("examples/*.py")
    yield from python.seeds()
    yield from _deep("x = ", "-")
    yield from _deep("x", ".a")


def _configuration() -> Iterator[bytes]:
    yield from _blocks("toml", *_DOCS)
    yield from _deep("rulesets = ", "[")
    yield from _deep("block = ", "{a=")


_ENGLISH_WORDS = sorted(
    {*keywords.KEYWORDS, *keywords.RELATION_WORDS, "BY", "TO", "5 minutes", "<=", "!=", "true", "1.5", "-3", "cascade"}
    | {"MEASURE m: number", "MEASURE s: low < high", "IN WHICH CASE", "# sleec: allow SLEEC202 because x"}
)
_DSL_WORDS = sorted(
    {*dsl.KEYWORDS, *dsl.EVENT_RELATIONS, *dsl.EFFECTS, "boolean", "numeric", "scale(a, b)", "{m}", "<=", "<>", "=>"}
    | {"minutes", "seconds", "imply", "iff", "opposite", "invariant"}
)
_TOML_WORDS = ("[[", "]]", '"""', "'''", "= true", "{ a = 1 }", "1e400", "nan", "1979-05-27", "\\u00e9")
_CONFIGURATION_WORDS = (
    *_TOML_WORDS,
    *("[tool.sleec-verify]", "[block]", "[[targets]]", '"never"', "rulesets", "assertions", "baseline", "code"),
    *("clause-coverage", "lost-obligations", "new-conflicts"),
)
_CASES_WORDS = (
    *_TOML_WORDS,
    *("[[case]]", "when", "given", "obligations", "prohibitions", "reaches", "conflict", "domain", "1/3"),
    *("Ring", "Open", "Close", "Age", "Steps", "Risk", "LegalAge", "middle", "the night begins"),
)
_SITUATION_WORDS = ("Ring", "not ", "Age=", "Steps=", "Risk=", "LegalAge", "true", "too warm", "1.5")
_ASSERTION_WORDS = ("never ", "always ", " when ", " and ", " or ", "not ", "Open", "Close", "Age", "Risk", "LegalAge")
_JSON_WORDS = ('{"', '":', "null", "true", "[]", "{}", "1e400", "NaN", "-0", "\\ud800", '"a": 1, ')
_LOG_WORDS = (
    *_JSON_WORDS,
    *('{"time": ', '"event": "Ring"', '"executed": "Open"', '"conditions": ', '"domain": "home"', '"topic": "/ring"'),
    *('"message": ', '"Age": 1.5', '"Dark": true', '"Fall"', '"Close"', "\n"),
)
_MAPPING_WORDS = (
    *("[conditions]", "[measures]", "[events]", "[obligations]", "topic", "field", "scale", "offset", "above", "below"),
    *("until", "equals", "values", "each", "action", "goal", "Ring", "Age", "Risk", "Dark", "Open"),
)
_SNAPSHOT_WORDS = (*_JSON_WORDS, '"otherwise"', '"else"', '"waiting"', '"under way"', '"in force"', '"1/3"')
_LITERAL_WORDS = ("None", "('", "()", "{'", "b''", "1e400", "-1", "1j", "...")
_PROOF_WORDS = ("p cnf ", " 0 ", " d ", "c ")
_PYTHON_WORDS = (
    *("import contextpy3 as cop\n", "@cop.base\n", "@cop.around(", "sleec.layers['dress_assist.hc1']"),
    *("@sleec.rule('dress_assist')", "self.open_curtains()", "sleec.bind(", "sleec.implement(", "lambda: "),
    *("# -*- coding: ", "global x", "async def ", "match x:\n case {**y}:\n"),
)

TARGETS: Mapping[str, Target] = {
    "english": Target(rules.language, _english, _ENGLISH_WORDS),
    "dsl": Target(rules.language, _dsl, _DSL_WORDS),
    "check": Target(rules.check, _english, _ENGLISH_WORDS, 1024),
    "entail": Target(questions.entailment, lambda: (*_english(), *_dsl()), (*_ENGLISH_WORDS, *_DSL_WORDS), 1024),
    "made": Target(made.made, _english, _ENGLISH_WORDS, 1024),
    "diff": Target(changes.diff, changes.seeds, (*_ENGLISH_WORDS, changes.SEPARATOR.decode()), 1024),
    "configuration": Target(files.configuration, _configuration, _CONFIGURATION_WORDS),
    "cases": Target(files.cases, lambda: (*files.cases_seeds(), *_deep("case = ", "[")), _CASES_WORDS),
    "baseline": Target(files.baseline, lambda: (*files.baseline_seeds(), *_deep("", "[")), _JSON_WORDS),
    "cache": Target(
        files.cache, lambda: (*files.cache_seeds(), *_deep("", "("), *_deep("", "-")), _LITERAL_WORDS, 4096
    ),
    "situation": Target(questions.situation, questions.situation_seeds, _SITUATION_WORDS),
    "assertions": Target(
        questions.assertions, lambda: (*questions.assertion_seeds(), *_deep("never Open when ", "(")), _ASSERTION_WORDS
    ),
    "manifest": Target(
        certificates.manifest, lambda: (*certificates.manifest_seeds(), *_deep("", "[")), _JSON_WORDS, 8192
    ),
    "proof": Target(certificates.proof, certificates.proof_seeds, _PROOF_WORDS),
    "elaboration": Target(certificates.elaboration, certificates.elaboration_seeds, (), 256),
    "message": Target(messages.message, messages.seeds, (*_JSON_WORDS, *messages.KINDS), 4096),
    "cdr": Target(wire.cdr, wire.cdr_seeds, (), 512),
    "snapshot": Target(pending.snapshot, pending.snapshot_seeds, _SNAPSHOT_WORDS, 4096),
    "log": Target(audits.log, lambda: (*audits.log_seeds(), *_deep("", "[")), _LOG_WORDS),
    "mapping": Target(audits.mapping, audits.mapping_seeds, (*_TOML_WORDS, *_MAPPING_WORDS)),
    "audit": Target(audits.state, audits.state_seeds, _JSON_WORDS, 4096),
    "python": Target(python.python, _python, _PYTHON_WORDS),
}
