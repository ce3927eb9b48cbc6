"""Defects of a text in the DSL that other tools accept."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding

_KINDS = {"repeated-label": 0, "foreign-value": 1, "number-as-value": 2, "repeated-definition": 3}


def _defects(index: RulesetIndex) -> Iterator[Finding]:
    for defect in index.ruleset.defects:
        yield DEFECTS.finding(defect.message, defect.span, kind=_KINDS[defect.kind], help=defect.help)


_DEFINED = "def_start\nevent Called\nevent Answer\nevent Wait\nmeasure risk: scale(low, high)\n"

DEFECTS = Check(
    "defect",
    "Does the text agree with its own definitions?",
    (
        FindingKind(
            "SLEEC506",
            "error",
            "a label that two rules share",
            "Tools identify a rule by its label, and some keep only the last rule with a label. In the DSL, "
            "sleec-verify keeps both, and calls the second one label#2. The same holds for the labels of concerns and "
            "purposes. Structured English with such a label is rejected.",
            "Give each rule its own label.",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nR1 when Answer then Wait\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nR2 when Answer then Wait\nrule_end\n",
        ),
        FindingKind(
            "SLEEC507",
            "error",
            "a value of another scale",
            "In the DSL, a measure is compared with a value that is not on its scale. Tools that keep the values "
            "of all scales in one table use the position of the value on its own scale. This is probably not what you "
            "mean.",
            "Use a value of the measure's own scale.",
            _DEFINED + "measure noise: scale(quiet, loud)\ndef_end\nrule_start\n"
            "R1 when Called and ({noise} = high) then Answer\nrule_end\n",
            _DEFINED + "measure noise: scale(quiet, loud)\ndef_end\nrule_start\n"
            "R1 when Called and ({noise} = loud) then Answer\nrule_end\n",
        ),
        FindingKind(
            "SLEEC508",
            "error",
            "a scale that is compared with a number",
            "In the DSL, a scale is compared with a number. Tools that store the values of a scale as numbers accept "
            "this: the number means the value at that position, counted from 0. If there is no such position, the "
            "comparison is always true or always false. sleec-verify evaluates it in the same way, and reports this "
            "error.",
            "Write the name of the value that you mean.",
            _DEFINED + "constant LIMIT = 20\ndef_end\nrule_start\n"
            "R1 when Called and ({risk} > LIMIT) then Answer\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called and ({risk} > low) then Answer\nrule_end\n",
        ),
        FindingKind(
            "SLEEC519",
            "error",
            "a definition that is repeated",
            "In the DSL, an event, a measure or a constant is defined twice in the same way. The second definition has "
            "no effect, but some tools reject the text. sleec-verify rejects a text with two different definitions of "
            "one name.",
            "Delete one of the two definitions.",
            _DEFINED + "event Called\ndef_end\nrule_start\nR1 when Called then Answer\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nrule_end\n",
        ),
    ),
    _defects,
    scope="text",
)
