"""Single points of how code is read, each in a robot of a few lines."""

from __future__ import annotations

import pytest

from tests.support.structure import CODES, checked, kinds

RULES = "RULE stop WHEN Obstacle THEN Stop UNLESS InHurry IN WHICH CASE (SlowDown AND Warn)\n"
HEAD = """\
import asyncio, threading, time
import contextpy3 as cop
import sleec_runtime
from sleec_runtime import Sleec, obligation
from typing import Any

"""
GIVEN = "sleec = sleec_runtime.load('rules.sleec')\n"
BASE = """\
    @sleec.rule("stop")
    @cop.base
    def obstacle(self):
        self.stop()

"""
TAIL = """
    def stop(self): ...
    def slow_down(self): ...
    def warn(self): ...
"""


def robot(hedge: str, more: str = "", *, before: str = "", layer: str = 'sleec.layers["stop.hc1"]') -> str:
    """A robot whose hedge has this body."""
    body = "".join(f"        {line}\n" for line in hedge.split("\n"))
    variant = f"    @cop.around({layer})\n    def obstacle(self):\n{body}"
    return f"{HEAD}{GIVEN}{before}\nclass Robot:\n{BASE}{variant}{TAIL}{more}"


BOTH = "self.slow_down()\nself.warn()"


@pytest.mark.parametrize(
    "layer",
    [
        "sleec.layers.of('stop.hc1')",
        "sleec.layers.__getitem__('stop' '.hc1')",
        "getattr(sleec, 'layers')['stop.hc1']",
        "LAYERS['stop.hc1']",
        "LAYERS[NAMES.HC]",
        "layers_of_another_file['stop.hc1']",
    ],
)
def test_spellings_of_a_layer(layer: str) -> None:
    before = (
        "from elsewhere import layers_of_another_file\nLAYERS = sleec.layers\n"
        "class NAMES:\n    HC = f'{\"stop\"}.hc{1}'\n"
    )
    assert kinds(RULES, robot=robot(BOTH, before=before, layer=layer)) == []


@pytest.mark.parametrize(
    ("layer", "expected"),
    [
        ("sleec.layers[f'stop.{input()}']", ["undecided"]),
        ("sleec.layers['stop.hc%d' % 1]", ["undecided"]),
        ("sleec.layers[NAME]", ["undecided"]),
        ("sleec.layers[TWICE]", ["undecided"]),
        ("sleec.layers[LOOP]", ["undecided"]),
        ("**options", None),
        ("sleec.layers['nothing like it']", ["unknown-layer"]),
    ],
)
def test_layers_that_are_not_known(layer: str, expected: list[str] | None) -> None:
    before = "from elsewhere import NAME, options\nTWICE = 'stop.hc1'\nTWICE = input()\nLOOP = LOOP\n"
    found = kinds(RULES, robot=robot(BOTH, before=before, layer=layer))
    assert found == (expected or ["undecided"])


@pytest.mark.parametrize(
    "hedge",
    [
        "time.sleep(1)\nself.slow_down(); print('!'); self.warn()",
        "return [self.slow_down(), self.warn()]",
        "x = self.slow_down()\ny: int = self.warn()",
        "a, b = self.slow_down, self.warn\na()\nb()",
        "f = self.slow_down\nf()\ngetattr(self, 'warn')()",
        "{self.slow_down(): self.warn()}",
        "log(self.slow_down(), to=self.warn())",
        "assert self, 'always'\nself.slow_down()\nself.warn()",
        "if self.slow_down():\n    pass\nself.warn()",
        "for _ in self.slow_down():\n    continue\nself.warn()",
        "(x := self.slow_down())\nself.warn()",
        "try:\n    self.slow_down()\nfinally:\n    self.warn()",
        "with self.lock, open('x') as file:\n    self.slow_down()\n    self.warn()",
        "self.slow_down() and print()\nself.warn()",
        "obligation('SlowDown')(print)()\nself.warn()",
        "Robot.slow_down(self)\nRobot().warn()",
        "def both(robot):\n    robot.slow_down()\n    robot.warn()\nboth(self)",
        "del self.x\nself.slow_down()\nself.warn()",
    ],
)
def test_what_is_certain(hedge: str) -> None:
    assert kinds(RULES, robot=robot(hedge)) == []


