"""Whole rulesets in the DSL: nothing of them is dropped, and they are printed back."""

from __future__ import annotations

import re
from pathlib import Path

from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import claims, literals
from tests.support.studies import each_dsl_study

OF_SLEEC_TK = {"canteen-server", "library-porter", "parcel-drone", "parcel-drone-revised"}


@each_dsl_study
def test_nothing_of_a_study_is_dropped(path: Path) -> None:
    ruleset = load(path)
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    blocks = dict(re.findall(r"\b(\w+)_start\b(.*?)\b\1_end\b", text, flags=re.DOTALL))

    def count(block: str, pattern: str) -> int:
        return len(re.findall(pattern, blocks.get(block, "")))

    assert len(ruleset.rules) == count("rule", r"\w+\s+when\b")
    clauses = [clause for rule in ruleset.rules for clause in rule.clauses()]
    alternatives = [a for clause in clauses for o in clause.obligations if o.timing for a in o.timing.alternatives()]
    hedges = [c for c in clauses if c.condition is not None] + [h for a in alternatives for h in a.hedges]
    assert len(hedges) == count("rule", r"\bunless\b")
    times = [o.timing for clause in clauses for o in literals(clause) if o.timing is not None]
    windows = [time.window for time in times if time.window is not None]
    assert len([w for w in windows if w.end is not None]) == count("rule", r"\bwithin\b")
    assert len([w for w in windows if w.end is None]) == count("rule", r"\beventually\b")
    assert len([time for time in times if time.otherwise is not None]) == count("rule", r"\botherwise\b")
    assert ruleset.declared["event"] == set(re.findall(r"\bevent\s+(\w+)", blocks["def"]))
    assert len(ruleset.measures) + len(ruleset.declared["condition"]) == count("def", r"\bmeasure\s")
    assert len(ruleset.constants) == count("def", r"\bconstant\s")
    for kind in ("concern", "purpose"):
        found = claims(ruleset, kind)
        assert len(found) == count(kind, r"\w+\s+(?:when|exists)\b")
        assert sum(len(claim.responses) for claim in found) == count(kind, r"\b(?:then|while)\b")
    assert ruleset.dialect == ("sleec-tk" if path.parent.name == "sleec-tk" or path.stem in OF_SLEEC_TK else "legos")


@each_dsl_study
def test_a_study_is_printed_back(path: Path) -> None:
    ruleset = load(path)
    text = print_ruleset(ruleset)
    again = parse(text)
    assert again == ruleset
    assert print_ruleset(again) == text

    def words(source: str) -> list[str]:
        comments = re.findall(r"//([^\n]*)|/\*(.*?)\*/", source, flags=re.DOTALL)
        return sorted(word for pair in comments for half in pair for word in re.findall(r"\w+", half))

    assert words(text) == words(path.read_text(encoding="utf-8"))
