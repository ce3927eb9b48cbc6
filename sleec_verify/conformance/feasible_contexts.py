"""Contexts that satisfy the assumptions, as close as possible to given ones."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from sleec_runtime.model import Context, Ruleset, Value
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex

EVERYTHING: frozenset[str] = frozenset()


class Assumptions:
    """The assumptions of a ruleset as one question, for any number of contexts."""

    def __init__(self, ruleset: Ruleset) -> None:
        index = RulesetIndex(ruleset)
        self._question: Question | None = None
        if index.assumptions:
            self._question = Question(index, assuming=False)
            for assumption in index.assumptions:
                self._question.require_formula(assumption.formula)

    def nearest(self, context: Context, fixed: Collection[str] = EVERYTHING) -> Context | None:
        """A context that satisfies the assumptions, close to `context`, and equal to it in the names that are `fixed`.

        None if there is none. Fixed names that the assumptions do not mention keep their values.
        """
        question = self._question
        if question is None:
            return context
        wanted = self._literals(question, context)
        firm = {literal for literal, name in wanted.items() if name in fixed}
        soft = [literal for literal in wanted if literal not in firm]
        # The refusals of an order add clauses, and so does nothing else: each literal is given up once at most.
        while not question.ask(*firm, *soft):
            given_up = [literal for literal in question.core() if literal not in firm]
            if not given_up:
                return None
            soft.remove(given_up[-1])
        return self._merged(question, context, [literal for literal in wanted if not question.true(literal)], wanted)

    def _literals(self, question: Question, context: Context) -> dict[int, str]:
        encoder = question.encoder
        found: dict[int, str] = {}
        for (kind, name, *_), variable in encoder.variables.items():
            if kind == "trigger":
                found[variable if name in context.triggers else -variable] = name
            elif kind == "condition":
                found[variable if context.conditions.get(name) is True else -variable] = name
        for measure in encoder.measures.measures():
            value = context.conditions.get(measure)
            if value is not None and not isinstance(value, bool):
                found.update((literal, measure) for literal in encoder.measures.assumptions({measure: value}))
        return found

    def _merged(
        self, question: Question, context: Context, lost: Collection[int], wanted: Mapping[int, str]
    ) -> Context:
        found = question.situation()
        named = {name for kind, name in question.names() if kind == "trigger"}
        measures = set(question.encoder.measures.measures())
        # One measure moved may leave those compared with it in the wrong order, so they move together.
        move = {name for literal in lost if (name := wanted[literal]) in measures}
        move |= {name for name in measures if context.conditions.get(name) is None}
        if question.encoder.measures.orders and measures:
            move = measures
        values: dict[str, Value] = dict(context.conditions)
        values.update((n, v) for n, v in found.conditions.items() if n not in measures or n in move)
        return Context((context.triggers - named) | found.triggers, values)