@pytest.mark.parametrize(
    ("hedge", "expected"),
    [
        ("self.slow_down()\nif self.x:\n    raise ValueError\nself.warn()", ["conditional-obligation"]),
        ("if self.x:\n    return self.slow_down()\nelse:\n    return\nself.warn()", ["conditional-obligation"] * 2),
        ("try:\n    self.slow_down()\nexcept E:\n    return\nself.warn()", ["conditional-obligation"] * 2),
        ("try:\n    self.slow_down()\n    self.warn()\nfinally:\n    return", ["conditional-obligation"] * 2),
        (
            "try:\n    self.slow_down()\nexcept E:\n    raise\nfinally:\n    return self.warn()",
            ["conditional-obligation"],
        ),
        ("try:\n    pass\nexcept E:\n    self.slow_down()\nelse:\n    self.warn()", ["conditional-obligation"] * 2),
        ("for x in y:\n    return\nself.slow_down()\nself.warn()", ["conditional-obligation"] * 2),
        ("for x in y:\n    pass\nelse:\n    self.slow_down()\nself.warn()", ["conditional-obligation"]),
        ("self.slow_down()\nreturn (self.warn() for _ in x)", ["conditional-obligation"]),
        ("while self.x:\n    self.slow_down()\nself.warn()", ["conditional-obligation"]),
        ("while True:\n    if self.x: break\nself.slow_down()\nself.warn()", ["conditional-obligation"] * 2),
        ("match self.x:\n    case 1: return\nself.slow_down()\nself.warn()", ["conditional-obligation"] * 2),
        ("self.slow_down()\nclass Inner:\n    pass\nasync def inner(): pass\ninner()\nself.warn()", []),
        ("self.slow_down()\nthreading.Thread(target=self.warn).start()", ["undecided"]),
        ("self.slow_down()\nobligation(input())(print)()", ["undecided"]),
        ("self.slow_down()\neval('self.warn()')", ["undecided"]),
        ("self.slow_down()\nsuper().warn()", []),
        ("self.slow_down()\nself.obstacle()", ["missing-obligation", "method-around"]),
        ("self.slow_down()\nself.rest()", ["missing-obligation"]),
    ],
)
def test_what_is_not(hedge: str, expected: list[str]) -> None:
    assert kinds(RULES, robot=robot(hedge)) == expected


def test_implementations_by_parts_of_the_robot() -> None:
    text = HEAD + GIVEN + "from wheels import Wheels\n\nclass Robot:\n    def __init__(self, horn):\n"
    text += "        self.wheels = Wheels()\n        self.horn = horn\n\n"
    text += BASE.replace("self.stop", "self.wheels.stop")
    text += '    @cop.around(sleec.layers["stop.hc1"])\n    def obstacle(self):\n'
    text += "        self.wheels.slow_down()\n        self.horn.warn()\n"
    assert kinds(RULES, robot=text) == []
    assert kinds(RULES, robot=text + "\n    def on_button(self):\n        self.horn.warn()\n") == ["undecided"]


def test_a_part_that_is_no_implementation() -> None:
    more = "\nclass Timer:\n    def stop(self): ...\n"
    assert kinds(RULES, robot=robot("t = Timer()\nt.stop()\n" + BOTH, more)) == []
    assert kinds(RULES, robot=robot("self.t.stop()\n" + BOTH, more)) == ["undecided"]


def test_an_implementation_may_call_the_one_that_it_overrides() -> None:
    more = "\nclass Careful(Robot):\n    def stop(self):\n        super().stop()\n        self.look()\n"
    assert kinds(RULES, robot=robot(BOTH, more)) == []


