"""Metric temporal logic as text and as LaTeX."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.exchange.compilation import compile_to
from tests.support.cli import Cli

RULES = """def_start
  event A  event B  event C  event D
  measure busy: boolean  measure patience: numeric
def_end
rule_start
  R1 when A and {busy} then B within 2 minutes otherwise { C within [1, 2] hours unless {busy} then D }
  R2 when A then not B within {patience} minutes unless (not {busy}) then D eventually
rule_end
relation_start
  happenBefore A C
  when A then {busy} until B and (not {busy})
  when B and {busy} then {busy} for 10 seconds
relation_end
concern_start
  c1 exists A and {busy} while not B within 1 minutes
concern_end
"""

TEXT = """# R1, default
G ((A & busy) -> (F[0,120] B | ((!busy -> F[3720,7320] C) & (busy -> F[120,120] D))))
# R2, default
G ((A & busy) -> G[0,60*patience] !B)
# R2, hedge 1
G ((A & !busy) -> F D)
# happenBefore
G (C -> O A)
# when ... until
G (A -> (busy W (B & !busy)))
# when ... for
G ((B & busy) -> G[0,10) busy)
# concern c1: it occurs in a trace if
F ((A & busy) & G[0,60] !B)
"""


def test_every_construct_has_a_formula() -> None:
    assert compile_to(parse(RULES), "mtl") == TEXT


def test_latex_has_one_row_for_each_formula() -> None:
    rows = compile_to(parse(RULES), "mtl-latex").splitlines()
    assert rows[0] == r"\begin{align*}"
    assert rows[1] == (
        r"  & \Box ((\mathit{A} \land \mathit{busy}) \rightarrow (\Diamond_{[0,120]} \mathit{B} \lor "
        r"((\lnot \mathit{busy} \rightarrow \Diamond_{[3720,7320]} \mathit{C}) \land "
        r"(\mathit{busy} \rightarrow \Diamond_{[120,120]} \mathit{D})))) && \text{R1,\ default} \\"
    )
    assert len(rows) == 2 + TEXT.count("#")


def test_the_command_takes_rules_with_time(cli: Cli) -> None:
    ran = cli("compile", "rules.sleec", "--to", "mtl", files={"rules.sleec": RULES})
    assert (ran.code, ran.out) == (0, TEXT)


def test_a_response_without_a_window_has_the_meaning_that_is_asked_for() -> None:
    rules = parse("RULE a WHEN A THEN B AND NOT C")
    assert "G (A -> (B & !C))" in compile_to(rules, "mtl")
    assert "G (A -> (F B & G !C))" in compile_to(rules, "mtl", untimed="eventually")


def test_names_that_are_no_identifiers_are_quoted() -> None:
    rules = parse("RULE a WHEN G AND the user is asleep THEN F")
    assert 'G (("G" & "the user is asleep") -> "F")' in compile_to(rules, "mtl")
