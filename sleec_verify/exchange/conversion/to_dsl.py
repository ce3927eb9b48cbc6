"""Conversion to a dialect of the DSL, from structured English or the other dialect."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from sleec_runtime.language.dsl.keywords import KEYWORDS, LEGOS_KEYWORDS
from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
    RELATIONS,
    Agent,
    And,
    Atom,
    Claim,
    Comments,
    Constant,
    Declaration,
    DeclaredKind,
    Dialect,
    Formula,
    Measure,
    Not,
    Or,
    Rule,
    Ruleset,
    Span,
    Statement,
    formulas_of,
    leaves,
)
from sleec_verify.encoding.mentioned_names import names_beside_rules
from sleec_verify.encoding.statement_parts import with_formulas
from sleec_verify.exchange.conversion.refusals import defined_names, refuse
from sleec_verify.exchange.conversion.rules import narrow, split
from sleec_verify.exchange.conversion.sleec_tk import has_untimed, refuse_unsayable, taken_names
from sleec_verify.wording.phrases import listed

_RENAME = "rename it everywhere in the rules first"
_NAME = re.compile(r"[^\W\d]\w*")


def to_dsl(ruleset: Ruleset, dialect: Dialect) -> tuple[Ruleset, list[str]]:
    """`ruleset`, which is read by priority, as `dialect` says it, and what to know about the result.

    Raises:
        Unsayable: it holds what the dialect has no words for.
    """
    notes: list[str] = []
    english = ruleset.syntax == "english"
    statements = list(_from_english(ruleset, notes) if english else ruleset.statements)
    if english:
        notes += _of_events_in_conditions(ruleset)
    if dialect == "sleec-tk":
        refuse_unsayable(ruleset, statements)
        taken = taken_names(statements)
        if taken:
            notes.append(f"the editor of SLEEC-TK rejects {listed(taken)} as {'names' if len(taken) > 1 else 'a name'}")
        if ruleset.dialect != "sleec-tk" and has_untimed(statements):
            notes.append("a response without a window is immediate here, but SLEEC-TK requires it at any later time")
    else:
        _refuse_keywords_of_legos(ruleset, statements)
        statements = [with_formulas(s, _in_pairs) for s in statements]
    converted = replace(
        ruleset, statements=tuple(statements), syntax="dsl", dialect=dialect, inferred=(), reading_stated=False
    )
    return converted, notes


def _from_english(ruleset: Ruleset, notes: list[str]) -> Iterator[Statement]:
    """The statements with every name defined: declared names at their declarations, the others first."""
    defined: set[str] = set()
    declared = {name for names in ruleset.declared.values() for name in names}
    agents = {name: s.agent for s in ruleset.statements if isinstance(s, Declaration) for name in s.names if s.agent}
    events, formulas, _ = names_beside_rules(ruleset)
    for name in _undeclared(ruleset.triggers | ruleset.obligations | events, declared):
        defined.add(_name(ruleset, name))
        yield Declaration("event", (name,))
    atoms = [leaf for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Atom)]
    beside = {atom.name for atom in atoms if atom.kind == "condition"}
    events |= {atom.name for atom in atoms if atom.kind == "trigger"}
    for name in _undeclared(ruleset.conditions | beside, declared):
        yield Declaration("condition", (_name(ruleset, name),))
    for measure in ruleset.inferred:
        yield _measure(ruleset, replace(measure, declared=True), notes)
    labels = {s.label for s in ruleset.statements if isinstance(s, (Rule, Claim))}
    for statement in ruleset.statements:
        if isinstance(statement, Declaration):
            yield from _declarations(ruleset, statement, defined, agents)
        elif isinstance(statement, Measure):
            yield _measure(ruleset, statement, notes)
        elif isinstance(statement, Constant):
            if statement.value.denominator != 1:
                refuse(ruleset, f"`{statement.name}` is not a whole number", statement.span, "choose a smaller unit")
            _name(ruleset, statement.name)
            yield statement
        elif isinstance(statement, Rule):
            if statement.domains is not None:
                said = f"the DSL has no domains, but rule `{statement.label}` has one"
                refuse(ruleset, said, statement.span, "choose one with --domain")
            _label(ruleset, statement.label, statement.label_span)
            rule = replace(statement, comments=_comments(statement), labelled=True, always=None)
            yield from split(rule, labels)
        elif isinstance(statement, Claim):
            _label(ruleset, statement.label, statement.label_span)
            yield narrow(statement)
        elif isinstance(statement, RELATIONS):
            yield statement
        else:
            word = type(statement).__name__.upper()
            refuse(ruleset, f"the DSL has no equivalent of {word}", statement.span)


def _of_events_in_conditions(ruleset: Ruleset) -> Iterator[str]:
    formulas = [formula for rule in ruleset.rules for formula in formulas_of(rule)] + names_beside_rules(ruleset)[1]
    atoms = (leaf for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Atom))
    named = sorted({atom.name for atom in atoms if atom.kind == "trigger"})
    if named:
        names = f"{listed(named)} {'stands in a condition' if len(named) == 1 else 'stand in conditions'}"
        yield f"{names}, but SLEEC-TK and LEGOS-SLEEC allow only measures there"


def _undeclared(names: Iterable[str], declared: set[str]) -> list[str]:
    return sorted(set(names) - declared)


def _declarations(
    ruleset: Ruleset, statement: Declaration, defined: set[str], agents: Mapping[str, Agent]
) -> Iterator[Declaration]:
    """A definition for each name. A name that is declared as a trigger and as an obligation is one event."""
    comments = statement.comments
    kind: DeclaredKind = "condition" if statement.kind == "condition" else "event"
    for name, span in zip(statement.names, statement.name_spans or [statement.span] * len(statement.names)):
        if name not in defined:
            defined.add(_name(ruleset, name, span))
            yield Declaration(kind, (name,), span, (span,), comments, agents.get(name))
            comments = NO_COMMENTS
    if comments != NO_COMMENTS:
        refuse(
            ruleset, "a comment belongs to a declaration that the DSL does not have", statement.span, "move the comment"
        )


def _measure(ruleset: Ruleset, measure: Measure, notes: list[str]) -> Measure:
    for name in (measure.name, *measure.values):
        _name(ruleset, name, measure.span)
    if measure.kind == "number":
        notes.append(f"`{measure.name}` is a number here, but a whole number (numeric) in the DSL")
        return replace(measure, kind="integer")
    return measure


def _comments(rule: Rule) -> Comments:
    """The comments of a rule's two lines in structured English, the label and the next one, for one line."""
    own, default = rule.comments, rule.default.comments
    one_too_many = (default.behind,) if own.behind is not None and default.behind is not None else ()
    return Comments((*own.above, *default.above, *one_too_many), own.behind or default.behind)


