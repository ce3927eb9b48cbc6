"""What is wrong with a text in the DSL that tools of others read all the same."""

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
    "Does the text keep to its own definitions?",
    (
        FindingKind(
            "SLEEC506",
            "error",
            "a label that two rules have",
            "Tools tell of a rule by its label, and some keep only the last rule of each label. The second rule is "
            "called label#2 here, so that both count. The labels of concerns and purposes are read alike.",
            "Give each a label of its own.",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nR1 when Answer then Wait\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nR2 when Answer then Wait\nrule_end\n",
        ),
        FindingKind(
            "SLEEC507",
            "error",
            "a value of another scale",
            "A measure is compared with a value that its scale does not have. Tools that keep the values of all "
            "scales in one table take its place in the other scale, which need not be what is meant.",
            "Write a value of the measure's own scale.",
            _DEFINED + "measure noise: scale(quiet, loud)\ndef_end\nrule_start\n"
            "R1 when Called and ({noise} = high) then Answer\nrule_end\n",
            _DEFINED + "measure noise: scale(quiet, loud)\ndef_end\nrule_start\n"
            "R1 when Called and ({noise} = loud) then Answer\nrule_end\n",
        ),
        FindingKind(
            "SLEEC508",
            "error",
            "a scale that is compared with a number",
            "Tools that keep the values of a scale as numbers read over it: the number stands for the value in that "
            "place, counted from 0, and past the end of the scale the comparison is always true or always false. It "
            "is read so here, too.",
            "Write the value that is meant, by its name.",
            _DEFINED + "constant LIMIT = 20\ndef_end\nrule_start\n"
            "R1 when Called and ({risk} > LIMIT) then Answer\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called and ({risk} > low) then Answer\nrule_end\n",
        ),
        FindingKind(
            "SLEEC519",
            "error",
            "a definition that is repeated",
            "An event, a measure or a constant is defined twice in the same way. The second definition changes nothing "
            "here, but not every tool reads such a text. Two definitions of one name that differ are refused.",
            "Delete one of the two definitions.",
            _DEFINED + "event Called\ndef_end\nrule_start\nR1 when Called then Answer\nrule_end\n",
            _DEFINED + "def_end\nrule_start\nR1 when Called then Answer\nrule_end\n",
        ),
    ),
    _defects,
    scope="text",
)
