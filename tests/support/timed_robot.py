"""A correct robot for rules with time, and mistakes in it: each is a change of its text, and what `conform` reports."""

from __future__ import annotations

from typing import NamedTuple

RULES = """\
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE (CallAmbulance
    UNLESS AtHospital IN WHICH CASE FetchDoctor WITHIN 1 minute OTHERWISE SoundAlarm)
UNLESS UserRefuses IN WHICH CASE (CallFamily WITHIN 1 hour ELSE SoundAlarm)
RULE rest WHEN UserSleeps THEN NOT Speak WITHIN 1 hour
UNLESS UserSnores IN WHICH CASE NOT Vacuum WITHIN 30 minutes
RULE dust WHEN DustSeen THEN Vacuum
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 TO 60 minutes AND NOT Vacuum WITHIN 10 TO 60 minutes
"""

ROBOT = """\
import asyncio
import threading
import contextpy3 as cop
import sleec_runtime

sleec = sleec_runtime.load("rules.sleec")


class Nurse:
    def __init__(self, phone, voice, motor):
        self.phone = phone
        self.voice = voice
        self.motor = motor
        sleec.bind(self)
        sleec.implement(self)

    @sleec.rule("fall")
    @cop.base
    def user_fell(self, *args):
        self.call_nurse()

    @cop.around(sleec.layers["fall.hc1"])
    def user_fell(self, *args):
        self.call_family()

    @sleec.rule("walk")
    @cop.base
    def morning_comes(self, *args):
        self.offer_walk()

    @sleec_runtime.obligation("CallNurse", completes=False)
    def call_nurse(self, *args):
        self.phone.dial("nurse", self.on_answer)

    def on_answer(self):
        sleec.completed("CallNurse")

    def on_dust(self):
        sleec.trigger("DustSeen")

    def on_button(self):
        sleec.trigger("UserFell")

    def call_ambulance(self, *args):
        self.phone.dial("ambulance", None)

    def fetch_doctor(self, *args):
        self.motor.go("ward")

    def sound_alarm(self, *args):
        self.motor.siren()

    def call_family(self, *args):
        self.phone.dial("family", None)

    def offer_walk(self, *args):
        self.voice.say("a walk?")

    def vacuum(self, *args):
        self.motor.clean()

    def speak(self):
        self.voice.say("hello")
"""


class Mistake(NamedTuple):
    """`old` is replaced by `new` in the text of the robot. `kind` is one of the findings that this causes."""

    name: str
    kind: str
    old: str
    new: str


def _button(lines: str) -> str:
    return "    def on_button(self):\n" + "".join(f"        {line}\n" for line in lines.split("\n"))


BUTTON = _button('sleec.trigger("UserFell")')
AMBULANCE = '    def call_ambulance(self, *args):\n        self.phone.dial("ambulance", None)\n'
ALARM = "    def sound_alarm(self, *args):\n        self.motor.siren()\n"
DOCTOR = '    def fetch_doctor(self, *args):\n        self.motor.go("ward")\n'
WALK = '    @sleec.rule("walk")\n    @cop.base\n'
DIAL = 'self.phone.dial("nurse", self.on_answer)'
COMPLETED = 'sleec.completed("CallNurse")'
SPEAK = '    def speak(self):\n        self.voice.say("hello")\n'
VACUUM = "    def vacuum(self, *args):\n        self.motor.clean()\n"

