"""The report as Markdown, for pull requests: the verdicts, the findings with their repairs, and the tables."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import escaped
from sleec_verify import __version__
from sleec_verify.report.document.changes import changes, summary
from sleec_verify.report.document.findings import (
    SEVERITY_WORDS,
    NumberedFinding,
    details,
    numbered,
    place_words,
    steps,
)
from sleec_verify.report.document.table_words import (
    cell_words,
    column_words,
    contradictions,
    decision_words,
    left_out,
    reading_words,
)
from sleec_verify.report.document.verdict import (
    STANDING_WORDS,
    conditions_of_validity,
    fingerprint,
    headline,
    repetition,
    verdicts,
)
from sleec_verify.report.outcome import UnusableInput
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import error_summary, listed
from sleec_verify.wording.plain_language import trigger_words
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.translation import Language, translated

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_verify.decision_tables.table import DecisionTable, Row
    from sleec_verify.report.document.content import Content

_SPECIAL = str.maketrans({character: f"\\{character}" for character in "\\`*_{}[]<>#|~!"})
_LINKED = re.compile(r"@|#|(?<=GH)-|(?<=www)\.|:(?=//)", re.IGNORECASE)
_NAME = re.compile(r"`([^`]+)`")


def render(contents: Sequence[Content | UnusableInput], language: Language) -> Iterator[str]:
    """The report, line by line."""
    markdown = _Markdown(language)
    yield from (f"{line}\n" for line in markdown.report(contents))


class _Markdown:
    """Markdown in one language. Nothing in a name, path or message is interpreted as Markdown or HTML."""

    def __init__(self, language: Language) -> None:
        self._language = language

    def _text(self, words: str) -> str:
        """Words in one line, with the names in backticks as code."""
        before, *rest = _NAME.split(escaped(translated(words, self._language)))
        parts = [_plain(before)]
        for name, after in zip(rest[::2], rest[1::2]):
            parts += (_code(name), _plain(after))
        return "".join(parts)

    def report(self, contents: Sequence[Content | UnusableInput]) -> Iterator[str]:
        for one in contents:
            if isinstance(one, UnusableInput):
                nothing = sentence("Nothing was checked, because these rules cannot be read.")
                yield from (f"## {_code(one.path)}", "", f"> **{self._text(nothing)}**", "")
                yield from (f"- {self._text(words)}" for words in _problems(one.error))
                yield ""
            else:
                yield from self._ruleset(one)
        yield self._text(sentence("Made by sleec-verify {version}.", version=__version__))

    def _ruleset(self, content: Content) -> Iterator[str]:
        yield from (f"## {_code(content.ruleset.source.path)}", "", f"> **{self._text(headline(content))}**", "")
        found = numbered(content.outcome)
        for one in found:
            yield from self._finding(one)
        yield from self._folded(sentence("The verdicts"), self._verdicts(content))
        telling = [shown for shown in content.rule_tables.values() if len(shown.rows) > 1 or shown.why]
        tables = [line for shown in telling for line in self._decisions(shown, content)]
        yield from self._folded(sentence("What each rule requires in each situation"), tables)
        yield from self._folded(sentence("Rules with the same trigger, together"), list(self._together(content)))
        readings = [line for shown in content.reading_tables.values() for line in self._readings(shown, content)]
        yield from self._folded(sentence("Where the readings differ"), readings)
        if content.base is not None:
            lines = [self._text(summary(content.base.compared)), ""]
            lines += (f"- {self._text(words)}" for words in changes(content.base.compared))
            yield from self._folded(sentence("What changed since {version}", version=content.base.name), lines)
        if content.certificate:
            lines = [f"- {_plain(escaped(line))}" for line in content.certificate]
            yield from self._folded(sentence("The certificate"), lines)

    def _folded(self, title: str, lines: Sequence[str]) -> Iterator[str]:
        if lines:
            # In a line of HTML, backslashes escape nothing.
            summary = _inert(escape(escaped(translated(title, self._language)), quote=False))
            yield from (f"<details><summary>{summary}</summary>", "", *lines, "", "</details>", "")

    def _finding(self, one: NumberedFinding) -> Iterator[str]:
        severity = self._text(SEVERITY_WORDS[one.finding.severity])
        place = self._text(place_words(one))
        yield f"{one.number}. **{severity}** ({place}): {self._text(one.finding.message)}"
        for title, text in details(one.finding):
            yield f"   - {self._text(title)}: {self._text(text)}"
        yield from (f"   - {self._text(line).strip()}" for line in steps(one.finding))
        if one.repairs is not None:
            from sleec_verify.report.repair_phrases import effect_in_words

            reason = one.repairs.undecided or one.repairs.reason
            if reason is not None and not one.repairs.repairs:
                why = sentence("No repair is shown: {why}.", why=reason)
                yield f"   - {self._text(why)}"
            for _, repair in one.repairs.repairs:
                yield f"   - {self._text(sentence('Repair'))}: {self._text(repair.candidate.title)}"
                yield f"     {self._text(sentence('Effect: {effect}.', effect=effect_in_words(repair)))}"
        yield ""

    def _verdicts(self, content: Content) -> list[str]:
        heads = (sentence("What was examined"), sentence("Verdict"), sentence("Reason"))
        rows = [(one.statement, STANDING_WORDS[one.standing], one.reason or "") for one in verdicts(content)]
        lines = [*self._table(heads, rows), ""]
        lines += [f"- {self._text(words)}" for words in conditions_of_validity(content)]
        lines.append(f"- SHA-256: `{fingerprint(content.ruleset)}`")
        lines.append(f"- {_code(repetition(content))}")
        return lines

    def _decisions(self, shown: DecisionTable, content: Content) -> Iterator[str]:
        def decision(row: Row) -> list[str]:
            words = [
                sentence("{rule}: {response}", rule=spoken(label), response=response)
                for label, response in decision_words(row, content.ruleset)
            ]
            if not words:
                is_one = len(shown.rules) == 1
                words = [sentence("the rule does not apply") if is_one else sentence("no rule applies")]
            return [joined("; ", [*words, *contradictions(row, content.ruleset)])]

        yield from self._situations(shown, content, (sentence("Then"),), decision)

    def _together(self, content: Content) -> Iterator[str]:
        for domains, shown in content.trigger_tables:
            if domains:
                yield from (self._text(sentence("In {domains}:", domains=listed(domains))), "")
            yield from self._decisions(shown, content)

    def _readings(self, shown: DecisionTable, content: Content) -> Iterator[str]:
        heads = sentence("Read as a cascade"), sentence("Read by priority")
        yield from self._situations(shown, content, heads, lambda row: list(reading_words(row, content.ruleset)))

    def _situations(
        self, shown: DecisionTable, content: Content, heads: Sequence[str], decision: Callable[[Row], list[str]]
    ) -> Iterator[str]:
        event = trigger_words(shown.trigger)
        title = sentence("When {event}", event=event)
        if len(shown.rules) == 1:
            title = sentence("Rule {rule} when {event}", rule=spoken(shown.rules[0]), event=event)
        yield from (f"**{self._text(title)}**", "")
        rows = []
        for row in shown.rows:
            cells = {cell.variable: cell_words(cell, content.ruleset) for cell in row.cells}
            situation = [cells.get(variable, "–") for variable in shown.variables] or [sentence("in every situation")]
            rows.append([*situation, *decision(row)])
        if rows:
            columns = [*map(column_words, shown.variables)] or [sentence("Situation")]
            yield from (*self._table([*columns, *heads], rows), "")
        for note in left_out(shown):
            yield from (self._text(note), "")

    def _table(self, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
        for line in (heads, ["---"] * len(heads), *rows):
            cells = (cell if line[0] == "---" else self._text(cell) for cell in line)
            yield f"| {' | '.join(cells)} |"


def _problems(error: SleecError) -> list[str]:
    """The problems of a text with their lines, or why there is no text."""
    from sleec_runtime.errors import LanguageError

    if not isinstance(error, LanguageError):
        return [error_summary(error)]
    return [
        sentence("line {line}: {problem}", line=error.source.place(one.span).line, problem=one.message)
        for one in error.problems
    ]


def _plain(text: str) -> str:
    return _inert(text.translate(_SPECIAL).replace("&", "&amp;"))


def _inert(text: str) -> str:
    """The text with invisible spaces where services make links to people, issues or pages."""
    return _LINKED.sub("\\g<0>\u200b", text)


def _code(text: str) -> str:
    """Inline code. Characters that would end the code or a cell are replaced."""
    cleaned = escaped(text).replace("`", "'").replace("|", "¦")
    return f"`{cleaned}`"