def test_a_variant_that_is_marked_implements() -> None:
    text = robot("self.slow_down()\nself.warn()").replace("    @cop.base\n", "    @cop.base\n    @obligation('Stop')\n")
    assert kinds(RULES, robot=text.replace("        self.stop()\n", "        pass\n")) == []
    assert kinds(RULES, robot=text) == []


def test_advice_counts() -> None:
    advice = "\n    @cop.{}(sleec.layers['stop.hc1'])\n    def obstacle(self):\n        self.{}()\n"
    assert kinds(RULES, robot=robot("self.warn()", advice.format("before", "slow_down"))) == []
    assert kinds(RULES, robot=robot("self.slow_down()", advice.format("after", "warn"))) == []
    assert kinds(RULES, robot=robot("self.warn()", advice.format("after", "slow_down"))) == ["obligation-order"]


@pytest.mark.parametrize("annotation", ["Sleec", "'Sleec'", "sleec_runtime.Sleec", "Any", "'no ('"])
def test_a_runtime_that_is_handed_in(annotation: str) -> None:
    text = robot(BOTH).replace(GIVEN, "")
    head, body = text.split("\nclass", 1)
    inner = "".join(f"    {line}\n" for line in ("class" + body).splitlines())
    assert kinds(RULES, robot=f"{head}\ndef make(sleec: {annotation}):\n{inner}") == []


def test_what_is_not_awaited_is_not_run() -> None:
    text = robot("self.slow_down()\nawait asyncio.gather(self.warn())").replace("def warn", "async def warn")
    assert kinds(RULES, robot=text.replace("    def obstacle", "    async def obstacle")) == ["conditional-obligation"]


def asynchronous(hedge: str) -> str:
    text = robot(hedge).replace("    def obstacle", "    async def obstacle")
    return text.replace("def slow_down", "async def slow_down").replace("def warn", "async def warn")


@pytest.mark.parametrize(
    "call",
    [
        "await asyncio.wait_for(self.warn(), 5)",
        "await asyncio.wait_for(fut=self.warn(), timeout=5)",
        "await asyncio.shield(asyncio.wait_for(self.warn(), 5))",
        "await asyncio.create_task(self.warn())",
        "return await asyncio.ensure_future(self.warn())",
    ],
)
def test_what_awaits_that_it_is_given(call: str) -> None:
    assert kinds(RULES, robot=asynchronous(f"await self.slow_down()\n{call}")) == []
    unawaited = call.replace("return ", "").replace("await ", "")
    assert kinds(RULES, robot=asynchronous(f"await self.slow_down()\n{unawaited}")) == ["conditional-obligation"]


def test_what_runs_a_coroutine_from_a_plain_variant() -> None:
    text = robot("self.slow_down()\nasyncio.run(self.warn())").replace("def warn", "async def warn")
    assert kinds(RULES, robot=text) == []


def test_what_is_gathered_keeps_no_order() -> None:
    text = asynchronous("await asyncio.gather(self.slow_down(), self.warn())")
    found = checked(RULES, robot=text).findings
    assert [CODES[one.code] for one in found] == ["conditional-obligation"] * 2
    assert "`gather()`" in found[0].message


@pytest.mark.parametrize(
    "body",
    [
        "try:\n    self.slow_down()\nexcept OSError:\n    raise\nself.warn()",
        "try:\n    self.slow_down()\nexcept OSError as e:\n    print(e)\n    raise A from e\nelse:\n    self.warn()",
        (
            "try:\n    self.slow_down()\nexcept OSError as e:\n    if e.x:\n        raise\n    else:\n        raise A\n"
            "except ValueError:\n    raise\nfinally:\n    print()\nself.warn()"
        ),
    ],
)
def test_handlers_that_all_raise_again_let_nothing_pass(body: str) -> None:
    assert kinds(RULES, robot=robot(body)) == []


