"""Random edits to random rulesets: what people do to rules, and what they do by mistake."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

from sleec_runtime.model import And, Assume, Atom, Exclusive, Never, Not, Or, Rule, Ruleset


@st.composite
def edited(draw, rulesets):
    """A ruleset and the same after one to three edits, with parts of another ruleset."""
    old, donor = draw(rulesets), draw(rulesets)
    new = old
    for _ in range(draw(st.integers(1, 3))):
        new = draw(st.sampled_from(EDITS))(draw, new, donor)
    return old, new


@st.composite
def tied(draw, rulesets):
    """Rulesets of up to four triggers, with assumptions that tie these to one another and to conditions, and perhaps
    an obligation that may be due with a trigger only, or without."""
    ruleset = draw(rulesets)
    names = ("t1", "t2", "t3", "t4")
    rules = [replace(rule, trigger=draw(st.sampled_from(names))) for rule in ruleset.rules]
    atoms = st.sampled_from(
        [*(Atom("trigger", name) for name in names), *(Atom("condition", name) for name in ("c1", "c2", "c3"))]
    )
    literals = st.one_of(atoms, atoms.map(Not))
    parts = st.lists(literals, min_size=2, max_size=3, unique=True).map(tuple)
    inner = st.one_of(parts.map(Or), parts.map(And).map(Not))
    formulas = st.one_of(
        inner, st.tuples(literals, inner).map(And).map(Not), st.tuples(literals, parts.map(And)).map(Or), literals
    )
    assumed = draw(st.lists(formulas.map(Assume), max_size=3))
    obligation = st.sampled_from(("o1", "o2", "o3")).map(lambda name: Atom("obligation", name))
    never = draw(st.lists(st.tuples(obligation, literals).map(And).map(Never), max_size=1))
    return _with_rules(replace(ruleset, statements=(*ruleset.statements, *never, *assumed)), rules)


@st.composite
def forbidding(draw, rulesets):
    """Rulesets with constraints over triggers, conditions and obligations, negated or not, which alone may leave
    nothing to do in some situations."""
    ruleset = draw(rulesets)
    free = Atom("obligation", "free")
    situations = [Atom("trigger", "t1"), Atom("trigger", "t2"), Atom("condition", "c1")]

    def nevers(obligation):
        where = st.lists(_literals(situations), max_size=2, unique=True)
        return st.tuples(obligation, where).map(lambda parts: Never(_all_of([parts[0], *parts[1]])))

    pair = [draw(nevers(st.just(free))), draw(nevers(st.just(Not(free))))]
    others = draw(st.lists(nevers(_literals([free, Atom("obligation", "o1"), Atom("obligation", "o2")])), max_size=2))
    return replace(ruleset, statements=(*ruleset.statements, *pair, *others))


def _literals(atoms):
    return st.sampled_from([*atoms, *map(Not, atoms)])


def _all_of(parts):
    return And(tuple(parts)) if len(parts) > 1 else parts[0]


@st.composite
def forbidding_otherwise(draw, rulesets):
    """A ruleset and the same with the constraints of another."""
    old, donor = draw(rulesets), draw(rulesets)
    constraints = [constraint for constraint in (*old.constraints, *donor.constraints) if draw(st.booleans())]
    return old, replace(old, statements=(*old.rules, *constraints))


@st.composite
def reordered(draw, ruleset):
    """The ruleset with its constraints in another order, and their operands, too."""
    constraints = [_reordered_constraint(draw, constraint) for constraint in draw(st.permutations(ruleset.constraints))]
    others = [s for s in ruleset.statements if not isinstance(s, (Assume, Exclusive, Never))]
    return replace(ruleset, statements=(*constraints, *others))


def _reordered_constraint(draw, constraint):
    if isinstance(constraint, Exclusive):
        return replace(constraint, names=tuple(draw(st.permutations(constraint.names))))
    return replace(constraint, formula=_reordered_formula(draw, constraint.formula))


def _reordered_formula(draw, formula):
    if isinstance(formula, Not):
        return Not(_reordered_formula(draw, formula.operand))
    if isinstance(formula, (And, Or)):
        operands = [_reordered_formula(draw, operand) for operand in draw(st.permutations(formula.operands))]
        return replace(formula, operands=tuple(operands))
    return formula


def _with_rules(ruleset: Ruleset, rules) -> Ruleset:
    return replace(ruleset, statements=(*(s for s in ruleset.statements if not isinstance(s, Rule)), *rules))


def _drop_rule(draw, ruleset, donor):
    if len(ruleset.rules) == 1:
        return ruleset
    gone = draw(st.integers(0, len(ruleset.rules) - 1))
    return _with_rules(ruleset, [rule for at, rule in enumerate(ruleset.rules) if at != gone])


def _add_rule(draw, ruleset, donor):
    rule = draw(st.sampled_from(donor.rules))
    return _with_rules(ruleset, [*ruleset.rules, replace(rule, label=f"n{len(ruleset.rules)}")])


def _change_rule(draw, ruleset, donor):
    at = draw(st.integers(0, len(ruleset.rules) - 1))
    rule, other = ruleset.rules[at], draw(st.sampled_from(donor.rules))
    what = draw(st.sampled_from(("guard", "default", "hedges", "trigger", "negate", "last")))
    if what == "negate":
        if rule.guard is None:
            return ruleset
        changed = replace(rule, guard=Not(Not(rule.guard)))
    elif what == "last":
        changed = replace(rule, hedges=rule.hedges[:-1])
    else:
        changed = replace(rule, **{what: getattr(other, what)})
    return _with_rules(ruleset, [changed if n == at else r for n, r in enumerate(ruleset.rules)])


def _rename(draw, ruleset, donor):
    at = draw(st.integers(0, len(ruleset.rules) - 1))
    renamed = replace(ruleset.rules[at], label=f"m{at}_{len(ruleset.rules)}")
    return _with_rules(ruleset, [renamed if n == at else r for n, r in enumerate(ruleset.rules)])


def _reorder(draw, ruleset, donor):
    return _with_rules(ruleset, draw(st.permutations(ruleset.rules)))


def _read_otherwise(draw, ruleset, donor):
    return replace(ruleset, reading="priority" if ruleset.reading == "cascade" else "cascade")


def _constrain(draw, ruleset, donor):
    """Other constraints, or other assumptions."""
    kinds = draw(st.sampled_from(((Exclusive, Never), (Assume,))))
    kept = [s for s in ruleset.statements if not isinstance(s, kinds)]
    return replace(ruleset, statements=(*kept, *(s for s in donor.statements if isinstance(s, kinds))))


EDITS = (
    _drop_rule,
    _add_rule,
    _change_rule,
    _change_rule,
    _change_rule,
    _rename,
    _reorder,
    _read_otherwise,
    _constrain,
)
