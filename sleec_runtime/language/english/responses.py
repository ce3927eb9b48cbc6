"""Responses: obligations joined by AND, each with an optional time and alternatives, and chains of exceptions.

``OTHERWISE`` and ``ELSE`` belong to the nearest obligation before them, and take one obligation or a chain in
parentheses. Where a text is ambiguous, parentheses are required: for an AND after them,
and for a choice after IN WHICH CASE.
"""

from __future__ import annotations

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ALTERNATIVE_LEVELS, MAX_DEPTH
from sleec_runtime.language.english.keywords import ALTERNATIVES, IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.english.modal_verbs import STARTS, ModalVerb, modal_verb
from sleec_runtime.language.english.phrases import OBLIGATION
from sleec_runtime.language.english.windows import EnglishTimeParser
from sleec_runtime.model import Clause, Obligation, Span, Timing
from sleec_runtime.support.suggestions import edit_distance

RULE_STOPS = STATEMENTS | {"UNLESS"}
_Response = tuple[tuple[Obligation, ...], tuple[Clause, ...]]


class EnglishResponseParser(EnglishTimeParser):
    """Reads responses and hedges."""

    def hedge(self) -> Clause:
        """``UNLESS condition [IN WHICH CASE response]``."""
        first = self.at
        self.at += 1
        self.resolve = self.names.condition
        condition = self.formula()
        self.comma_before(IN_WHICH_CASE)
        obligations: tuple[Obligation, ...] = ()
        hedges: tuple[Clause, ...] = ()
        kind = self.kinds[self.at]
        if kind == IN_WHICH_CASE or kind == "IN":
            self._in_which_case()
            obligations, hedges = self._response_of_hedge()
        elif kind in ("WHICH", "CASE", "THEN", *ALTERNATIVES):
            self.expected(
                "IN WHICH CASE after the condition", "for example: UNLESS UserUndressed IN WHICH CASE RefuseRequest"
            )
        return Clause(condition, obligations, hedges, self.span(first), self.comments_of(first))

    def _in_which_case(self) -> None:
        self.at += 1
        if self.kinds[self.at - 1] == IN_WHICH_CASE:
            return
        for keyword in ("WHICH", "CASE"):
            at = self.at
            if self.kinds[at] == keyword:
                self.at += 1
            elif self.kinds[at] == "word" and edit_distance(self.token_text(at)[:20].upper(), keyword, 3) < 3:
                self.correct_keyword(at, keyword)
                self.at += 1
            else:
                self.problem(
                    f"expected {keyword}, but found {self.found(at)}",
                    self.token_span(at),
                    "write the three words IN WHICH CASE before the response",
                )

    def _response_of_hedge(self) -> _Response:
        in_parentheses = self.kinds[self.at] == "("
        # The printer may write parentheses around the rest, which is then one level deeper.
        self.depth += not in_parentheses
        obligations, hedges = self.response(of_hedge=True)
        self.depth -= not in_parentheses
        if len(obligations) > 1 and not hedges:
            self.check_room(self.depth)
        return obligations, hedges

    def response(self, of_hedge: bool = False, may_be_empty: bool = False) -> _Response:
        """Obligations, or a whole chain in parentheses, which may start with UNLESS if `may_be_empty`."""
        if self.kinds[self.at] != "(":
            return self._obligations([], of_hedge), ()
        obligations, hedges = self._in_parentheses(of_hedge or may_be_empty)
        if self.kinds[self.at] == "AND":
            if hedges:
                self.expected(
                    "the end of the response",
                    "a chain in parentheses must be the whole response; write another rule for the rest",
                )
            self.at += 1
            self.depth += of_hedge
            obligations = self._obligations(list(obligations), of_hedge)
            self.depth -= of_hedge
        return obligations, hedges

    def _in_parentheses(self, may_be_empty: bool) -> _Response:
        opened = self.at
        self.descend()
        self.at += 1
        obligations: tuple[Obligation, ...] = ()
        inner: tuple[Clause, ...] = ()
        if not may_be_empty or self.kinds[self.at] != "UNLESS":
            obligations, inner = self.response(may_be_empty=may_be_empty)
        hedges = list(inner)
        while self.kinds[self.at] == "UNLESS":
            if inner:
                self.expected("a closing parenthesis", "the exceptions of a chain must be inside the same parentheses")
            hedges.append(self.hedge())
        self._close(opened)
        return obligations, tuple(hedges)

    # Obligations ----------------------------------------------------------------------------------------------

    def _obligations(self, found: list[Obligation], of_hedge: bool = False) -> tuple[Obligation, ...]:
        first = self.at
        self._literals(found, of_hedge)
        while self.kinds[self.at] == "AND":
            is_worded_prohibition = found[-1].negated and self.kinds[first] == "word"
            first = self.at = self.at + 1
            if is_worded_prohibition:
                self._require_own_form(first, found[-1].name)
            self._literals(found, of_hedge)
        return tuple(found)

    def _require_own_form(self, first: int, forbidden: str) -> None:
        """Refuses ``must not shout AND run``: people read that both are forbidden, but NOT forbids only one."""
        while self.kinds[first] == "(":
            first += 1
        if self.kinds[first] == "word" and self._modal_verb_at(first) is None:
            name = self.name_at(first)
            self.problem(
                f"it is unclear whether {quoted(name)} is forbidden, too",
                self.token_span(first),
                f"write NOT {forbidden} AND NOT {name} to forbid both, or NOT {forbidden} AND {name} to require the "
                "second one",
            )

    def _literals(self, found: list[Obligation], of_hedge: bool) -> None:
        """One obligation, or several in parentheses."""
        first = self.at
        if self.kinds[first] != "(":
            obligation = self._literal()
            if of_hedge and is_choice(obligation):
                self.problem(
                    "this choice is ambiguous: it can belong to the exception or to the rule",
                    self.span(first),
                    "if it belongs to the exception, write parentheses: IN WHICH CASE (A ELSE B)",
                )
            found.append(obligation)
            return
        self.descend()
        self.at += 1
        self._obligations(found)
        if self.kinds[self.at] == "UNLESS":
            self.expected("a closing parenthesis", "a chain in parentheses must be the whole response")
        self._close(first)

    def _literal(self) -> Obligation:
        first = self.at
        negated = self.kinds[first] == "NOT"
        if negated:
            self.at += 1
            if self.kinds[self.at] in ("(", "NOT"):
                self.expected(
                    "the name of an obligation after NOT",
                    "write NOT A AND NOT B to forbid each, or NEVER A AND B to forbid both together",
                )
        at_name = self.at
        if self.kinds[at_name] != "word":
            self.refuse_name(OBLIGATION, self._hint_at_obligation())
        if not negated:
            negated = self._modal_verb()
            at_name = self.at
        name = self.name(OBLIGATION)
        if not name:
            return self._literal()
        span = self.span(at_name)
        if not self.has_failed:
            self.names.use("obligation", name, span)
        timed = self._timed(name, negated, first) if self.kinds[self.at] in _BEHIND_A_NAME else None
        return timed or Obligation(name, negated, self.span(first) if negated else span)

    def _modal_verb(self) -> bool:
        """Skips a modal verb before the name. Whether it forbids the obligation."""
        first = self.at
        found = self._modal_verb_at(first)
        if found is None:
            return False
        if self.kinds[first + found.words] != "word":
            span = Span(self.starts[first], self.ends[first + found.words - 1])
            written = quoted(self.text[span.start : span.end])
            self.fail(
                f"no obligation follows {written}", span, "write what the robot must do, or NOT and what it must not do"
            )
        self.at += found.words
        return found.forbids

    def _modal_verb_at(self, first: int) -> ModalVerb | None:
        """The modal verb at token `first`, unless the text has the whole phrase as a name outside responses, such as
        in a declaration."""
        if self.small_word(first) not in STARTS or self.name_at(first) in self.positions.outside_responses:
            return None
        end = first
        while self.kinds[end] in PHRASE or self.kinds[end] == "NOT":
            end += 1
        return modal_verb([self.small_word(token) for token in range(first, min(end, first + MAX_DEPTH))])

    def _timed(self, name: str, negated: bool, first: int) -> Obligation:
        """The obligation with the time and the alternatives at hand."""

        window = self.window()
        alternatives: dict[str, Clause] = {}
        for word in ("OTHERWISE", "ELSE"):
            if self.kinds[self.at] == word:
                self.at += 1
                alternatives[word] = self._alternative(word)
        if alternatives:
            self._end_of_alternatives(next(reversed(alternatives)))
        timing = Timing(window, alternatives.get("OTHERWISE"), alternatives.get("ELSE"))
        return Obligation(name, negated, self.span(first), timing)

    def _alternative(self, word: str) -> Clause:
        """What replaces an obligation: another one, or a chain in parentheses."""
        self.descend(ALTERNATIVE_LEVELS)
        first = self.at
        if self.kinds[first] != "(":
            if self.kinds[first] not in ("word", "NOT"):
                self.refuse_name(f"an obligation after {word}", f"for example: {word} CallForHelp")
            obligations: tuple[Obligation, ...] = (self._literal(),)
            hedges: tuple[Clause, ...] = ()
        else:
            self.depth -= 1  # these parentheses are one of the levels that were counted above
            obligations, hedges = self._in_parentheses(may_be_empty=False)
            self.depth += 1
        self.depth -= ALTERNATIVE_LEVELS
        return Clause(None, obligations, hedges, self.span(first))

    def _end_of_alternatives(self, word: str) -> None:
        """Refuses what could belong to the obligation or to its last alternative, after `word`."""
        kind = self.kinds[self.at]
        if kind in ALTERNATIVES:
            self.expected(
                "the end of the response",
                "an obligation has one OTHERWISE, then one ELSE; use parentheses to nest them",
            )
        if kind == "AND":
            self.expected(
                "the end of the response",
                f"{word} takes one obligation: write {word} (B AND C), or (A {word} B) AND C",
            )

    def _close(self, opened: int) -> None:
        if self.kinds[self.at] == "OR":
            self.refuse_choice()
        self.close(")", opened)
        self.depth -= 1

    # Small things ---------------------------------------------------------------------------------------------

    def check_room(self, depth: int) -> None:
        """Gives up if the printer's additional parentheses would nest too deeply to be parsed."""
        if depth >= MAX_DEPTH:
            self.too_deep()

    def comma_before(self, keyword: str) -> None:
        """Skips a comma before a clause, as in prose."""
        if self.kinds[self.at] == "," and self.kinds[self.at + 1] in (keyword, keyword[:2]):
            self.at += 1

    def refuse_choice(self) -> None:
        self.expected(
            "the end of the response",
            "join obligations with AND; write UNLESS to say when another one applies, or ELSE if either is enough",
        )

    def _hint_at_obligation(self) -> str | None:
        kind = self.kinds[self.at]
        if kind in ("AND", "OR", ")"):
            return f"an obligation is missing before {kind}" if kind != ")" else "the parentheses are empty"
        if kind == "end" or kind in RULE_STOPS:
            return "write what the robot must do, for example: THEN CallForHelp"
        return None


_BEHIND_A_NAME = frozenset({"WITHIN", "EVENTUALLY", "OTHERWISE", "ELSE"})


def is_choice(obligation: Obligation) -> bool:
    """Whether another response may replace an obligation from the start, and not only after its window."""
    timing = obligation.timing
    return timing is not None and (
        timing.instead is not None or (timing.otherwise is not None and timing.window is None)
    )
