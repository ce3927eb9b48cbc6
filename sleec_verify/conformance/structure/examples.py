"""The rules and the robot that the examples of the finding kinds are made from, by a change each."""

from __future__ import annotations

RULES_FILE, CODE_FILE = "# rules.sleec\n", "# robot.py\n"
"""The lines that begin the two files of an example. Both languages take them for comments."""

RULES = """\
RULE curtains WHEN CurtainRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest AND ExplainWhy
"""
SECOND_HEDGE = "UNLESS UserDistressed IN WHICH CASE OpenCurtains\n"
SECOND_RULE = "RULE blinds WHEN BlindsRequest THEN OpenCurtains\n"
PROHIBITING = (
    "RULE curtains WHEN CurtainRequest THEN OpenCurtains\nUNLESS UserUndressed IN WHICH CASE NOT OpenCurtains\n"
)

HEAD = """\
import contextpy3 as cop
import sleec_runtime

sleec = sleec_runtime.load("rules.sleec")

class Curtains:
"""
BASE = """\
    @sleec.rule("curtains")
    @cop.base
    def request(self, message):
        self.open_curtains()

"""
BODY = """\
        self.refuse_request()
        self.explain_why()
"""
HEDGE = f"""\
    @cop.around(sleec.layers["curtains.hc1"])
    def request(self, message):
{BODY}
"""
HEDGE_2 = """\
    @cop.around(sleec.layers["curtains.hc2"])
    def request(self, message):
        self.open_curtains()

"""
TAIL = """\
    def open_curtains(self): ...
    def refuse_request(self): ...
    def explain_why(self): ...
"""
ROBOT = HEAD + BASE + HEDGE + TAIL
BUTTON = "    def on_button(self):\n"
BLINDS = """
class Blinds(Curtains):
    @sleec.rule("blinds")
    @cop.base
    def blinds(self, message):
        self.open_curtains()
"""
TABLE = """\
import sleec_runtime

sleec = sleec_runtime.load("rules.sleec")
sleec.implement({
    "OpenCurtains": lambda message: print("open"),
    "RefuseRequest": lambda message: print("no"),
    "ExplainWhy": lambda message: print("you are undressed"),
})
"""
TIMED_RULES = """\
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN DustSeen THEN SweepFloor
"""
TIMED_ROBOT = """\
import contextpy3 as cop
import sleec_runtime

sleec = sleec_runtime.load("rules.sleec")

class Nurse:
    @sleec.rule("fall")
    @cop.base
    def user_fell(self):
        self.call_nurse()

    @sleec_runtime.obligation("CallNurse")
    def call_nurse(self): ...
    def call_ambulance(self): ...
    def sweep_floor(self): ...
    def vacuum(self): ...
    def __init__(self):
        sleec.bind(self)
        sleec.implement(self)
"""
TIMED_TABLE = """\
import sleec_runtime

sleec = sleec_runtime.load("rules.sleec")
sleec.implement({
    "CallNurse": lambda: print("help"),
    "OfferWater": lambda: print("water?"),
    "CallAmbulance": lambda: print("more help"),
    "SweepFloor": lambda: print("sweeping"),
})
"""


def example(code: str, rules: str) -> str:
    """Both files of an example as one text."""
    return f"{RULES_FILE}{rules}\n{CODE_FILE}{code}"


def files_of(text: str) -> dict[str, str]:
    """The files of an example by their names."""
    rules, code = text.removeprefix(RULES_FILE).split(CODE_FILE)
    return {"rules.sleec": rules, "robot.py": code}
