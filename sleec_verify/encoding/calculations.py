"""The calculations with several measures in a ruleset, for components that do not support them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.errors import Unsayable, UnsupportedCalculations
from sleec_runtime.model import Assume, Calculation, Comparison, Formula, Never, Ruleset, formulas_of, leaves
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import joined, sentence


def calculations_in(formula: Formula) -> Iterator[Calculation]:
    """The calculations that a formula compares with numbers, in the order of the text, repeats included."""
    for leaf in leaves(formula):
        if isinstance(leaf, Comparison) and isinstance(leaf.left, Calculation):
            yield leaf.left


def calculations(ruleset: Ruleset) -> list[Calculation]:
    """The calculations that a ruleset compares with numbers, each once, those of rules first. Linear in the size of
    the ruleset."""
    formulas: list[Formula] = [formula for rule in ruleset.rules for formula in formulas_of(rule)]
    formulas += [c.formula for c in ruleset.constraints if isinstance(c, (Never, Assume))]
    if ruleset.is_timed:
        from sleec_verify.encoding.mentioned_names import names_beside_rules

        formulas += names_beside_rules(ruleset)[1]
    return list(dict.fromkeys(one for formula in formulas for one in calculations_in(formula)))


def calculated_lengths(ruleset: Ruleset) -> list[Calculation]:
    """The calculations that give the length of a window, in the order of the text."""
    if not ruleset.is_timed:
        return []
    from sleec_verify.encoding.mentioned_names import names_beside_rules

    return [length.amount for length in names_beside_rules(ruleset)[2] if isinstance(length.amount, Calculation)]


def named(found: Iterable[Calculation]) -> str:
    """Calculations for messages, each with its line."""
    return joined(
        ", ",
        (
            sentence("{calculation} in line {line}", calculation=quoted(str(one)), line=one.line)
            if one.line
            else quoted(str(one))
            for one in found
        ),
    )


def unsupported(found: Iterable[Calculation], who: str) -> UnsupportedCalculations:
    """The error for calculations that `who` does not support."""
    found = list(found)
    more = f" and {len(found) - 5:,} more" if len(found) > 5 else ""
    return UnsupportedCalculations(
        f"{who} does not support calculations with several measures: {named(found[:5])}{more}",
        [one.line for one in found],
    )


def refuse_calculations(ruleset: Ruleset, who: str) -> None:
    """Raises `UnsupportedCalculations` if `ruleset` has calculations with several measures. `who` does not support
    them."""
    found = calculations(ruleset)
    if found:
        raise unsupported(found, who)


def refuse_unsayable_calculations(ruleset: Ruleset, language: str, hint: str) -> None:
    """Raises `Unsayable` for the first calculation of a ruleset, because `language` has none."""
    found = calculations(ruleset) + calculated_lengths(ruleset)
    if found:
        place = f"{ruleset.source.path}:{found[0].line}: " if found[0].line else ""
        raise Unsayable(f"{place}{language} has no calculations such as `{found[0]}`", hint)
