"""A question over all contexts: a formula that grows from the relevant clauses, asked of a solver, with a situation
as its answer."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from types import TracebackType

from sleec_runtime.model import Clause, Context, Formula, Obligation, Rule, Value
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat, Solver, Undecided
from sleec_verify.query.names import Name
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.wording.sentence import sentence


class Question:
    """The formula of one question, with the assumptions that share names with it.

    Add clauses through `encoder` and the methods here, then `ask`. Clauses that are added after the first `ask` have no
    effect.
    """

    def __init__(self, index: RulesetIndex, assuming: bool = True) -> None:
        """With `assuming` False, the assumptions are left out, for questions about them."""
        self.index = index
        self._assuming = assuming and bool(index.assumptions)
        self.encoder = Encoder(index.ruleset.measures)
        self._guards: dict[int, list[int]] = {}
        self._solver: Solver | None = None
        self._doubt: Undecided | None = None
        """Why it is unknown whether any situation is possible. If none is, every answer is no."""

    def guards(self, position: int) -> list[int]:
        """The guards of the rule at `position`, one literal for each clause."""
        guards = self._guards.get(position)
        if guards is None:
            rule = self.index.rules[position]
            guards = self._guards[position] = self.encoder.guards(rule, self.index.ruleset.reading)
        return guards

    def guards_of(self, rule: Rule) -> list[int]:
        """The guards of a rule that is not in the ruleset, such as a variant to compare with."""
        return self.encoder.guards(rule, self.index.ruleset.reading)

    def due(self, positions: Sequence[int], about: frozenset[Obligation] | set[Obligation]) -> dict[Obligation, int]:
        """For each literal of `about` that these rules can oblige, the literal "one of them obliges it"."""
        pairs: list[tuple[Clause, int]] = []
        for position in positions:
            clauses = self.index.clauses[position]
            if any(not about.isdisjoint(clause.obligations) for clause in clauses):
                pairs += zip(clauses, self.guards(position))
        return {obligation: literal for obligation, literal in self.encoder.due(pairs).items() if obligation in about}

    def require(self, *literals: int) -> None:
        """Add a clause: one of these literals is true."""
        self.encoder.clauses.append(list(literals))

    def require_formula(self, formula: Formula) -> None:
        self.require(self.encoder.literal(formula))

    def names(self) -> list[Name]:
        """The triggers, conditions and measures in the formula so far."""
        named: list[Name] = [(key[0], key[1]) for key in self.encoder.variables if key[0] in ("trigger", "condition")]
        return [*named, *(("condition", measure) for measure in self.encoder.measures.measures())]

    def _complete(self) -> Solver:
        if self._assuming:
            try:
                possible = is_possible(self.index)
            except Undecided as error:
                possible, self._doubt = True, error
            if possible:
                for assumption in self.index.assumptions_about(self.names()):
                    self.require_formula(assumption.formula)
            else:
                self.require()
        self.encoder.close()
        return MiniSat(self.encoder.clauses)

    def ask(self, *literals: int) -> bool:
        """Whether some context makes the formula and all these literals true.

        Raises `Undecided` if the solver gave up.
        """
        if self._solver is None:
            self._solver = self._complete()
        while True:
            answer = self._solver.solve(literals)
            if answer is None:
                raise Undecided(sentence("the solver reached its limit of conflicts"))
            recorder, clauses = self.index.recorder, self.encoder.clauses
            if not answer:
                if recorder is not None:
                    recorder.refuted(clauses, literals)
                return False
            refusal = self._refused()
            if refusal is None:
                if self._doubt is not None:
                    raise self._doubt
                if recorder is not None:
                    recorder.satisfied(clauses, literals, self._solver.holds)
                return True
            clauses.append(refusal)
            self._solver.add([refusal])

    def exclude(self, *literals: int) -> None:
        """Require for all later calls of `ask` that these are not all true."""
        assert self._solver is not None, "before the first question, there is `require`"
        clause = [-literal for literal in literals]
        self.encoder.clauses.append(clause)
        self._solver.add([clause])

    def _refused(self) -> list[int] | None:
        """A clause that excludes the current model, if the measures cannot have such values."""
        assert self._solver is not None
        return self.encoder.measures.refused(self._solver.holds, self.index.recorder is not None)

    def true(self, literal: int) -> bool:
        """Whether a literal is true in the context of the last `ask`."""
        assert self._solver is not None, "literals have values only after a question"
        return self._solver.holds(literal)

    def core(self) -> list[int]:
        """Literals of the last `ask` that are sufficient for the answer no."""
        assert self._solver is not None, "there is a core only after a question"
        return self._solver.core()

    def core_among(self, literals: Iterable[int]) -> list[int]:
        """Those of these literals that are in the core, in their order."""
        core = set(self.core())
        return [literal for literal in literals if literal in core]

    def situation(self) -> Context:
        """The context of the last `ask`, with a value for every name in the formula."""
        assert self._solver is not None, "there is a situation only after a question"
        true = self._solver.holds
        triggers, conditions = set(), {}
        for (kind, name, *_), variable in self.encoder.variables.items():
            if kind == "trigger" and true(variable):
                triggers.add(name)
            elif kind == "condition":
                conditions[name] = true(variable)
        values: dict[str, Value] = dict(conditions)
        decoded = self.encoder.measures.decode(true)
        assert not isinstance(decoded, list), "ask accepts a model only once its order has room"
        values.update(decoded)
        return Context(frozenset(triggers), values)

    def __enter__(self) -> Question:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._solver is not None:
            self._solver.__exit__(kind, error, at)


def is_possible(index: RulesetIndex) -> bool:
    """Whether the assumptions allow any situation.

    If so, assumptions that share no name with a question can be left out of it. Otherwise, every question has the
    answer no. Asked once. Raises `Undecided` each time if the first time was undecided.
    """
    answer = index.once(_is_possible)
    if isinstance(answer, Undecided):
        raise Undecided(answer.message, answer.hint)
    return answer


def _is_possible(index: RulesetIndex) -> bool | Undecided:
    with Question(index, assuming=False) as question:
        for assumption in index.assumptions:
            question.require_formula(assumption.formula)
        try:
            return question.ask()
        except Undecided as error:
            return error
