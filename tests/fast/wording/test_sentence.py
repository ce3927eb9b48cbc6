"""Sentences are text in English that remembers what it is made of."""

from __future__ import annotations

import copy
import json
import pickle

from sleec_runtime.errors import SleecError
from sleec_verify.wording.phrases import counted, listed, quoted
from sleec_verify.wording.sentence import Sentence, joined, plural, sentence


def test_a_sentence_is_its_english_text() -> None:
    text = sentence("rule {rule} never applies", rule=quoted("{a}"))
    assert text == "rule `{a}` never applies"
    assert hash(text) == hash("rule `{a}` never applies")
    assert json.dumps([text]) == '["rule `{a}` never applies"]'


def test_the_number_selects_the_template() -> None:
    assert [plural(n, "{number} rule", "{number} rules") for n in (1, 2)] == ["1 rule", "2 rules"]
    assert [counted(n, "rule") for n in (0, 1, 2)] == ["no rules", "1 rule", "2 rules"]


def test_joined_is_join() -> None:
    for parts in ([], ["a"], ["a", "{b}", "c"]):
        assert joined("; {", parts) == "; {".join(parts)


def test_copies_and_messages_keep_the_template() -> None:
    text = plural(2, "{names} occurs", "{names} occur", names=listed(["a", "b"]))
    for other in (str(text), copy.deepcopy(text), pickle.loads(pickle.dumps(text)), SleecError(text).message):
        assert isinstance(other, Sentence)
        assert isinstance(other.values["names"], Sentence)
        assert (other, other.many) == (text, "{names} occur")
