"""Games of a robot against its environment: can the robot keep its rules whatever happens? (docs/games.md)

`circuit` holds formulas, `qbf` decides who wins, `play` encodes the plays of a ruleset, and `realizability` asks the
question and finds the strategy of the environment.
"""
