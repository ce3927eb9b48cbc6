"""Random rules with time, a correct robot for them as text, mistakes in it, and random runs of it.

Rules oblige the acts A0 to A3 and forbid P0 and P1, so a correct robot violates nothing. A3 takes time: the robot
completes it when the run calls `on_done`.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import contextpy3

import sleec_runtime
from sleec_runtime import Sleec, VirtualClock
from sleec_runtime.dispatch.implementations import snake_case
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.model import Clause, Rule, Ruleset

LOAD = 'sleec = sleec_runtime.load("rules.sleec")\n'
NOTE = "from journal import note\n"


def random_rules(random: Random) -> str:
    """Rules with the triggers T0 and T1."""

    def literal(depth: int) -> str:
        name = random.choice(("A0", "A1", "A2", "A3", "NOT P0", "NOT P1"))
        if name == "A3":
            text = f"A3 WITHIN {random.randint(2, 4)} seconds"
        else:
            windows = [" WITHIN {} seconds", " WITHIN 1 TO {} seconds", " WITHIN 3 seconds" if "P" in name else ""]
            text = name + random.choice(windows).format(random.randint(2, 4))
        if depth and "NOT" not in name and random.random() < 0.5:
            other = literal(depth - 1)
            hedge = f" UNLESS d IN WHICH CASE {literal(0)}" if random.random() < 0.3 else ""
            text = f"({text} {random.choice(('OTHERWISE', 'ELSE'))} ({other}{hedge}))"
        return text

    def response() -> str:
        return " AND ".join(literal(2) for _ in range(random.choice((1, 1, 2))))

    lines = []
    for number in range(random.choice((2, 3))):
        lines.append(f"RULE r{number} WHEN T{number % 2} THEN ({response()})")
        if random.random() < 0.5:
            lines.append(f"UNLESS c IN WHICH CASE ({response()})")
    return "\n".join(lines) + "\n"


def robot_source(ruleset: Ruleset, random: Random) -> str:
    """A correct robot: some rules have a method, the others are composed of its callables."""
    lines = ["import contextpy3 as cop", "import sleec_runtime", NOTE + LOAD, "class Robot:"]
    methods = [rule for rule in ruleset.rules if _may_have_method(rule) and random.random() < 0.6]
    lines += ["    def __init__(self):"]
    lines += ["        sleec.bind(self)"] if methods else []
    lines += ["        sleec.implement(self)", ""]
    for rule in methods:
        for number, clause in enumerate(rule.clauses()):
            if number:
                lines.append(f"    @cop.around(sleec.layers[{rule.layer(number)!r}])")
            else:
                lines += [f"    @sleec.rule({rule.label!r})", "    @cop.base"]
            calls = [f"        self.{snake_case(one.name)}()" for one in clause.obligations if not one.negated]
            lines += [f"    def on_{rule.label}(self):", *(calls or ["        pass"]), ""]
    for name in ("A0", "A1", "A2", "P0", "P1"):
        lines += [f"    def {snake_case(name)}(self):", f'        note("{name}")', ""]
    if "A3" in ruleset.obligations:
        lines += ['    @sleec_runtime.obligation("A3", completes=False)', "    def a3(self):"]
        lines += ['        note("started")', ""]
        lines += ["    def on_done(self):", '        note("A3")', '        sleec.completed("A3")', ""]
    lines += ["    def on_button(self):", '        note("pressed")', ""]
    return "\n".join(lines)


def _may_have_method(rule: Rule) -> bool:
    return all(len(_starts(clause)) <= 1 for clause in rule.clauses()) and all(
        len({one.name for one in clause.obligations}) == len(clause.obligations) for clause in rule.clauses()
    )


def _starts(clause: Clause) -> set[str]:
    windows = [one.timing.window if one.timing else None for one in clause.obligations if not one.negated]
    return {str(window.start if window else None) for window in windows}


def mistake_in(source: str, random: Random) -> str:
    """The source with one mistake, or with a change that only looks like one. `conform` does not look for calls of
    what does not exist, and for endless recursion, so they are left out."""
    act = random.choice([name for name in ("a0", "a1", "a2", "a3", "p0", "p1") if f"def {name}(" in source])
    other = random.choice([name for name in ("a1", "a2", "a3", "p0", "p1") if f"def {name}(" in source])
    pressed = '        note("pressed")\n'
    calls = [line for line in source.split("\n") if line.strip() in {f"self.a{number}()" for number in range(4)}]
    changes: list[Callable[[], str]] = [
        lambda: source.replace(pressed, f"        self.{act}()\n"),
        lambda: source.replace(pressed, f"        if sleec.pending(): self.{act}()\n"),
        lambda: source.replace(pressed, f"        sleec.trigger('T0')\n        (lambda: self.{act}())()\n"),
        lambda: source.replace(pressed, f"        self.helper()\n    def helper(self):\n        self.{act}()\n"),
        lambda: source.replace(pressed, f"        getattr(self, {act!r})()\n"),
        lambda: source.replace('        note("A0")\n', f'        note("A0")\n        self.{other}()\n'),
        lambda: source.replace('        note("A3")\n        sleec.completed("A3")\n', "        pass\n"),
        lambda: source.replace("        sleec.implement(self)\n", "        pass\n"),
    ]
    if f"self.{act}()" not in source:
        changes.append(lambda: source.replace(f"    def {act}(self)", f"    def was_{act}(self)"))
    if calls:
        call = random.choice(calls)
        changes += [
            lambda: source.replace(call, "        pass", 1),
            lambda: source.replace(call, f"        if sleec.pending(): {call.strip()}", 1),
            lambda: source.replace(call, f"        self.{act}()", 1),
            lambda: source.replace(call, f"{call}\n        self.{act}()", 1),
        ]
    return random.choice(changes)()


def fails(ruleset: Ruleset, source: str, random: Random, runs: int = 6) -> bool:
    """Whether random runs of a robot violate a rule or raise."""
    return any(_fails_once(ruleset, source, random) for _ in range(runs))


def _fails_once(ruleset: Ruleset, source: str, random: Random) -> bool:
    clock = VirtualClock()
    events: dict[int, set[str]] = {}

    def note(name: str) -> None:
        events.setdefault(int(clock.now()), set()).add(name)

    sleec = Sleec(ruleset, clock=clock)
    names: dict[str, object] = {"sleec": sleec, "note": note, "sleec_runtime": sleec_runtime, "cop": contextpy3}
    conditions: dict[int, dict[str, bool]] = {}
    try:
        exec(source.replace(LOAD, "").replace(NOTE, ""), names)
        robot = names["Robot"]()  # type: ignore[operator]
        for second in range(30):
            values = {name: random.random() < 0.5 for name in ("c", "d") if name in sleec.vocabulary}
            sleec.update(values)
            conditions[second] = values
            if second < 12:
                for trigger in ("T0", "T1"):
                    if random.random() < 0.3:
                        note(trigger)
                        sleec.trigger(trigger)
                if random.random() < 0.4:
                    robot.on_button()
            started = [one for one in sleec.pending() if one.obligation == "A3" and one.state == "under way"]
            # At its last second, the clock comes first.
            if any(one.until == second + 1 or random.random() < 0.3 for one in started):
                robot.on_done()
            clock.advance(1)
    except Exception:  # noqa: BLE001 - whatever the mistake causes
        return True
    trace = Trace(
        tuple(Instant(second, frozenset(events.get(second, ())), values) for second, values in conditions.items())
    )
    return bool(violations(ruleset, trace)) or bool(sleec.failures)
