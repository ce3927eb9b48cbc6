"""Every sentence has a translation into every language, and output for programs has none."""

from __future__ import annotations

import ast
import json

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.wording.catalogue import catalogue_of, read_catalogue
from sleec_verify.wording.phrases import counted, grouped, listed
from sleec_verify.wording.sentence import Sentence, plural, sentence
from sleec_verify.wording.translation import LANGUAGES, Language, translated
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.templates import PLACEHOLDER, templates

OTHERS = [language for language in LANGUAGES if language != "en"]
CLASH = "RULE a\nWHEN UserCalls THEN Answer\nRULE b\nWHEN UserCalls AND Asleep THEN NOT Answer\n"


@pytest.mark.parametrize("language", OTHERS)
def test_the_catalogue_has_exactly_the_templates_of_the_code(language: str) -> None:
    known = {one for pair in templates().items() for one in pair if one is not None}
    assert catalogue_of(language).keys() == known


@pytest.mark.parametrize("language", OTHERS)
def test_translations_have_the_placeholders_and_the_ends_of_their_templates(language: str) -> None:
    for template, words in catalogue_of(language).items():
        # "The one rule" need not say the number.
        optional = {"number"} if templates().get(template) is not None else set()
        assert set(PLACEHOLDER.findall(words)) | optional == set(PLACEHOLDER.findall(template)) | optional, template
        assert "{" not in PLACEHOLDER.sub("", words), words
        assert [words[:1].isspace(), words[-1:].isspace()] in (
            [template[:1].isspace(), template[-1:].isspace()],
            [words[:1] == " ", template[-1:].isspace()],
            [False, template[-1:].isspace()],
        )


def test_values_are_translated_and_names_are_not() -> None:
    text = sentence("rule {rule} never applies", rule="`true`")
    assert translated(text, "it") == "la regola `true` non si applica mai"
    nested = plural(2, "{names} is required", "{names} are required", names=listed(["`a`", "`b`"]))
    assert translated(nested, "de") == "`a` und `b` sind geboten"
    assert [translated(counted(n, "rule"), "de") for n in (0, 1, 2)] == ["keine Regeln", "1 Regel", "2 Regeln"]
    assert [translated(grouped(1_234_567), language) for language in LANGUAGES] == [
        "1,234,567",
        "1.234.567",
        "1.234.567",
    ]
    assert translated("rule {rule} never applies", "it") == "rule {rule} never applies"
    assert translated(text, "en") is text


def test_catalogues_are_read_as_po_files() -> None:
    text = (
        '# a comment\nmsgid ""\nmsgstr ""\n"Language: it\\n"\n\n'
        'msgid "a \\"quoted\\" "\n"line"\nmsgstr "una "\n"riga"\n\n'
        'msgid "one"\nmsgid_plural "many"\nmsgstr[0] "uno"\nmsgstr[1] "molti"\n\nmsgid "open"\nmsgstr ""\n'
    )
    assert read_catalogue(text) == {'a "quoted" line': "una riga", "one": "uno", "many": "molti"}
    with pytest.raises(ValueError, match="not a line of a PO file: msg"):
        read_catalogue('msg "one"\n')


@pytest.mark.parametrize(
    ("language", "words"),
    [
        ("it", "la regola `a` e la regola `b` si contraddicono: `Answer` è obbligatorio e vietato allo stesso tempo"),
        ("de", "Regel `a` und Regel `b` widersprechen einander: `Answer` ist zugleich geboten und verboten"),
    ],
)
def test_check_says_findings_in_a_language(
    language: Language, words: str, cli: Cli, monkeypatch: pytest.MonkeyPatch
) -> None:
    for form in ("full", "concise"):
        ran = cli("check", "--format", form, "--language", language, "a.sleec", files={"a.sleec": CLASH})
        assert words in ran.out
    monkeypatch.setenv("SLEEC_VERIFY_LANGUAGE", language)
    assert words in cli("check", "a.sleec").out
    for form in ("json", "sarif"):
        ran = cli("check", "--format", form, "a.sleec")
        assert json.loads(ran.out)
        assert "contradict each other" in ran.out
    assert cli("check", "--language", "en", "a.sleec").out.startswith("a.sleec:2:1: error[SLEEC101] rule `a` and")


