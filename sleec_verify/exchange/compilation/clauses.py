"""Equation 1 as clauses: one a line with names, DIMACS, and JSON."""

from __future__ import annotations

from itertools import combinations

from sleec_runtime.model import Assume, Exclusive, Never, Ruleset
from sleec_verify.encoding.cnf import Encoder


def encode_ruleset(ruleset: Ruleset) -> Encoder:
    """Equation 1 of every rule, linear in their size, with the constraints and the assumptions."""
    encoder = Encoder(ruleset.measures)
    for rule in ruleset.rules:
        encoder.equation(rule, ruleset.reading)
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            for a, b in combinations(sorted(set(constraint.names)), 2):
                encoder.clauses.append([-encoder.variable(("obligation", name)) for name in (a, b)])
        elif isinstance(constraint, Never):
            encoder.clauses.append([-encoder.literal(constraint.formula)])
        else:
            assert isinstance(constraint, Assume)
            encoder.clauses.append([encoder.literal(constraint.formula)])
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


def as_lines(ruleset: Ruleset) -> str:
    """One clause per line, as a disjunction of names; ``-`` negates, and the kind precedes the colon."""
    encoder = encode_ruleset(ruleset)
    names = {
        v: f"{kind}:{name}" if kind != "auxiliary" else name for v, (kind, name) in variable_names(encoder).items()
    }
    rows = (" | ".join(f"{'-' if v < 0 else ''}{names[abs(v)]}" for v in clause) for clause in encoder.clauses)
    return "\n".join(rows) + "\n"


def as_dimacs(ruleset: Ruleset) -> str:
    """DIMACS CNF; its comments map every variable to its kind and name."""
    encoder = encode_ruleset(ruleset)
    header = [f"c {v} {kind} {name}" for v, (kind, name) in variable_names(encoder).items()]
    rows = [" ".join(map(str, (*clause, 0))) for clause in encoder.clauses]
    return "\n".join((*header, f"p cnf {encoder.top} {len(encoder.clauses)}", *rows)) + "\n"


def as_json(ruleset: Ruleset) -> str:
    """``{"reading", "variables": [{"variable", "kind", "name"}], "clauses": [[literal]]}``."""
    import json

    encoder = encode_ruleset(ruleset)
    variables = [{"variable": v, "kind": k, "name": name} for v, (k, name) in variable_names(encoder).items()]
    document = {"reading": ruleset.reading, "variables": variables, "clauses": encoder.clauses}
    return json.dumps(document, ensure_ascii=False) + "\n"
