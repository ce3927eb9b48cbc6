"""Hypothesis strategies for rulesets: small ones of every shape that the language has.

`rulesets()` gives values such as the parser gives: names resolved, comparisons fitted, inferred measures listed. Turn
features off, or make it smaller, where a property is slow to check.
"""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import strategies as st

from sleec_runtime.language.english.always import Always, instances
from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
    READINGS,
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Declaration,
    Exclusive,
    Formula,
    Kind,
    Measure,
    Never,
    Not,
    Obligation,
    Reading,
    Rule,
    Ruleset,
    Statement,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.conformance.comments import comment_lines, with_comments
from sleec_verify.conformance.vocabulary import DOMAINS, Vocabulary, formulas, leaves_over, measures_and_constants

__all__ = ["formulas", "rulesets"]


@st.composite
def rulesets(
    draw: st.DrawFn,
    min_rules: int = 1,
    max_rules: int = 4,
    max_hedges: int = 3,
    max_depth: int = 2,
    names: int = 3,
    nested: bool = True,
    guards: bool = True,
    negations: bool = True,
    measures: bool = True,
    constraints: bool = True,
    domains: bool = True,
    declarations: bool = True,
    overlap: bool = True,
    events: bool = True,
    labels: bool = True,
    exotic: bool = False,
    comments: bool = False,
    readings: Sequence[Reading] = READINGS,
    always: bool = False,
) -> Ruleset:
    """Valid rulesets of `min_rules` to `max_rules` rules with up to `max_hedges` hedges in each chain.

    Formulas are up to `max_depth` operators deep, over `names` names of each kind. `nested` allows chains in
    parentheses, `negations` prohibitions, `overlap` names that are both trigger and obligation, `events` conditions
    that name triggers of rules, `labels` rules with labels of their own, `exotic` names in other scripts, `comments`
    comments everywhere, `always` a rule for every trigger.
    """
    known = Vocabulary(names, overlap, exotic)
    statements: list[Statement] = []
    if measures:
        statements += draw(measures_and_constants(known))
    leaf = leaves_over(known)
    triggers = draw(st.lists(st.sampled_from(known.triggers), min_size=min_rules, max_size=max_rules))
    if events:
        event = st.builds(Atom, st.just("trigger"), st.sampled_from(sorted(set(triggers))))
        leaf = st.one_of(leaf, leaf, leaf, event)
    rules = [
        draw(_rules(known, trigger, leaf, max_hedges, max_depth, nested, guards, negations, domains, labels, number))
        for number, trigger in enumerate(triggers, 1)
    ]
    every: list[Rule] = []
    if always and draw(st.booleans()):
        every.append(
            draw(_rules(known, triggers[0], leaf, max_hedges, max_depth, nested, False, negations, domains, False, 0))
        )
    others: list[Statement] = []
    if constraints and draw(st.booleans()):
        others += draw(_constraints([*rules, *every], known, leaf, max_depth, domains))
    if declarations:
        statements += draw(_declarations([*rules, *every, *others]))
    statements = _merged(draw, draw(st.permutations([*statements, *others])), rules)
    if every:
        at = draw(st.integers(0, len(statements)))
        statements[at:at] = _instances(every[0], statements)
    if comments:
        statements = [draw(with_comments(statement)) for statement in statements]
    return Ruleset(
        statements=tuple(statements),
        reading=draw(st.sampled_from(readings)),
        inferred=_inferred(statements, known),
        closing_comments=draw(comment_lines()) if comments else (),
    )


def _merged(draw: st.DrawFn, others: list[Statement], rules: list[Rule]) -> list[Statement]:
    """The rules in their order, the other statements anywhere between them."""
    places = [draw(st.integers(0, len(rules))) for _ in others]
    merged: list[Statement] = []
    for index in range(len(rules) + 1):
        merged += [other for other, place in zip(others, places) if place == index]
        merged += rules[index : index + 1]
    return merged


def _instances(rule: Rule, statements: list[Statement]) -> list[Rule]:
    """`rule` for each trigger of the statements."""
    triggers = [statement.trigger for statement in statements if isinstance(statement, Rule)]
    for statement in statements:
        if isinstance(statement, Declaration) and statement.kind == "trigger":
            triggers += statement.names
    every = Always(rule.default, rule.hedges, rule.domains, NOWHERE, NOWHERE, NO_COMMENTS)
    return instances(every, "always_1", dict.fromkeys(triggers))


@st.composite
def _rules(
    draw: st.DrawFn,
    known: Vocabulary,
    trigger: str,
    leaf: st.SearchStrategy[Formula],
    max_hedges: int,
    max_depth: int,
    nested: bool,
    guards: bool,
    negations: bool,
    domains: bool,
    labels: bool,
    number: int,
) -> Rule:
    condition = formulas(leaf, max_depth)
    labelled = labels and draw(st.booleans())
    default, *hedges = draw(_chains(known, condition, max_hedges, nested, negations, depth=0))
    return Rule(
        label=draw(st.sampled_from((f"r{number}", f"ward.r{number}", f"r-{number}"))) if labelled else f"rule_{number}",
        trigger=trigger,
        guard=draw(condition) if guards and draw(st.integers(0, 3)) == 0 else None,
        default=default,
        hedges=tuple(hedges),
        domains=draw(_domains()) if domains else None,
        labelled=labelled,
    )


