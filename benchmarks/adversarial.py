"""Measure `check` on small texts that are hard to decide: the time, and how many checks are unknown.

Each takes less than ten seconds, because every file has a budget. ``python -m benchmarks.adversarial NAME…`` measures
the named texts.
"""

from __future__ import annotations

import random
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from time import perf_counter

BOUND = 10.0
"""Seconds that each may take on a machine that does nothing else."""


def products(rules: int = 24) -> str:
    """Rules that each compare a sum of squares of measures, which neighbouring rules share."""
    squares = [f"({{m{n}}} * {{m{n}}})" for n in range(rules)]
    sums = [f"(({squares[n - 2]} + {squares[n - 1]}) + {squares[n]})" for n in range(rules)]
    return _dsl(
        ["T", "A"],
        [f"when T and ({each} = {8 * n + 7}) then {'not ' if n % 3 else ''}A" for n, each in enumerate(sums)],
        [f"m{n}" for n in range(rules)],
    )


def hedged_products(rules: int = 24) -> str:
    return _dsl(
        ["T", "A", "B"],
        [
            f"when T then A unless (({{m{n % 6}}} * {{m{(n + 1) % 6}}}) > {100 * n + 7}) then not A"
            f" unless (({{m{(n + 2) % 6}}} * {{m{(n + 3) % 6}}}) > {100 * n + 7}) then B"
            for n in range(rules)
        ],
        [f"m{n}" for n in range(6)],
    )


def pigeonhole(holes: int = 10, rules: int = 50) -> str:
    """An assumption that there is room for one pigeon more than there are holes, and rules with hedges about the
    pigeons.
    """
    pigeons = range(holes + 1)
    somewhere = [" OR ".join(f"p{p}in{h}" for h in range(holes)) for p in pigeons]
    alone = [f"NOT (p{p}in{h} AND p{q}in{h})" for h in range(holes) for p in pigeons for q in range(p)]
    assumed = " AND ".join(f"({part})" for part in (*somewhere, *alone))
    hedged = (
        f"RULE r{n}\nWHEN t{n} THEN o{n}\nUNLESS p{n % holes}in{n % holes} IN WHICH CASE q{n}\n"
        f"UNLESS c{n} IN WHICH CASE NOT o{n}"
        for n in range(rules)
    )
    return "\n".join([f"ASSUME {assumed}", *hedged, ""])


def all_call_all(events: int = 17) -> str:
    names = [f"E{n}" for n in range(events)]
    return _lines(f"WHEN {a} THEN {b} WITHIN 5 seconds" for a in names for b in names if a != b)


def nevers(count: int = 72, names: int = 24, width: int = 3, seed: int = 1) -> str:
    """Random NEVERs of `width` literals over obligations. Rules oblige and forbid all of these."""
    draw = random.Random(seed)
    every = [f"O{n}" for n in range(names)]

    def literal(name: str) -> str:
        return f"NOT {name}" if draw.random() < 0.5 else name

    forbidden = [f"NEVER {' AND '.join(map(literal, draw.sample(every, width)))}" for _ in range(count)]
    return _lines([*forbidden, *(f"WHEN T THEN {name}\nWHEN U THEN NOT {name}" for name in every)])


def exclusive(names: int = 100) -> str:
    """Many exclusive obligations, each with its own trigger, so that any two can be due together."""
    return _exclusive(names, [f"WHEN T{n} THEN O{n}" for n in range(names)])


def exclusive_at_once(names: int = 100) -> str:
    """Many exclusive obligations that are due at the same instant."""
    return _exclusive(names, [f"WHEN T THEN O{n}" for n in range(names)])


def exclusive_in_turn(names: int = 100) -> str:
    """Many exclusive obligations of which a measure selects one, so that no two are due together."""
    rules = [f"WHEN T AND Level >= {n} AND Level < {n + 1} THEN O{n}" for n in range(names)]
    return _exclusive(names, ["MEASURE Level: integer", *rules])


def _exclusive(names: int, rules: list[str]) -> str:
    return _lines([f"EXCLUSIVE {', '.join(f'O{n}' for n in range(names))}", *rules])


def nested(depth: int = 40, rules: int = 8) -> str:
    """Guards nested as deep as the parser allows."""

    def guard(seed: int) -> str:
        draw = random.Random(seed)
        text = "c0"
        for _ in range(depth):
            text = f"(NOT {text} {draw.choice(('AND', 'OR'))} c{draw.randrange(12)})"
        return text

    return _lines(f"WHEN T AND {guard(n)} THEN {'NOT ' if n % 2 else ''}O{n % 4}" for n in range(rules))


def many_hedges(hedges: int = 90, rules: int = 4) -> str:
    rule = (
        "\n".join(
            [f"WHEN T THEN O{n}", *(f"UNLESS c{(n + h) % 30} IN WHICH CASE O{(n * h) % 7}" for h in range(hedges))]
        )
        for n in range(rules)
    )
    return _lines(rule)


def nested_chains(depth: int = 20, rules: int = 12) -> str:
    """Chains of hedges nested in hedges."""

    def inside(n: int, left: int) -> str:
        return f"(O{left % 5} UNLESS c{n}x{left} IN WHICH CASE {inside(n, left - 1)})" if left else f"NOT O{n % 5}"

    return _lines(f"WHEN T THEN A{n}\nUNLESS d IN WHICH CASE {inside(n, depth)}" for n in range(rules))


