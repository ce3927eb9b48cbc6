"""The questions about rules with times by z3: some instants with symbolic times, and what the rules say written down
for each. It borrows the values of the product and nothing else. Bounded, slow, and written to be obviously right.

A trace that it finds is one, whatever the bound. That it finds none means: none of so few instants.

`redundant`, `vacuous`, `concern` and `purpose` look for one trace. `conflict` asks for a situation in which no response
complies with some rules: one solver proposes situations, another looks for a response, and what it finds is kept in the
first as a response that the next situation must not have (counterexample-guided refinement of ∃∀).
"""

from __future__ import annotations

from tests.support.z3_oracle.conflicts import conflict as conflict
from tests.support.z3_oracle.instants import Answer as Answer
from tests.support.z3_oracle.instants import Undecided as Undecided
from tests.support.z3_oracle.questions import concern as concern
from tests.support.z3_oracle.questions import purpose as purpose
from tests.support.z3_oracle.questions import redundant as redundant
from tests.support.z3_oracle.questions import vacuous as vacuous
