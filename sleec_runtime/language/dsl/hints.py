"""Hints for the mistakes that people make in the DSL: what to write instead, by what is expected and what is found."""

from __future__ import annotations

from collections.abc import Mapping

DEFINITION_END = "the next definition"
CONDITION_END = "`and`, `or` or `then`"
OCCASION_END = "`and`, or `then` and a response"
RESPONSE_END = "`within`, `otherwise`, `unless` or the next rule"

RULE_EXAMPLE = "a rule looks like this: R1 when Event then Response"
RULE_START = f"{RULE_EXAMPLE}; its name has letters, digits and _ only"

REPLACEMENTS: Mapping[str, str] = {
    **dict.fromkeys(("&", "&&"), "write and"),
    **dict.fromkeys(("|", "||"), "write or"),
    "!": "write not, or <> between two values",
    "=>": "write >= to compare, or then before a response",
    "=<": "write <=",
    **dict.fromkeys((";", "."), "rules and definitions need no punctuation between them; delete it"),
    **dict.fromkeys(("#", "/"), "comments start with //"),
    "/*": "close this comment with */",
    **dict.fromkeys("\"'`\u2018\u2019\u201c\u201d\u00ab\u00bb", "write names without quotation marks"),
}
"""What to write instead of characters that the DSL does not use."""

SYNONYMS: Mapping[str, str] = {
    **dict.fromkeys(("if", "whenever", "once", "on"), "when"),
    **dict.fromkeys(("except", "but"), "unless"),
    **dict.fromkeys(("trigger", "action", "obligation", "response"), "event"),
    **dict.fromkeys(("condition", "variable", "var", "sensor", "state"), "measure"),
    **dict.fromkeys(("const", "let", "define"), "constant"),
}
"""Words that people write for a keyword whose spelling is not near."""

TYPE_SYNONYMS: Mapping[str, str] = {
    **dict.fromkeys(("bool", "truth", "flag"), "boolean"),
    **dict.fromkeys(("int", "integer", "number", "real", "float"), "numeric"),
}

_ONE_EVENT = "a response is one event: write one rule for each"
_USE_WITHIN = "use within to give a time: within 5 minutes"
_COMPARE = "compare with =, <>, <, <=, > or >=, for example: temperature > 30"
_USE_THEN = "write then before the response"
_COMPARING = (
    "is",
    "equals",
    "equal",
    "greater",
    "less",
    "more",
    "above",
    "below",
    "over",
    "under",
    "between",
    "exceeds",
)

_CONDITION_ENDS: Mapping[str, str] = {
    **dict.fromkeys(_COMPARING, _COMPARE),
    **dict.fromkeys(("->", "=>", ":", "do"), _USE_THEN),
    ",": "delete the comma; then comes before the response",
    "unless": "the response comes first: R1 when Event then Response unless condition",
}
_HINTS: Mapping[str, Mapping[str, str]] = {
    DEFINITION_END: {
        ",": "define each name separately",
        "by": "write as system or as environment",
        "=": "only a constant has a value; delete it",
    },
    CONDITION_END: _CONDITION_ENDS,
    OCCASION_END: {**_CONDITION_ENDS, "or": "one event triggers a rule: write one rule for each"},
    RESPONSE_END: {
        **dict.fromkeys(("in", "after", "before", "by", "with"), _USE_WITHIN),
        **dict.fromkeys(("and", ","), _ONE_EVENT),
    },
}


_EXAMPLES: Mapping[str, str] = {
    DEFINITION_END: "start a definition with event, measure or constant, for example: event SmokeDetected",
    CONDITION_END: "for example: R1 when Event then Response unless userAsleep then Wait",
    OCCASION_END: RULE_EXAMPLE,
    RESPONSE_END: RULE_EXAMPLE,
    "a condition": "for example: userAsleep, or temperature > 30",
    "a number or a name to compare with": "for example: temperature > 30",
    "a number or a measure": "for example: 2 * temperature",
    "the name of an event": "a name has letters, digits and _ only, for example: SmokeDetected",
}


def hint_for(expected: str, found: str, before: str) -> str | None:
    """The hint where `found` is instead of what is `expected`; `before` is the kind of the token before it."""
    hint = _HINTS.get(expected, {}).get(found.lower())
    if hint is None and before == "number" and expected in (CONDITION_END, OCCASION_END) and found != "then":
        return "numbers in conditions have no unit; delete it"
    return hint


def example_of(expected: str) -> str | None:
    """An example of what is expected."""
    return _EXAMPLES.get(expected)
