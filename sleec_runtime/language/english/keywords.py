"""The words in capitals that structure a text of rules."""

from __future__ import annotations

DECLARATIONS = frozenset({"MEASURE", "CONSTANT", "TRIGGER", "CONDITION", "OBLIGATION", "EVENT"})
OPENINGS = frozenset({"WHEN", "IF"})
RULE_STARTS = OPENINGS | {"RULE"}
SETTINGS = frozenset({"DOMAIN", "READING"})
CLAIMS = frozenset({"CONCERN", "PURPOSE"})
STATEMENTS = DECLARATIONS | RULE_STARTS | SETTINGS | CLAIMS | {"ALWAYS", "EXCLUSIVE", "NEVER", "ASSUME", "RELATION"}
"""The keywords that start a statement; the one before it ends there."""

TIMES = frozenset({"WITHIN", "EVENTUALLY"})
ALTERNATIVES = frozenset({"OTHERWISE", "ELSE"})
IN_WHICH_CASE = "IN WHICH CASE"
_OCCASIONS = frozenset({"EXISTS", "WHILE", "MEANWHILE", "UNTIL"})
KEYWORDS = (
    STATEMENTS | TIMES | ALTERNATIVES | _OCCASIONS | {"THEN", "UNLESS", "IN", "WHICH", "CASE", "AND", "OR", "NOT"}
)

GUESSED = KEYWORDS - _OCCASIONS - {"EVENT", "RELATION", "ELSE"}
"""The keywords that a word in capitals may be a misspelling of. WHITE and VENT in a phrase are not misspellings."""

RELATION_WORDS = frozenset(
    {"ALWAYS", "FOR", "WITNESSES", "EQUALS", "EXCLUDES", "PRECEDES", "CAUSES", "INCLUDES", "FORBIDS"}
    | {"IMPLIES", "OPPOSES"}
)
"""Keywords in a RELATION, and plain words everywhere else, except that ALWAYS also starts a statement; likewise BY
after EVENT and TO after WITHIN."""

OCCASION = "when"
"""The kind of a WHEN or IF inside a concern, purpose or relation, where it starts neither a rule nor a line."""

LINE_STARTS = STATEMENTS | {"UNLESS"}
"""The keywords that start a line in printed text."""

PHRASE = frozenset({"word", "number", "digits"})
"""The kinds of token that may follow the first word of a phrase."""
