"""Quantified Boolean formulas: which of two players wins, who set variables alternately.

A player's first move is searched in an abstraction of the game, in which the opponent has only the known answers. Each
candidate is tried. An answer that defeats it is added to the abstraction, with new variables for everything after it.
If the abstraction has no move, the game is lost. (Janota, Klieber, Marques-Silva and Clarke, "Solving QBF with
counterexample guided refinement", 2016.)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.games.circuit import Circuit
from sleec_verify.wording.phrases import grouped
from sleec_verify.wording.sentence import sentence

MOST_MOVES = 20_000
"""The maximal number of moves of both players that are tried for a question."""

Move = dict[int, int]
"""Variables of one turn, each with 1 (true) or -1 (false)."""

NOTHING: Mapping[int, int] = {}


def winning_move(circuit: Circuit, own: Sequence[int], goal: int, turns: Sequence[Sequence[int]] = ()) -> Move | None:
    """A move on the variables `own` with which the player whose turn it is gets `goal`, for all moves of the opponent
    in the first, third, … of `turns`. None if there is no such move. Exponential in the number of turns.

    Raises `Undecided` after `MOST_MOVES`.
    """
    player = _Player(circuit, own, _Budget(MOST_MOVES))
    player.add(_Game(tuple(tuple(turn) for turn in turns), goal))
    return player.move()


@dataclass
class _Budget:
    left: int

    def spend(self) -> None:
        self.left -= 1
        if self.left < 0:
            raise Undecided(sentence("no answer after {number} moves", number=grouped(MOST_MOVES)))


@dataclass(frozen=True)
class _Game:
    """The rest of a game for the player whose turn it is: the variables of the later turns, those of the opponent
    first, and the literal that the player wants true at the end."""

    turns: tuple[tuple[int, ...], ...]
    goal: int


class _Player:
    """The player whose turn it is, who must win several games with one move. Games can be added at any time."""

    def __init__(self, circuit: Circuit, own: Sequence[int], budget: _Budget) -> None:
        self._circuit = circuit
        self._own = list(own)
        self._budget = budget
        self._ahead: list[tuple[_Game, _Goals]] = []
        """The games that end with the opponent's answer, with the opponent's goals."""
        self._goals = _Goals(circuit)
        self._later: _Player | None = None
        """The same player, who moves now and once more after known answers of the opponent."""

    def add(self, game: _Game, own: Sequence[int] = ()) -> None:
        """Add a game, with further variables to set in this move."""
        self._widen(own)
        if game.turns:
            against = _Goals(self._circuit)
            if len(game.turns) == 1:
                against.add(-game.goal)
            self._ahead.append((game, against))
        else:
            self._require(game)

    def _widen(self, own: Sequence[int]) -> None:
        self._own += own
        if self._later is not None:
            self._later._widen(own)

    def move(self) -> Move | None:
        """A move that wins all the games, or None."""
        while True:
            self._budget.spend()
            move = self._goals.model(self._own) if self._later is None else self._later.move()
            if move is None:
                return None
            # Variables that the move leaves open are open in all games.
            settled = {variable: move.get(variable, -1) for variable in self._own}
            for game, against in self._ahead:
                if len(game.turns) == 1:
                    self._budget.spend()
                    answer = against.model(game.turns[0], settled)
                else:
                    answer = self._answer(game, settled)
                if answer is not None:
                    self._require(self._answered(game, answer))
                    break
            else:
                return settled

    def _answer(self, game: _Game, settled: Move) -> Move | None:
        other = _Player(self._circuit, game.turns[0], self._budget)
        other.add(_Game(game.turns[1:], -self._circuit.replaced(game.goal, settled)))
        return other.move()

    def _answered(self, game: _Game, answer: Move) -> _Game:
        """The game with a fixed next move of the opponent. Later turns depend on it, so they get new variables."""
        fresh = [{old: self._circuit.variable() for old in turn} for turn in game.turns[1:]]
        values = dict(answer)
        for renamed in fresh:
            values.update(renamed)
        return _Game(tuple(tuple(turn.values()) for turn in fresh), self._circuit.replaced(game.goal, values))

    def _require(self, game: _Game) -> None:
        """Add a game in which this player also has the next turn, which becomes part of the move."""
        if self._later is None and len(game.turns) > 1:
            self._later = _Player(self._circuit, self._own, self._budget)
            for goal in self._goals.asked:
                self._later.add(_Game((), goal))
        if self._later is None:
            self._goals.add(game.goal)
        else:
            self._later.add(_Game(game.turns[1:], game.goal), own=game.turns[0] if game.turns else ())


class _Goals:
    """Literals that must be true together."""

    def __init__(self, circuit: Circuit) -> None:
        self.asked: list[int] = []
        self._circuit = circuit
        self._solver = MiniSat()
        self._written: set[int] = set()

    def add(self, goal: int) -> None:
        self.asked.append(goal)
        fresh = [node for node in self._circuit.below((goal,)) if node not in self._written]
        self._written.update(fresh)
        self._solver.add(list(self._circuit.clauses(fresh)))
        self._solver.add([[goal]])

    def model(self, variables: Sequence[int], settled: Mapping[int, int] = NOTHING) -> Move | None:
        """Values of some variables that satisfy all goals with the given values of others, or None."""
        found = self._solver.solve([variable * value for variable, value in settled.items()])
        if found is None:
            raise Undecided(sentence("the solver reached its limit of conflicts"))
        if not found:
            return None
        return {variable: 1 if self._solver.holds(variable) else -1 for variable in variables}
