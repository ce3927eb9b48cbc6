"""What the checks of rules with time are given: a ruleset, what a response without a window means, and both roads into
it, the one of situations and the one of traces."""

from __future__ import annotations

from functools import cached_property

from sleec_runtime.model import Ruleset
from sleec_verify.cone import Cones
from sleec_verify.solver import Recorder
from sleec_verify.timed.program import Program
from sleec_verify.timed.scope import Untimed


class Traces(Cones):
    """A ruleset whose rules speak of traces."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at", recorder: Recorder | None = None) -> None:
        super().__init__(ruleset, recorder)
        self.untimed = untimed

    @cached_property
    def program(self) -> Program:
        return Program(self.ruleset, self.untimed, self.recorder)