def test_the_cache_keeps_what_can_be_translated(
    cli: Cli, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", str(tmp_path_factory.mktemp("cache")))
    first = cli("check", "a.sleec", "--language", "it", files={"a.sleec": CLASH})
    assert cli("check", "a.sleec", "--language", "it").out == first.out
    assert "si contraddicono" in first.out


def test_explain_speaks_a_language(cli: Cli) -> None:
    ran = cli("explain", "a.sleec", "--when", "UserCalls", "--language", "de", files={"a.sleec": CLASH})
    assert "`UserCalls` löst Regel `a` aus: `Answer` ist geboten (Zeile 2)." in ran.out
    assert "Geboten: Answer" in ran.out


@pytest.mark.parametrize("code", sorted(kind.code for check in CHECKS.values() for kind in check.kinds))
def test_every_text_of_a_finding_can_be_translated(code: str) -> None:
    """Except those of the check `defect`, which the parser writes."""
    check, kind = next((check, kind) for check in CHECKS.values() for kind in check.kinds if kind.code == code)
    (result,) = run_checks(parse(kind.bad), [check.name])
    assert result.findings
    for finding in result.findings:
        for text in (finding.message, finding.note, finding.help, *(word for _, word in finding.related)):
            assert text is None or isinstance(text, Sentence) or check.name == "defect", text


@pytest.mark.parametrize(
    ("language", "words"),
    [
        (
            "it",
            (
                "nuovo conflitto: `a` e `b`: `Answer` è ora obbligatorio e vietato allo stesso tempo",
                "      prima   Answer, secondo la regola `a` (old.sleec:2)\n",
                "      dopo    Answer, secondo la regola `a` (a.sleec:2)\n",
                "nomi nuovi: `Asleep` (condizione)",
            ),
        ),
        (
            "de",
            (
                "neuer Konflikt: `a` und `b`: `Answer` ist jetzt zugleich geboten und verboten",
                "      vorher  Answer (Regel `a`, old.sleec:2)\n",
                "neue Namen: `Asleep` (Bedingung)",
            ),
        ),
    ],
)
def test_diff_and_entail_answer_in_a_language(language: Language, words: tuple[str, ...], cli: Cli) -> None:
    files = {"old.sleec": CLASH.split("RULE b")[0], "a.sleec": CLASH}
    ran = cli("diff", "old.sleec", "a.sleec", "--language", language, files=files)
    for phrase in words:
        assert phrase in ran.out
    required = {"it": "obbligatorio: Answer\n", "de": "geboten: Answer\n"}[language]
    assert cli("entail", "old.sleec", "--when", "UserCalls", "--language", language).out.startswith(required)
    for command in (("diff", "old.sleec", "a.sleec"), ("entail", "a.sleec", "--when", "UserCalls")):
        english = cli(*command, "--format", "json").out
        assert cli(*command, "--format", "json", "--language", language).out == english


PATIENCE = """\
MEASURE patience: integer
RULE a WHEN Fall THEN CallNurse WITHIN patience minutes
RULE b WHEN Alarm THEN NOT CallNurse WITHIN 3 minutes
"""


@pytest.mark.parametrize(
    ("language", "why", "note"),
    [
        ("it", "niente limita `patience`", "il confronto riguarda le risposte di ogni regola"),
        ("de", "nichts begrenzt `patience`", "der Vergleich umfasst die Reaktionen jeder Regel"),
    ],
)
def test_what_is_unknown_or_left_out_is_said_in_a_language(language: Language, why: str, note: str, cli: Cli) -> None:
    files = {"old.sleec": PATIENCE.replace("3", "4"), "a.sleec": PATIENCE}
    for form in ("full", "concise"):
        ran = cli("check", "a.sleec", "--format", form, "--language", language, files=files)
        assert ran.out.count(why) == 3
        assert "nothing bounds" not in ran.out
    ran = cli("diff", "old.sleec", "a.sleec", "--language", language)
    assert why in ran.out
    assert note in ran.out


@pytest.mark.parametrize("form", ["full", "concise"])
def test_entail_says_a_conflict_in_a_language(form: str, cli: Cli) -> None:
    situation = ("--when", "UserCalls", "--given", "Asleep")
    ran = cli("entail", "a.sleec", *situation, "--language", "de", "--format", form, files={"a.sleec": CLASH})
    assert "contradict" not in ran.out
    assert "wider" in ran.out


@pytest.mark.parametrize(
    "error", ["Undecided", "OutOfBudget", "TooEntangled", "NotCalculated", "TooLarge", "Undecidable"]
)
def test_every_reason_for_an_unknown_answer_can_be_translated(error: str) -> None:
    """Where a reason is made, it is a sentence. Elsewhere it is passed on."""
    places = []
    for path in sorted((ROOT / "sleec_verify").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == error:
                places.append(node)
                assert not any(isinstance(one, (ast.Constant, ast.JoinedStr)) for one in node.args), (path, node.lineno)
    assert places


@pytest.mark.parametrize(
    "command",
    [
        ("check", "a.sleec", "-o", "out.txt"),
        ("check", "a.sleec", "--svg", "out.txt", "--format", "concise"),
        ("report", "a.sleec", "-o", "out.txt", "--no-repairs"),
    ],
)
def test_what_was_written_is_said_in_a_language(command: tuple[str, ...], cli: Cli) -> None:
    ran = cli(*command, "--language", "de", files={"a.sleec": CLASH})
    assert ran.err in ("out.txt: 1 Regelwerk: 2 Fehler, keine Warnungen, keine Hinweise\n", "out.txt: 3 Bilder\n")
