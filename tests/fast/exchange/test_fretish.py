"""FRETish: a sentence for each clause, and a comment with the reason where there is none."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.exchange.compilation import compile_to

RULES = """def_start
  event Fall  event Call  event Ring  event A
  measure busy: boolean  measure risk: scale(low, high)
def_end
rule_start
  R1 when Fall and {busy} then Call within 2 minutes unless ({risk} = high) then not Ring within 10 seconds
  R2 when Fall then Call within [1, 2] minutes
  R3 when Fall then Call within 1 minutes else not A within 5 seconds
  R4 when Call then Ring within 2 seconds otherwise A
  R5 when A then Ring eventually
rule_end
relation_start
  witness Fall Ring
  causation Ring {busy}
  happenBefore Fall Call
  when Fall then {busy} until Call and {busy}
relation_end
purpose_start
  p1 exists Fall
purpose_end
"""

TEXT = """# one time point is one second; an event is a signal that is true when the event occurs
# is_A stands for: A
# risk: 0 = low, 1 = high
# R1, default
Whenever (Fall & busy & !(risk = 1)) the robot shall within 120 seconds satisfy Call
# R1, hedge 1
Whenever (Fall & busy & (risk = 1)) the robot shall for 10 seconds satisfy !Ring
# R2, default: not in FRETish: a window opens after the trigger
# R3, default
Whenever Fall the robot shall immediately satisfy (occurs(60, Call) | persists(5, !is_A))
# R4, default: not in FRETish: a window opens after the trigger
# R5, default
Whenever is_A the robot shall eventually satisfy Ring
# witness
The robot shall always satisfy (!Fall | Ring)
# causation: not in FRETish: it requires an event at each instant at which a condition is true
# happenBefore: not in FRETish: it requires an earlier event
# when ... until
Whenever Fall the robot shall until (Call & busy) satisfy busy
# purpose p1: not in FRETish: it is a question
"""


def test_every_statement_has_a_sentence_or_a_reason() -> None:
    assert compile_to(parse(RULES), "fretish") == TEXT


def test_names_stay_different() -> None:
    text = compile_to(parse("RULE r WHEN fire alarm THEN fire_alarm AND Until"), "fretish")
    assert "# fire_alarm_2 stands for: fire alarm\n# is_Until stands for: Until\n" in text
    assert "Whenever fire_alarm_2 the robot shall immediately satisfy fire_alarm\n" in text
