"""The words that structure a text in the DSL."""

from __future__ import annotations

BLOCKS = {f"{name}_start": f"{name}_end" for name in ("def", "rule", "concern", "purpose", "relation")}
"""The keywords that open a block, each with the one that closes it."""

UNNAMED = "unnamed"
"""The kind of a ``when`` or ``exists`` that begins a rule or claim without a name."""

BLOCK_MARKS = frozenset(BLOCKS) | frozenset(BLOCKS.values())
DEFINITIONS = frozenset({"event", "measure", "constant"})
LEGOS_KEYWORDS = frozenset({"exists", "while", "meanwhile", "until", "for"})
"""Keywords of claims and relations, which only the LEGOS dialect has. In the SLEEC-TK dialect they can be names."""

KEYWORDS = (
    BLOCK_MARKS
    | DEFINITIONS
    | LEGOS_KEYWORDS
    | {"when", "then", "unless", "within", "otherwise", "else", "not", "and", "or", "eventually", "true", "false"}
)
EVENT_RELATIONS = frozenset({"witness", "equal", "mutualExclusive", "happenBefore"})
EFFECTS = frozenset({"causation", "includes", "forbid"})

UNFINISHED = DEFINITIONS | {
    *("when", "exists", UNNAMED, "then", "while", "until", "otherwise", "else", "unless", "within"),
    *("and", "or", "not", "operator", "+", "-", "*", "->", "(", "[", "{", ","),
}
"""The kinds of token that a name must follow."""

STATEMENTS = DEFINITIONS | {"label", "relation"}
LINE_STARTS = BLOCK_MARKS | STATEMENTS | {"unless"}
"""The kinds of token that start a line in printed text."""

ITEM_STARTS = BLOCK_MARKS | STATEMENTS | {UNNAMED, "end"}
"""The kinds of token that start a definition, a rule, a claim or a relation, or end a block."""