def _refuse_keywords_of_legos(ruleset: Ruleset, statements: Iterable[Statement]) -> None:
    for statement in statements:
        values = statement.values if isinstance(statement, Measure) else ()
        for name in (*defined_names(statement), *values):
            if name in LEGOS_KEYWORDS:
                span = statement.span if statement.span != NOWHERE else None
                refuse(ruleset, f"`{name}` is a keyword of LEGOS", span, _RENAME)


def _label(ruleset: Ruleset, label: str, span: Span) -> None:
    if label in LEGOS_KEYWORDS:
        refuse(ruleset, f"`{label}` is a keyword of the DSL", span, _RENAME)
    _name(ruleset, label, span)


def _name(ruleset: Ruleset, name: str, span: Span | None = None) -> str:
    """A name that SLEEC-TK accepts; LEGOS has more keywords."""
    is_keyword = name in KEYWORDS - LEGOS_KEYWORDS
    if _NAME.fullmatch(name) is None or is_keyword:
        what = "is a keyword of the DSL" if is_keyword else "is not a name of the DSL: use only letters, digits and _"
        refuse(ruleset, f"`{name}` {what}", span, _RENAME)
    return name


# Formulas as LEGOS writes them ----------------------------------------------------------------------------


def _in_pairs(formula: Formula) -> Formula:
    """A formula whose chains of `and`, and of `or`, do not end in one of the same kind, as in LEGOS."""
    if isinstance(formula, Not):
        return replace(formula, operand=_in_pairs(formula.operand))
    if isinstance(formula, (And, Or)):
        *first, last = map(_in_pairs, formula.operands)
        ending = last.operands if isinstance(last, (And, Or)) and type(last) is type(formula) else (last,)
        return replace(formula, operands=(*first, *ending))
    return formula