def long_chain(events: int = 220) -> str:
    return _lines(f"WHEN E{n} THEN E{n + 1} WITHIN {n % 7 + 1} seconds" for n in range(events))


def forbidding_chain(events: int = 90) -> str:
    """A chain of responses, each forbidden for some time by another rule."""
    return _lines(
        f"WHEN E{n} THEN E{n + 1} WITHIN {n % 7 + 1} minutes\nWHEN E{n} THEN NOT E{(n * 7) % events} WITHIN {n} seconds"
        for n in range(events)
    )


def random_clauses(variables: int = 150, ratio: float = 4.26, seed: int = 3) -> str:
    """A guard that is a random formula at the threshold where satisfiability is hardest."""
    draw = random.Random(seed)

    def literal(n: int) -> str:
        return f"NOT c{n}" if draw.random() < 0.5 else f"c{n}"

    clauses = [" OR ".join(map(literal, draw.sample(range(variables), 3))) for _ in range(int(variables * ratio))]
    guard = " AND ".join(f"({clause})" for clause in clauses)
    return _lines([f"WHEN T AND {guard} THEN O", "WHEN T THEN NOT O"])


def many_causes(literals: int = 8, clauses: int = 12) -> str:
    """A NEVER of several obligations, each of which several rules oblige."""
    names = [f"O{n}" for n in range(literals)]
    return _lines(
        [
            f"NEVER {' AND '.join(names)}",
            "MEASURE Level: integer",
            *(
                f"WHEN T AND Level = {n * clauses + m} THEN {name}"
                for n, name in enumerate(names)
                for m in range(clauses)
            ),
        ]
    )


def compared_measures(measures: int = 20, rules: int = 60) -> str:
    """Whole numbers that are compared with each other and with constants, with few solutions."""
    draw = random.Random(5)
    declared = [f"MEASURE m{n}: integer" for n in range(measures)]

    def comparison() -> str:
        one, other = draw.sample(range(measures), 2)
        return draw.choice((f"m{one} < m{other}", f"m{one} <= m{other}", f"m{one} > {draw.randrange(8)}"))

    def guard() -> str:
        return " AND ".join(comparison() for _ in range(6))

    return _lines(
        [*declared, *(f"WHEN T AND {guard()} THEN {draw.choice(('', 'NOT '))}O{n % 5}" for n in range(rules))]
    )


def many_domains(domains: int = 60, rules: int = 100) -> str:
    """Rules that apply everywhere, checked once for each of many domains."""
    everywhere = [
        f"RULE r{n}\nWHEN T{n % 9} THEN O{n % 11}\nUNLESS c{n} IN WHICH CASE NOT O{n % 7}" for n in range(rules)
    ]
    return _lines([*everywhere, *(f"DOMAIN d{n}\nRULE only{n}\nWHEN T0 THEN P{n}" for n in range(domains))])


FAMILIES: Mapping[str, Callable[[], str]] = {
    "products": products,
    "hedged-products": hedged_products,
    "pigeonhole": pigeonhole,
    "all-call-all": all_call_all,
    "nevers": nevers,
    "wide-nevers": lambda: nevers(200, 40, 6),
    "many-nevers": lambda: nevers(400, 60),
    "exclusive": exclusive,
    "exclusive-1000": lambda: exclusive(1_000),
    "exclusive-at-once": exclusive_at_once,
    "exclusive-at-once-1000": lambda: exclusive_at_once(1_000),
    "exclusive-in-turn": exclusive_in_turn,
    "exclusive-in-turn-1000": lambda: exclusive_in_turn(1_000),
    "nested": nested,
    "many-hedges": many_hedges,
    "nested-chains": nested_chains,
    "long-chain": long_chain,
    "forbidding-chain": forbidding_chain,
    "random-clauses": random_clauses,
    "many-causes": many_causes,
    "compared-measures": compared_measures,
    "many-domains": many_domains,
}
"""Texts by name. Those that are not EXCLUSIVEs have about 10 kB at most."""


def _dsl(events: list[str], rules: list[str], measures: list[str]) -> str:
    defined = [*(f"  event {name}" for name in events), *(f"  measure {name}: numeric" for name in measures)]
    stated = (f"  R{n} {rule}" for n, rule in enumerate(rules))
    return _lines(["def_start", *defined, "def_end", "rule_start", *stated, "rule_end"])


def _lines(lines: Iterable[str]) -> str:
    return "\n".join([*lines, ""])


def main(names: Iterable[str] = ()) -> None:
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for name in tuple(names) or FAMILIES:
            path = Path(folder) / f"{name}.sleec"
            path.write_text(FAMILIES[name](), encoding="utf-8")
            check = [sys.executable, "-m", "sleec_verify", "check", "--no-cache", "--format", "concise", str(path)]
            started = perf_counter()
            done = subprocess.run(check, capture_output=True, text=True, check=False)
            seconds = perf_counter() - started
            unknown = sum(": unknown[" in line for line in done.stdout.splitlines())
            size = path.stat().st_size / 1000
            print(f"{seconds:6.2f} s  {unknown:2} unknown, exit {done.returncode}  {name} ({size:.1f} kB)", flush=True)
            worst = max(worst, seconds)
    print(f"{worst:6.2f} s at most (bound: {BOUND:g} s)")


if __name__ == "__main__":
    main(sys.argv[1:])