@pytest.mark.parametrize(
    "handler",
    ["if e:\n        raise", "return\n    raise", "print(e)", "try:\n        raise\n    except OSError:\n        pass"],
)
def test_handlers_that_may_end_otherwise(handler: str) -> None:
    body = f"self.slow_down()\ntry:\n    self.warn()\nexcept OSError as e:\n    {handler}"
    assert kinds(RULES, robot=robot(body)) == ["conditional-obligation"]
    body = (
        f"self.slow_down()\ntry:\n    self.warn()\nexcept ValueError:\n    raise\nexcept OSError as e:\n    {handler}"
    )
    assert kinds(RULES, robot=robot(body)) == ["conditional-obligation"]


@pytest.mark.parametrize(
    ("more", "found"),
    [
        ("sleec.trigger('Obstacle')", ["endless-trigger"]),
        ("self.again()", ["endless-trigger"]),
        ("self.later()", []),
        ("sleec.trigger('Another')", []),
        ("sleec.update({'InHurry': False})\nsleec.trigger('Obstacle')", []),
        ("if self.busy:\n    sleec.trigger('Obstacle')", []),
        ("await sleec.trigger_async('Obstacle')", ["endless-trigger"]),
        ("sleec.trigger_all(('Another', 'Obstacle'))", ["endless-trigger"]),
        ("sleec.trigger_all(names)", []),
        ("soon(sleec.trigger_async('Obstacle'))", []),
        ("self.trigger('Obstacle')", []),
    ],
)
def test_a_variant_that_triggers_its_own_rule(more: str, found: list[str]) -> None:
    helpers = """
    def again(self): sleec.trigger("Obstacle")
    def later(self): soon(lambda: sleec.trigger("Obstacle"))
    def trigger(self, name): ...
"""
    text = robot(f"{BOTH}\n{more}", helpers)
    if "await" in more:
        text = text.replace("    def obstacle", "    async def obstacle")
    assert kinds(RULES, robot=text) == found


GLOBALLY = "\nsleec.activate_globally()\n"


@pytest.mark.parametrize("decorator", ["", "@cop.base"])
def test_a_base_in_a_subclass_hides_variants_where_layers_are_globally_active(decorator: str) -> None:
    again = f"\nclass Other(Robot):\n    {decorator}\n    def obstacle(self):\n"
    calls = f"{again}        self.stop()\n"
    assert kinds(RULES, robot=robot(BOTH, calls)) == []  # a trigger finds the inherited variants
    assert kinds(RULES, robot=robot(BOTH, calls + GLOBALLY)) == ["lost-variant"]
    assert kinds(RULES, robot=robot(BOTH, f"{again}        super().obstacle()\n{GLOBALLY}")) == []
    hedge = (
        "    @cop.around(sleec.layers['stop.hc1'])\n    def obstacle(self):\n        self.slow_down(); self.warn()\n"
    )
    own = f"{calls}\n{hedge}"
    assert kinds(RULES, robot=robot(BOTH, own + GLOBALLY)) == []


@pytest.mark.parametrize("value", ["lambda self: None", "helper", "None"])
def test_a_subclass_that_binds_the_name_of_a_rules_method_otherwise(value: str) -> None:
    more = f"\nclass Other(Robot):\n    obstacle = {value}\n"
    assert kinds(RULES, robot=robot(BOTH, more)) == ["undecided"]


def test_a_helper_behind_a_decorator_of_others() -> None:
    more = "\n    @retry\n    def rest(self):\n        self.warn()\n"
    assert kinds(RULES, robot=robot("self.slow_down()\nself.rest()", more)) == ["undecided"]
    more = "\n    if x:\n        def rest(self):\n            self.warn()\n"
    assert kinds(RULES, robot=robot("self.slow_down()\nself.rest()", more)) == ["undecided"]