MISTAKES = (
    # What alternatives require
    Mistake("no code for otherwise", "missing-callable", AMBULANCE, ""),
    Mistake("no code for a nested otherwise and an else", "missing-callable", ALARM, ""),
    Mistake("no code for an exception in otherwise", "missing-callable", DOCTOR, ""),
    Mistake("methods are bound, but nothing is implemented", "missing-callable", "        sleec.implement(self)\n", ""),
    Mistake(
        "otherwise done by the variant",
        "extra-obligation",
        "self.call_nurse()",
        "self.call_nurse(); self.call_ambulance()",
    ),
    Mistake(
        "otherwise done in place of the obligation", "missing-obligation", "self.call_nurse()", "self.call_ambulance()"
    ),
    Mistake("otherwise done by a button", "obligation-around", BUTTON, _button("self.call_ambulance()")),
    Mistake(
        "otherwise done by a timer of the code",
        "undecided",
        DIAL,
        DIAL + "\n        threading.Timer(300, self.call_ambulance).start()",
    ),
    Mistake(
        "otherwise done by a timer in the variant",
        "undecided",
        "self.call_nurse()",
        "self.call_nurse()\n        threading.Timer(300, self.call_ambulance).start()",
    ),
    Mistake(
        "otherwise done by a lambda of a timer",
        "obligation-around",
        BUTTON,
        _button("threading.Timer(300, lambda: self.call_ambulance()).start()"),
    ),
    # Variants
    Mistake("windowed obligation omitted", "missing-obligation", "self.offer_walk()", "pass"),
    Mistake(
        "windowed obligation under a condition",
        "conditional-obligation",
        "self.offer_walk()",
        "if args: self.offer_walk()",
    ),
    Mistake(
        "windowed obligation in a task",
        "undecided",
        "self.offer_walk()",
        "threading.Timer(600, self.offer_walk).start()",
    ),
    Mistake(
        "windowed obligation in a loop",
        "conditional-obligation",
        "self.offer_walk()",
        "for _ in range(2): self.offer_walk()",
    ),
    Mistake("variant of another exception", "unknown-layer", "fall.hc1", "fall.hc2"),
    Mistake(
        "no variant for an exception",
        "missing-variant",
        '    @cop.around(sleec.layers["fall.hc1"])\n    def user_fell(self, *args):\n        self.call_family()\n',
        "",
    ),
    Mistake("only global activation runs the method", "obligation-around", WALK, "    @cop.base\n"),
    Mistake("forbidden act in a variant", "extra-obligation", "self.call_nurse()", "self.call_nurse(); self.speak()"),
    Mistake(
        "act that is forbidden later in its own variant",
        "extra-obligation",
        "self.offer_walk()",
        "self.offer_walk(); self.vacuum()",
    ),
    Mistake(
        "global activation",
        "timed-global-activation",
        "        sleec.implement(self)\n",
        "        sleec.implement(self)\n        sleec.activate_globally()\n",
    ),
    # Completion
    Mistake("never completed", "never-completed", COMPLETED, "pass"),
    Mistake("completion of another obligation", "never-completed", COMPLETED, 'sleec.completed("CallFamily")'),
    Mistake("completion of a misspelled obligation", "unknown-obligation", COMPLETED, 'sleec.completed("CallNurs")'),
    Mistake("completion of what is known at run time", "undecided", COMPLETED, "sleec.completed(self.phone.reason)"),
    Mistake("completion of whatever is pending", "undecided", COMPLETED, "sleec.pending()[0].completed()"),
    # Prohibitions
    Mistake("forbidden act by a button", "unguarded-act", BUTTON, _button("self.speak()")),
    Mistake(
        "forbidden act by a helper of a button",
        "unguarded-act",
        BUTTON,
        _button("self.greet()") + "    def greet(self): self.speak()\n",
    ),
    Mistake("forbidden act by a timer", "unguarded-act", BUTTON, _button("threading.Timer(60, self.speak).start()")),
    Mistake(
        "forbidden act by a lambda of a timer",
        "unguarded-act",
        BUTTON,
        _button("threading.Timer(60, lambda: self.speak()).start()"),
    ),
    Mistake(
        "forbidden act by a thread", "unguarded-act", BUTTON, _button("threading.Thread(target=self.speak).start()")
    ),
    Mistake("forbidden act by a callback", "undecided", BUTTON, _button("self.voice.on_wake(self.speak)")),
    Mistake("forbidden act by a callback that is kept", "undecided", BUTTON, _button("self.handlers = [self.speak]")),
    Mistake(
        "forbidden act under a flag of the code", "undecided", BUTTON, _button("if not self.asleep:\n    self.speak()")
    ),
    Mistake("forbidden act after a return", "undecided", BUTTON, _button("if self.asleep: return\nself.speak()")),
    Mistake(
        "forbidden act in a caller's condition",
        "undecided",
        BUTTON,
        _button("if not self.asleep: self.greet()") + "    def greet(self): self.speak()\n",
    ),
    Mistake("forbidden act in a loop", "undecided", BUTTON, _button("while True:\n    self.speak()")),
    Mistake(
        "forbidden act in the code of another obligation", "unguarded-act", 'self.voice.say("a walk?")', "self.speak()"
    ),
    Mistake("forbidden act when it is completed", "unguarded-act", COMPLETED, COMPLETED + "\n        self.speak()"),
    Mistake("forbidden act by name", "undecided", BUTTON, _button("getattr(self, self.voice.mood)()")),
    Mistake("forbidden act of another object", "undecided", BUTTON, _button("self.voice.speak()")),
    Mistake("forbidden act that rules also require", "obligation-around", BUTTON, _button("self.vacuum()")),
    Mistake(
        "forbidden act that takes time",
        "undecided",
        VACUUM,
        '    @sleec_runtime.obligation("Vacuum", completes=False)\n' + VACUUM + '        sleec.completed("Vacuum")\n',
    ),
    Mistake(
        "forbidden act that awaits",
        "undecided",
        VACUUM,
        "    async def vacuum(self, *args):\n        await self.motor.clean()\n",
    ),
    Mistake(
        "forbidden act in another class",
        "unguarded-act",
        "    def speak(self):",
        "    def hush(self): ...\n\nclass Voice:\n    def on_wake(self):\n        self.speak()\n\n    def speak(self):",
    ),
    Mistake("forbidden act in another package", "undecided", BUTTON, _button("import voice; voice.speak()")),
    Mistake(
        "forbidden act under an alias", "undecided", SPEAK, "    def greet(self):\n        speak = print; speak()\n"
    ),
    Mistake(
        "forbidden act by an attribute",
        "unguarded-act",
        SPEAK,
        "    def greet(self):\n        self.speak = print\n        self.speak()\n",
    ),
    Mistake(
        "forbidden act of an imported module",
        "undecided",
        SPEAK,
        "    def greet(self):\n        from hw import speak as say; say()\n",
    ),
    Mistake("forbidden act in a destructor", "unguarded-act", BUTTON, "    def __del__(self):\n        self.speak()\n"),
    Mistake(
        "forbidden act in a task",
        "unguarded-act",
        BUTTON,
        "    async def on_button(self):\n        asyncio.create_task(self.speak())\n",
    ),
)
