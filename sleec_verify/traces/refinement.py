"""Counterexample-guided refinement: situations that no template fits, and templates of the continuations they have.

(Counterexample-guided inductive synthesis; A. Solar-Lezama, "Program synthesis by sketching", 2008; for exists-forall
SMT: B. Dutertre, "Solving exists/forall problems with Yices", 2015.)
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from sleec_verify.encoding.solver import Refutation, Undecided
from sleec_verify.traces.blocking import Defeat
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.pending_demands import most_prohibitions
from sleec_verify.traces.situations import Fact, Situations
from sleec_verify.traces.templates import Template, templates_of
from sleec_verify.wording.sentence import plural

MOST_COPIES = 8
"""The maximal number of further slots for each response that needs several, in addition to those of templates.
Published rulesets need none."""

MOST_TEMPLATES = 2_000
"""The maximal number of templates. The budget of a file usually ends the search earlier."""


class Refinement:
    """Proposes situations until a template fits each one.

    At first, each response has one slot. A template fails because of few pending demands. So if no situation is left,
    the templates in this refutation get their own slots, which is as good as any number of slots.
    """

    def __init__(self, situations: Situations) -> None:
        self._situations = s = situations
        self._defeat = Defeat(s)
        self._slots = tuple(s.slots)
        self._without_history = [-active for active in s.active.values() if active != s.true]
        self._shared: dict[Template, int] = {}
        """For each template, the literal that leaves only the situations that it does not fit."""
        self._origins: dict[Template, tuple[Fact, ...]] = {}
        """The situations in which templates were found."""
        self._lifted: dict[Template, int] = {}
        """The same, for templates with slots of their own."""
        # A demand, and an instant of a policy for each prohibition in it; or two instants that coincide.
        self._own = 1 + max(most_prohibitions(s.index), 1)
        self._copies = 0
        self.refutation = Refutation(s.formula.clauses, ())
        """Of the last question whether a situation is left."""
        self._add(Template())

    def propose(self, copies: int = MOST_COPIES) -> bool:
        """Whether a situation is left that no template fits. It is then that of the last `find` of the situations.
        Each response may leave one pending demand, and so many `copies`.

        Raises Undecided if it could need too many pending demands of one response."""
        s = self._situations
        if not self._lifted:
            # Situations without a history are the simplest witnesses.
            for assumed in (self._without_history, []):
                if s.find(*assumed, -s.more, *self._shared.values()):
                    return True
            if not s.several:
                return self._none_left()
            for template in [template for template, literal in self._shared.items() if literal in s.core]:
                self._lift(template)
        while not s.find_least(-s.more, *self._lifted.values()):
            if -s.more not in s.core:
                return self._none_left()
            if self._copies >= copies:
                raise Undecided(
                    plural(
                        self._copies,
                        "no conflict found with {number} more pending trigger of each response",
                        "no conflict found with {number} more pending triggers of each response",
                    )
                )
            self._copies += 1
            s.add_copies(1)
        return True

    def _none_left(self) -> bool:
        # Later questions add to the formula, and this one is about the clauses of now.
        self.refutation = Refutation(list(self._situations.formula.clauses), list(self._situations.core))
        return False

    def templates(self) -> Iterator[tuple[Template, int, tuple[Fact, ...]]]:
        """The templates in the refutation that ended the search, each with the literal that leaves only the situations
        that it does not fit, and the facts of a situation in which it was found (none: it is the first one)."""
        known = self._lifted or self._shared
        for template, literal in known.items():
            if literal in self.refutation.literals:
                yield template, literal, self._origins.get(template, ())

    def learn(self, continuations: Continuations, facts: Collection[Fact]) -> None:
        """Exclude the situations that the last continuation fits, which is one of a situation with these `facts`.
        Raises `Undecided` after too many."""
        known = self._lifted or self._shared
        for template in templates_of(continuations):
            if template not in known and len(known) < MOST_TEMPLATES:
                (self._lift if self._lifted else self._add)(template)
                self._origins[template] = tuple(facts)
                return
        raise Undecided(
            plural(len(known), "no answer after {number} continuation", "no answer after {number} continuations")
        )

    def _add(self, template: Template) -> None:
        self._shared[template] = self._defeat.add(template, self._slots)

    def _lift(self, template: Template) -> None:
        slots = [*self._slots, *self._situations.add_copies(self._own)]
        self._lifted[template] = self._defeat.add(template, slots)