def test_calls_that_are_too_many_to_follow() -> None:
    more = "".join(f"\n    def h{i}(self):\n        self.h{i + 1}()\n        self.h{i + 1}()\n" for i in range(16))
    found = kinds(RULES, robot=robot(BOTH + "\nself.h0()", more + "\n    def h16(self): ...\n"))
    assert found == ["undecided"]


def test_a_class_that_inherits_from_itself() -> None:
    assert kinds(RULES, robot=robot(BOTH, "\nclass A(B): ...\nclass B(A): ...\n")) == []


def test_a_property_and_its_setter_are_no_variants() -> None:
    more = "\n    @property\n    def x(self): ...\n    @x.setter\n    def x(self, value): ...\n"
    assert kinds(RULES, robot=robot(BOTH, more)) == []


def test_an_attribute_that_replaces_a_method() -> None:
    more = "\n    def __init__(self):\n        self.warn = print\n"
    assert kinds(RULES, robot=robot(BOTH, more)) == ["undecided"]


def test_an_attribute_that_implements() -> None:
    init = "\n    def __init__(self, horn):\n        self.warn = horn.blow\n        self.slow_down = print\n"
    text = robot(BOTH, init).replace("    def slow_down(self): ...\n    def warn(self): ...\n", "")
    assert kinds(RULES, robot=text) == []


def test_an_attribute_that_is_assigned_from_itself() -> None:
    more = "\n    def __init__(self):\n        self.x = self.x.next\n        self.y = self.z\n        self.z = self.y\n"
    assert kinds(RULES, robot=robot("self.x.go()\nself.y()\n" + BOTH, more)) == []


TABLE = """
def open_curtains(): ...
def ew(): {ew}
sleec.implement({{"SlowDown": open_curtains, "Warn": ew, "Stop": lambda: None}})
"""


def test_a_table_marks_what_implements() -> None:
    head = HEAD + GIVEN
    assert kinds(RULES, robot=head + TABLE.format(ew="print()")) == []
    assert kinds(RULES, robot=head + TABLE.format(ew="open_curtains()")) == ["obligation-around"]
    button = "def button():\n    open_curtains()\n"
    assert kinds(RULES, robot=head + TABLE.format(ew="...") + button) == ["obligation-around"]
    assert kinds(RULES, robot=head + TABLE.format(ew="...") + "on_press(open_curtains)\n") == ["undecided"]
    same = "def say(): ...\nsleec.implement({'SlowDown': say, 'Warn': say, 'Stop': print})\nsay()\nprint()\n"
    assert kinds(RULES, robot=head + same) == []


def test_a_table_marks_methods_and_attributes() -> None:
    table = 'sleec.implement({{"SlowDown": {0}.drive_motor, "Warn": print, "Stop": print}})\n'
    robot = "class R:\n    def drive_motor(self): ...\n    def button(self): {}\nr = R()\n"
    head = HEAD + GIVEN
    assert kinds(RULES, robot=head + robot.format("...") + table.format("r")) == []
    assert kinds(RULES, robot=head + robot.format("self.drive_motor()") + table.format("r")) == ["obligation-around"]
    assert kinds(RULES, robot=head + robot.format("...") + table.format("r") + "r.drive_motor()\n") == [
        "obligation-around"
    ]
    inside = "from hw import Base, motor\nclass R(Base):\n    def __init__(self):\n        " + table.format("self")
    assert kinds(RULES, robot=head + inside) == []
    assert kinds(RULES, robot=head + inside + "    def button(self): self.drive_motor()\n") == ["obligation-around"]
    outside = "from hw import motor\n" + table.format("motor")
    assert kinds(RULES, robot=head + outside + "motor.drive_motor()\n") == ["obligation-around"]
    handed = "def make(r):\n    " + table.format("r") + "def button(r):\n    r.drive_motor()\n"
    assert kinds(RULES, robot=head + handed) == ["undecided"]
