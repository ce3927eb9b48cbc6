"""Decision tables in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, islice

from sleec_runtime.model import Clause, Comparison, MeasureRef, Operator, Rational, Ruleset
from sleec_verify.changes.diagram.variables import Variable
from sleec_verify.checks.conflict_wording import reason
from sleec_verify.decision_tables.splits import Cell
from sleec_verify.decision_tables.table import DecisionTable, Row
from sleec_verify.encoding.regions import Cut
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import grouped, listed, value_text
from sleec_verify.wording.plain_language import condition_words, response_words
from sleec_verify.wording.sentence import joined, plural, sentence


def column_words(variable: Variable) -> str:
    """The heading of a column."""
    return listed(spoken(name) for _, name in variable.names)


def cell_words(cell: Cell, ruleset: Ruleset) -> str:
    """``yes``, ``does not occur``, ``low or moderate``, ``at least 16 and below 18``"""
    if cell.variable.orders:
        return _order_words(cell)
    (kind, name), *_ = cell.variable.names
    if kind == "trigger":
        return sentence("occurs") if cell.values == (1,) else sentence("does not occur")
    measure = ruleset.measures.get(name)
    if measure is None:
        return sentence("yes") if cell.values == (1,) else sentence("no")
    if measure.kind == "scale":
        return _any_of([spoken(measure.values[value]) for value in cell.values])
    (_, cuts), *_ = cell.variable.cuts
    return _any_of([_range(cuts, run[0], run[-1], measure.kind == "integer") for run in _runs(cell.values)])


def _order_words(cell: Cell) -> str:
    """``x is at most y``"""
    ((one, other),) = cell.variable.orders
    operators: Mapping[tuple[int, ...], Operator] = {
        (0,): "<",
        (0, 1): "<=",
        (1,): "=",
        (0, 2): "!=",
        (1, 2): ">=",
        (2,): ">",
    }
    return condition_words(Comparison(MeasureRef(one), operators[cell.values], MeasureRef(other)))


def _any_of(words: Sequence[str]) -> str:
    *most, last = words
    return sentence("{values} or {last}", values=joined(", ", most), last=last) if most else last


def _runs(values: Sequence[int]) -> Iterator[list[int]]:
    """The runs of consecutive numbers."""
    for _, run in groupby(enumerate(values), lambda pair: pair[1] - pair[0]):
        yield [value for _, value in run]


def _range(cuts: Sequence[Cut], first: int, last: int, whole: bool) -> str:
    """The numbers from region `first` to region `last`; region i is between cut i - 1 and cut i. Above 17, a `whole`
    number is at least 18."""
    low = cuts[first - 1] if first else None
    high = cuts[last] if last < len(cuts) else None
    if low is not None and whole:
        low = Cut(low.value + 1, False)
    if low is not None and high is not None and low.value == high.value:
        return sentence("exactly {value}", value=_number(low.value))
    parts = []
    if low is not None:
        above, least = sentence("above {value}", value=_number(low.value)), _number(low.value)
        parts.append(above if low.inclusive else sentence("at least {value}", value=least))
    if high is not None:
        most, below = sentence("at most {value}", value=_number(high.value)), _number(high.value)
        parts.append(most if high.inclusive else sentence("below {value}", value=below))
    return sentence("{low} and {high}", low=parts[0], high=parts[1]) if len(parts) == 2 else parts[0]


def _number(value: Rational) -> str:
    return value_text(value)


def decision_words(row: Row, ruleset: Ruleset) -> list[tuple[str, str]]:
    """For each rule that applies in a row, its label and what it requires."""
    return [(label, response_words(_clause(ruleset, label, number))) for label, number in row.deciding]


def _clause(ruleset: Ruleset, label: str, number: int) -> Clause:
    return next(islice(ruleset.by_label[label].clauses(), number, None))


def contradictions(row: Row, ruleset: Ruleset) -> list[str]:
    """The reasons why the responses of a row cannot be followed together."""
    return [sentence("Contradiction: {why}", why=reason(ruleset, one)) for one in row.inconsistent]


def reading_words(row: Row, ruleset: Ruleset) -> tuple[str, str]:
    """What the rule of a reading table requires as a cascade, and by priority."""
    found = [words for _, words in decision_words(row, ruleset)]
    if len(found) != 2:
        raise ValueError("a row of a reading table has a clause for each reading")
    return found[0], found[1]


def left_out(table: DecisionTable) -> Iterator[str]:
    """What a table does not show."""
    if table.why is not None and not table.rows:
        yield sentence("There is no table: {why}.", why=table.why)
    elif table.why is not None:
        yield sentence("Some of these situations may be impossible: {why}.", why=table.why)
    if table.total > len(table.rows):
        more = table.total - len(table.rows)
        yield plural(more, "{count} more row is left out.", "{count} more rows are left out.", count=grouped(more))
