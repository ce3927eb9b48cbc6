"""The words in capitals that structure a text of rules."""

from __future__ import annotations

DECLARATIONS = frozenset({"MEASURE", "CONSTANT", "TRIGGER", "CONDITION", "OBLIGATION"})
RULE_STARTS = frozenset({"RULE", "WHEN", "IF"})
SETTINGS = frozenset({"DOMAIN", "READING"})
STATEMENTS = DECLARATIONS | RULE_STARTS | SETTINGS | {"EXCLUSIVE", "NEVER", "ASSUME", "CONCERN", "PURPOSE"}
"""The keywords that start a statement; the one before it ends there."""

TIMES = frozenset({"WITHIN", "OTHERWISE", "EVENTUALLY"})
IN_WHICH_CASE = "IN WHICH CASE"
KEYWORDS = STATEMENTS | TIMES | {"THEN", "UNLESS", "IN", "WHICH", "CASE", "AND", "OR", "NOT"}

LINE_STARTS = STATEMENTS | {"UNLESS"}
"""The keywords that begin a line where the printer writes one."""

PHRASE = frozenset({"word", "number", "digits"})
"""The kinds of token that may follow the first word of a phrase."""