@st.composite
def _chains(
    draw: st.DrawFn,
    known: Vocabulary,
    condition: st.SearchStrategy[Formula],
    max_hedges: int,
    nested: bool,
    negations: bool,
    depth: int,
) -> list[Clause]:
    """A default and its hedges, each optionally with its own chain."""
    obligation = st.builds(
        Obligation, st.sampled_from(known.obligations), st.booleans() if negations else st.just(False)
    )
    clauses: list[Clause] = []
    for index in range(draw(st.integers(0, max_hedges)) + 1):
        inner: list[Clause] = []
        if nested and depth < 2 and draw(st.integers(0, 5)) == 0:
            inner = draw(_chains(known, condition, 2, nested, negations, depth + 1))[1:]
        clauses.append(
            Clause(
                condition=draw(condition) if index else None,
                obligations=tuple(draw(st.lists(obligation, min_size=0 if index else 1, max_size=3))),
                hedges=tuple(inner),
            )
        )
    return clauses


def _domains() -> st.SearchStrategy[tuple[str, ...] | None]:
    some = st.lists(st.sampled_from(DOMAINS), min_size=1, max_size=2, unique=True).map(tuple)
    return st.one_of(st.none(), some)


@st.composite
def _constraints(
    draw: st.DrawFn,
    rules: list[Rule],
    known: Vocabulary,
    leaf: st.SearchStrategy[Formula],
    max_depth: int,
    domains: bool,
) -> list[Statement]:
    """Constraints over names whose kind the rules settle."""
    where = _domains() if domains else st.none()
    found: list[Statement] = []
    obligations = sorted({o.name for rule in rules for clause in rule.clauses() for o in clause.obligations})
    triggers = sorted({rule.trigger for rule in rules})
    atoms = (atom for rule in rules for f in formulas_of(rule) for atom in leaves(f) if isinstance(atom, Atom))
    used = {atom.name for atom in atoms if atom.kind == "condition"}
    if draw(st.booleans()):
        names = draw(st.lists(st.sampled_from(known.obligations), min_size=2, max_size=3, unique=True))
        found.append(Exclusive(tuple(names), draw(where)))
        obligations = sorted({*obligations, *names})
    obligation = st.builds(Atom, st.just("obligation"), st.sampled_from(obligations))
    trigger = st.builds(Atom, st.just("trigger"), st.sampled_from(triggers))
    only_triggers = [name for name in triggers if name not in obligations]
    conditions = [st.builds(Atom, st.just("condition"), st.sampled_from(sorted(used)))] if used else []
    situations = [st.builds(Atom, st.just("trigger"), st.sampled_from(only_triggers))] if only_triggers else []
    # A condition that only another domain settles would be an obligation in the formula of a NEVER.
    exception = formulas(st.one_of(*situations), max_depth) if situations else st.nothing()
    for _ in range(draw(st.integers(0, 2))):
        rest = draw(formulas(st.one_of(obligation, *conditions, *situations), max_depth))
        exceptions = draw(st.lists(st.builds(Not, exception), max_size=2)) if draw(st.booleans()) else []
        found.append(Never(And((draw(obligation), rest, *exceptions)), draw(where), exceptions=len(exceptions)))
    if draw(st.booleans()):
        found.append(Assume(draw(formulas(st.one_of(trigger, leaf), max_depth)), draw(where)))
    return found


@st.composite
def _declarations(draw: st.DrawFn, statements: list[Statement]) -> list[Statement]:
    """Declarations of whole kinds: of every name that is used, and optionally of one that is not."""
    ruleset = Ruleset(tuple(statements))
    found: list[Statement] = []
    every: tuple[tuple[Kind, frozenset[str], str], ...] = (
        ("trigger", ruleset.triggers, "SpareTrigger"),
        ("condition", ruleset.conditions, "SpareCondition"),
        ("obligation", ruleset.obligations, "SpareObligation"),
    )
    for kind, names, spare in every:
        chosen = sorted(names) + ([spare] if draw(st.booleans()) else [])
        if chosen and draw(st.integers(0, 2)) == 0:
            cut = draw(st.integers(0, len(chosen)))
            parts = (tuple(chosen[:cut]), tuple(chosen[cut:]))
            found += [Declaration(kind, part) for part in parts if part]
    return found


def _inferred(statements: Sequence[Statement], known: Vocabulary) -> tuple[Measure, ...]:
    compared: set[str] = set()
    for statement in statements:
        own = list(formulas_of(statement)) if isinstance(statement, Rule) else []
        if isinstance(statement, (Never, Assume)):
            own = [statement.formula]
        for formula in own:
            for leaf in leaves(formula):
                if isinstance(leaf, Comparison):
                    compared.update(measures_of(leaf))
    return tuple(known.measures[name] for name in sorted(compared) if not known.measures[name].declared)
