"""Comparing the Python with what is extracted from the theory."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from pathlib import Path

from sleec_runtime.evaluation.conflicts import conflict
from sleec_runtime.evaluation.due import broken_assumptions, due
from sleec_runtime.model import (
    READINGS,
    And,
    Assume,
    Atom,
    Clause,
    Context,
    Exclusive,
    Formula,
    Never,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    Statement,
    Truth,
)
from sleec_verify.certificates.theory.boolean import Boolean
from sleec_verify.certificates.theory.numbering import Numbering
from sleec_verify.certificates.theory.oracle import answers
from sleec_verify.entailment.definition1 import Definition1

Case = tuple[Ruleset, Sequence[Context]]


def compare(oracle: Path, cases: Iterable[Case], at_once: int = 1000) -> int:
    """Compare, in each context, what Algorithm 1 and Definition 1 say there and whether the context counts and
    conflicts; returns in how many."""
    compared = 0
    left = iter(cases)
    while chunk := list(islice(left, at_once)):
        numbered, questions = [], []
        for ruleset, contexts in chunk:
            boolean = Boolean(ruleset)
            one = Numbering(boolean.ruleset)
            numbered.append(one)
            questions.append(one.line)
            for context in contexts:
                facts = list(boolean.facts(context))
                questions += (one.question("at", facts), one.question("table", facts))
        said = iter(answers(oracle, questions))
        for (ruleset, contexts), one in zip(chunk, numbered):
            assert next(said) == "ok"
            definition = Definition1(ruleset)
            for context in contexts:
                compared += 1
                agrees(ruleset, context, definition, one, next(said), next(said))
    return compared


def agrees(
    ruleset: Ruleset, context: Context, definition: Definition1, numbered: Numbering, at: str, table: str
) -> None:
    answer, letter = (dict(part.strip().partition(" ")[::2] for part in line.split(";")) for line in (at, table))

    def literals(text: str) -> list[Obligation]:
        return list(dict.fromkeys(numbered.literal(int(word)) for word in text.split()))

    def where() -> str:
        return f"{ruleset} in {context}: {at}, {table}"

    # What is due, in the order of the text; and by which clause, with Algorithm 1's ε for the default.
    found = due(ruleset, context)
    assert list(found.literals) == literals(answer["due"]), where()
    clauses = {decision.rule.label: decision.clause for decision in found.decisions}
    said = [{None: "-", 0: "e"}.get(clauses.get(r.label), str(clauses.get(r.label))) for r in ruleset.rules if flat(r)]
    assert said == answer["said"].split(), where()
    # Definition 1: by one propagation, and literal by literal, to the letter.
    every = {Obligation(name, negated) for name in numbered.names["obligation"] for negated in (False, True)}
    entailed = definition.entailed(context)
    assert (entailed is not None) == (answer["consistent"] == "1"), where()
    assert (every if entailed is None else entailed) == set(literals(answer["entailed"])), where()
    assert answer["entailed"].split() == letter["entailed"].split(), where()
    asked = min(every, key=str, default=None) if len(context.triggers) % 2 else max(every, key=str, default=None)
    if asked is not None:
        assert definition.entails(context, asked) == (asked in literals(letter["entailed"])), where()
    # Whether the context counts, and whether it conflicts.
    assert (not broken_assumptions(ruleset, context)) == (answer["possible"] == "1"), where()
    assert (conflict(ruleset, context) is None) == (letter["compatible"] == "1"), where()


def flat(rule: Rule) -> bool:
    """Whether a rule is one chain. In parentheses or not: a default with a chain may be all there is."""
    chains = [clause.hedges for clause in rule.clauses()] + [rule.hedges]
    return sum(bool(chain) for chain in chains) <= 1 and (not any(clause.hedges for clause in rule.hedges))


# Random rulesets ----------------------------------------------------------------------------------------------

TRIGGERS = ("Call", "Alarm", "Nurse")
CONDITIONS = ("Asleep", "Alone", "Ill", "Busy")
OBLIGATIONS = ("Help", "Wait", "Nurse", "Leave")


def random_cases(seed: int, comparisons: int, each: int = 10) -> Iterator[Case]:
    """Rulesets of every shape that the theory has, with contexts; `comparisons` contexts in all."""
    draw = random.Random(seed)
    for _ in range(comparisons // each):
        ruleset = _ruleset(draw)
        yield ruleset, [_context(draw) for _ in range(each)]


def _context(draw: random.Random) -> Context:
    # Most rules should speak.
    triggers = frozenset(name for name in TRIGGERS if draw.random() < 0.7)
    return Context(triggers, {name: draw.random() < 0.5 for name in CONDITIONS if draw.random() < 0.9})


def _ruleset(draw: random.Random) -> Ruleset:
    statements: list[Statement] = []
    for number in range(1, draw.randint(1, 4) + 1):
        statements.append(
            Rule(
                f"r{number}",
                draw.choice(TRIGGERS),
                _formula(draw, 1) if draw.random() < 0.25 else None,
                _clause(draw, None, 0),
                tuple(_clause(draw, _formula(draw, 2), 0) for _ in range(draw.randint(0, 3))),
            )
        )
    if draw.random() < 0.4:
        for _ in range(draw.randint(1, 2)):
            statements.append(_constraint(draw))
    return Ruleset(tuple(statements), draw.choice(READINGS))


def _constraint(draw: random.Random) -> Statement:
    kind = draw.randrange(3)
    if kind == 0:
        return Exclusive(tuple(draw.sample(OBLIGATIONS, draw.randint(2, 3))))
    if kind == 1:
        return Never(
            And((Atom("obligation", draw.choice(OBLIGATIONS)), _formula(draw, 2, ("condition", "obligation"))))
        )
    return Assume(_formula(draw, 2, ("condition", "trigger")))


def _clause(draw: random.Random, condition: Formula | None, depth: int) -> Clause:
    names = draw.sample(OBLIGATIONS, draw.choice((0, 1, 1, 1, 2)) if condition is not None else draw.randint(1, 2))
    inner = draw.randint(1, 2) if depth < 2 and draw.random() < 0.12 else 0
    return Clause(
        condition,
        tuple(Obligation(name, draw.random() < 0.25) for name in names),
        tuple(_clause(draw, _formula(draw, 1), depth + 1) for _ in range(inner)),
    )


def _formula(draw: random.Random, depth: int, kinds: Sequence[str] = ("condition", "condition", "trigger")) -> Formula:
    shape = draw.randrange(6) if depth else 0
    if shape < 3:
        if draw.random() < 0.04:
            return Truth(draw.random() < 0.5)
        kind = draw.choice(kinds)
        if kind == "trigger":
            return Atom("trigger", draw.choice(TRIGGERS))
        if kind == "obligation":
            return Atom("obligation", draw.choice(OBLIGATIONS))
        return Atom("condition", draw.choice(CONDITIONS))
    if shape == 3:
        return Not(_formula(draw, depth - 1, kinds))
    operands = tuple(_formula(draw, depth - 1, kinds) for _ in range(draw.randint(2, 3)))
    return And(operands) if shape == 4 else Or(operands)
