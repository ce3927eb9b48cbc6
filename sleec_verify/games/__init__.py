"""Games between a robot and what surrounds it: can the robot keep its rules whatever happens?

`circuit` holds formulas, `quantified` decides who wins where two players set variables in turn, `play` says what a play
of a ruleset is, `realizability` asks the question and tells the strategy of the environment.
"""
