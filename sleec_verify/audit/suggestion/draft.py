"""A draft of a mapping file: a line for each name of the rules, with its similarity."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from sleec_runtime.model import Ruleset
from sleec_runtime.support.messages import escaped
from sleec_verify.audit.suggestion.candidates import Candidate, CandidateForm, candidates, stems_of
from sleec_verify.audit.suggestion.log_topics import Topic
from sleec_verify.audit.suggestion.similarity import ABOVE, BELOW, Similarity

_LIKELY, _POSSIBLE = 0.8, 0.5
"""The least similarity of a likely and of a possible suggestion."""
_CLEAR = 0.04
"""The least margin of a likely suggestion over the second."""

_HEAD = """\
# A draft: it compares only the words of names. Check each line before you rely on an audit with it.
# likely: all words fit; the line is active. possible: some words fit; remove the # to use the line.
# no suggestion: fill in the topic and the field.
"""
_FORMS: Mapping[str, tuple[CandidateForm, ...]] = {
    "conditions": ("truth", "value", "number"),
    "measures": ("number",),
    "scales": ("text",),
    "events": ("action", "truth", "value", "message", "number"),
    "obligations": ("action", "truth", "value", "message", "number"),
}
_TO_FILL = {
    "conditions": '{topic = "…", field = "…"}',
    "measures": '{topic = "…", field = "…"}',
    "scales": '{topic = "…", field = "…", values = {…}}',
    "events": '{topic = "…"}',
    "obligations": '{action = "…", goal = "succeeded"}',
}
_BARE = re.compile("[A-Za-z0-9_-]+")


class _Suggestion(NamedTuple):
    """An entry of a mapping, and the remaining manual step; empty if there is none."""

    entry: str
    score: float
    values: str
    to_do: str


def draft(topics: Mapping[str, Topic], ruleset: Ruleset, log: str) -> str:
    """A mapping for a ruleset, as TOML. Only likely suggestions without anything to fill in are active lines."""
    return "".join(f"{line}\n" for line in _lines(topics, ruleset, log))


def _lines(topics: Mapping[str, Topic], ruleset: Ruleset, log: str) -> Iterator[str]:
    found = list(candidates(topics.values()))
    obligations = sorted(ruleset.obligations)
    events = sorted(ruleset.triggers - ruleset.obligations)
    named = (*ruleset.conditions, *ruleset.measures, *events, *obligations)
    similarity = Similarity(named, found)
    yield f"# The mapping of {_comment(log)} to the names in {_comment(ruleset.source.path)}."
    yield from _HEAD.splitlines()
    used: set[str] = set()
    if ruleset.domains:
        yield ""
        domain = _domain(found, ruleset.domains)
        used.update([] if domain is None else [domain.topic])
        yield _domain_line(domain, ruleset.domains)
    scales = {name for name, measure in ruleset.measures.items() if measure.kind == "scale"}
    for table, names in (
        ("conditions", sorted(ruleset.conditions)),
        ("measures", sorted(ruleset.measures)),
        ("events", events),
        ("obligations", obligations),
    ):
        if names:
            yield ""
            yield f"[{table}]"
        for name in names:
            kind = "scales" if name in scales else table
            scale = ruleset.measures[name].values if name in scales else ()
            best = _best(name, kind, scale, found, similarity)
            used.update(suggestion[1].topic for suggestion in best[:1])
            yield from _name_lines(name, kind, [suggestion for suggestion, _ in best])
    yield from _live_topics(topics, used)
    yield from _other_topics(topics, used)


def _best(
    name: str, kind: str, scale: Sequence[str], found: Sequence[Candidate], similarity: Similarity
) -> list[tuple[_Suggestion, Candidate]]:
    """At most three suggestions for a name, the best one first, one for each topic and field."""
    scored = [
        (-score, _FORMS[kind].index(found[number].form), number)
        for score, number in similarity.scores(name, _FORMS[kind])
        if score >= _POSSIBLE
    ]
    best: dict[tuple[str, str | None], tuple[_Suggestion, Candidate]] = {}
    for negative, _, number in sorted(scored):
        candidate = found[number]
        if candidate.form == "message" and any(topic == candidate.topic for topic, _ in best):
            continue  # A field of these messages fits as well.
        suggestion = _suggestion(name, kind, scale, candidate, -negative)
        best.setdefault((candidate.topic, candidate.path), (suggestion, candidate))
    return list(best.values())[:3]


def _suggestion(name: str, kind: str, scale: Sequence[str], candidate: Candidate, score: float) -> _Suggestion:
    if candidate.form == "action":
        state = "succeeded" if kind == "obligations" else "accepted"
        return _Suggestion(f"{{action = {_text(candidate.topic)}, goal = {_text(state)}}}", score, candidate.values, "")
    parts = [f"topic = {_text(candidate.topic)}"]
    to_do = ""
    if candidate.path is not None:
        parts.append(f"field = {_text(candidate.path)}")
    if candidate.form == "message" and candidate.texts:
        to_do = "each message counts, whatever its field values"
    elif candidate.form == "value":
        assert candidate.equals is not None
        parts.append(f"equals = {_text(candidate.equals)}")
    elif candidate.form == "number" and kind != "measures":
        parts.append(f"{'above' if stems_of(name) & ABOVE and not stems_of(name) & BELOW else 'below'} = 0")
        to_do = "set the bound"
    elif kind == "scales":
        values = {one: text for one in scale for text in candidate.texts if stems_of(text) & stems_of(one)}
        if tuple(values) != tuple(candidate.texts):
            written = ", ".join(f"{_key(one)} = {_text(values.get(one, ''))}" for one in scale)
            parts.append(f"values = {{{written}}}")
            to_do = "" if len(values) == len(scale) == len(set(values.values())) else "complete the values"
    return _Suggestion(f"{{{', '.join(parts)}}}", score, candidate.values, to_do)


def _name_lines(name: str, kind: str, best: Sequence[_Suggestion]) -> Iterator[str]:
    key = _key(name)
    if not best:
        yield f"# no suggestion: {key} = {_TO_FILL[kind]}"
        return
    first, *others = best
    is_clear = all(first.score - other.score >= _CLEAR for other in others)
    is_likely = first.score >= _LIKELY and is_clear
    sure = f"{'likely' if is_likely else 'possible'}, {first.score:.0%} alike; in the log: {_comment(first.values)}"
    to_do = f"; {first.to_do}" if first.to_do else ""
    active = "" if is_likely and not first.to_do else "# "
    yield f"{active}{key} = {first.entry}  # {sure}{to_do}"
    for other in others:
        if first.score - other.score < 3 * _CLEAR:
            to_do = f"; {other.to_do}" if other.to_do else ""
            seen = f"in the log: {_comment(other.values)}"
            yield f"#   or {key} = {other.entry}  # {other.score:.0%} alike; {seen}{to_do}"


def _domain(found: Iterable[Candidate], domains: Sequence[str]) -> Candidate | None:
    """The field whose texts are names of domains."""
    return max(
        (candidate for candidate in found if candidate.form == "text" and set(candidate.texts) & set(domains)),
        key=lambda candidate: len(set(candidate.texts) & set(domains)) - len(set(candidate.texts) - set(domains)),
        default=None,
    )


def _domain_line(best: Candidate | None, domains: Sequence[str]) -> str:
    if best is None or best.path is None:
        return '# no suggestion: domain = {topic = "…", field = "…"}'
    sure = "likely" if set(best.texts) <= set(domains) else "possible"
    entry = f"{{topic = {_text(best.topic)}, field = {_text(best.path)}}}"
    return f"{'' if sure == 'likely' else '# '}domain = {entry}  # {sure}; in the log: {_comment(best.values)}"


def _live_topics(topics: Mapping[str, Topic], used: set[str]) -> Iterator[str]:
    types = [(name, topics[name].type) for name in sorted(used & topics.keys())]
    lines = [f"{_text(name)} = {{type = {_text(kind)}}}" for name, kind in types if kind is not None]
    if lines:
        yield ""
        yield "# A monitor needs the types. For a topic with best-effort publishers, add reliable = false."
        yield "[topics]"
        yield from lines


def _other_topics(topics: Mapping[str, Topic], used: set[str]) -> Iterator[str]:
    others = [
        f"#   {_comment(topic.name)} ({_comment(topic.type or 'no type')}): {_comment(', '.join(topic.fields)) or '-'}"
        for topic in topics.values()
        if not any(topic.name == one or topic.name.startswith(f"{one}/_action/") for one in used)
    ]
    if others:
        yield ""
        yield "# Topics without a suggestion, with their fields:"
        yield from others


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _text(name)


def _text(text: str) -> str:
    """A TOML string. JSON escapes are valid there, except those of surrogates."""
    clean = text.encode("utf-8", "replace").decode()
    return json.dumps(clean, ensure_ascii=False).replace("\x7f", "\\u007f")


def _comment(text: str) -> str:
    return escaped(text if len(text) <= 200 else f"{text[:200]}…")
