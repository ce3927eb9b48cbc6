"""Repairs of a conflict by rule decomposition (SLEEC-PATCH, 2026): only a part of a response gives way."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Ruleset
from sleec_verify.encoding.equation import conjunction
from sleec_verify.repairs.clause_names import rule_name
from sleec_verify.repairs.edit import joined
from sleec_verify.repairs.operators.conditions import negation
from sleec_verify.repairs.operators.giving_way import yieldings
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import without_obligations
from sleec_verify.repairs.statement_insertion import new_label, rule_text, with_rule_after
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def decompositions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The part of a response that the others contradict becomes a rule, which does not apply where they decide."""
    for one in yieldings(ruleset, finding):
        contradicted = [o for o in one.clause.obligations if o.name in finding.obligations]
        rest = without_obligations(ruleset, one.clause, contradicted)
        if one.rule.always is not None or one.rule.hedges or len(contradicted) != 1 or rest is None:
            continue
        for condition in one.conditions[:1]:
            negated = negation(condition)
            guard = negated if one.rule.guard is None else conjunction([one.rule.guard, negated])
            label = new_label(ruleset, f"{one.rule.label}_part")
            lines = rule_text(ruleset, label, one.rule.trigger, guard, contradicted[0])
            moved, new = quoted(str(contradicted[0])), quoted(" ".join(lines))
            title = sentence(
                "split {rule}: move {moved} to {new}", rule=rule_name(ruleset, one.rule), moved=moved, new=new
            )
            edits = joined((*rest, *with_rule_after(ruleset, one.rule, lines)))
            yield Candidate("rule-decomposition", title, edits, one.rule.label)
