"""Equation 1 as clauses: one a line with names, DIMACS, and JSON."""

from __future__ import annotations

from itertools import combinations

from sleec_runtime.model import Assume, Exclusive, Never, Ruleset
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.equation_one import EquationOne


def encode_ruleset(equation: EquationOne) -> Encoder:
    """Equation 1 of every rule, linear in their size, with the constraints, the assumptions and the relations that
    concern one instant."""
    ruleset = equation.ruleset
    encoder = Encoder(ruleset.measures)
    for rule in ruleset.rules:
        for clause, guard in zip(rule.clauses(), encoder.guards(rule, ruleset.reading)):
            for obligation in clause.obligations:
                encoder.clauses.append([-guard, encoder.literal(equation.response(obligation))])
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            for a, b in combinations(sorted(set(constraint.names)), 2):
                encoder.clauses.append([-encoder.variable(("obligation", name)) for name in (a, b)])
        elif isinstance(constraint, Never):
            encoder.clauses.append([-encoder.literal(constraint.formula)])
        else:
            assert isinstance(constraint, Assume)
            encoder.clauses.append([encoder.literal(constraint.formula)])
    for _, disjunctions in equation.relations():
        encoder.clauses += ([encoder.literal(part) for part in parts] for parts in disjunctions)
    encoder.close()
    return encoder


def variable_names(encoder: Encoder) -> dict[int, tuple[str, str]]:
    """Every variable's kind and name. Kinds: trigger, condition, obligation, measure (``UserAge < 18``), prefix
    and guard (of a rule's clause), auxiliary (stands for a part of a formula)."""
    named: dict[int, tuple[str, str]] = {}
    for (kind, *parts), variable in encoder.variables.items():
        if kind == "below":
            named[variable] = ("measure", " ".join(parts))
        elif kind == "at-most":
            named[variable] = ("measure", " <= ".join(parts))
        else:
            named[variable] = (kind, parts[0])
    for literal, part in encoder.described.items():
        named.setdefault(abs(literal), part)
    return {v: named.get(v, ("auxiliary", f"_{v}")) for v in range(1, encoder.top + 1)}


def as_lines(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One clause per line, as a disjunction of names; ``-`` negates, and the kind precedes the colon."""
    equation = EquationOne(ruleset, untimed)
    encoder = encode_ruleset(equation)
    names = {
        v: f"{kind}:{name}" if kind != "auxiliary" else name for v, (kind, name) in variable_names(encoder).items()
    }
    comments = (f"# {excluded}" for excluded in equation.excluded())
    rows = (" | ".join(f"{'-' if v < 0 else ''}{names[abs(v)]}" for v in clause) for clause in encoder.clauses)
    return "\n".join((*comments, *rows)) + "\n"


def as_dimacs(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """DIMACS CNF; its comments map every variable to its kind and name."""
    equation = EquationOne(ruleset, untimed)
    encoder = encode_ruleset(equation)
    header = [f"c {v} {kind} {name}" for v, (kind, name) in variable_names(encoder).items()]
    header += [f"c {excluded}" for excluded in equation.excluded()]
    rows = [" ".join(map(str, (*clause, 0))) for clause in encoder.clauses]
    return "\n".join((*header, f"p cnf {encoder.top} {len(encoder.clauses)}", *rows)) + "\n"


def as_json(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """``{"reading", "variables": [{"variable", "kind", "name"}], "clauses": [[literal]]}``.

    An obligation with a window has the keys ``event`` and ``window`` too, with its first and last second as
    strings; the last second is null if the window has no end. ``excluded`` has the statements that Equation 1 does not
    include, if there are any.
    """
    import json

    equation = EquationOne(ruleset, untimed)
    encoder = encode_ruleset(equation)
    variables = []
    for v, (kind, name) in variable_names(encoder).items():
        variable: dict[str, object] = {"variable": v, "kind": kind, "name": name}
        if kind == "obligation" and name in equation.windows:
            event, *window = equation.windows[name]
            variable |= {"event": event, "window": window}
        variables.append(variable)
    document: dict[str, object] = {"reading": ruleset.reading, "variables": variables, "clauses": encoder.clauses}
    excluded = [{"statement": e.name, "line": e.line, "reason": e.reason} for e in equation.excluded()]
    if excluded:
        document["excluded"] = excluded
    return json.dumps(document, ensure_ascii=False) + "\n"
