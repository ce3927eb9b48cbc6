"""Measure the local page as ratios: what a request costs, compared with the same work in this process.

A keystroke changes a response of one of 100 rules: the answer of the server with fresh findings may take at most five
times a check of the rules on which the changed rule depends (95th percentile). A switch in 1,000 rules: the obligations
may take at most three times `entail`. The server is another process, and the requests are those of the page.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from statistics import median, quantiles
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any
from urllib.parse import parse_qs, urlsplit

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_runtime.model import Context, Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.checks.incremental.groups import groups_of, partners
from sleec_verify.entailment.entailment import entail
from sleec_verify.query.ruleset_index import RulesetIndex

KEYSTROKE, SWITCH = 5, 3
TURNS = 60

Ask = Callable[..., dict[str, Any]]


@contextmanager
def server(text: str) -> Iterator[Ask]:
    """A server for a text, as a function that sends a request and waits for the answer."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "rules.sleec"
        path.write_text(text, encoding="utf-8")
        command = [sys.executable, "-m", "sleec_verify", "serve", str(path), "--no-browser"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
            assert process.stdout is not None
            address = urlsplit(process.stdout.readline().strip())
            assert address.hostname is not None
            connection = HTTPConnection(address.hostname, address.port)
            headers = {"X-Sleec-Token": parse_qs(address.query)["token"][0]}

            def ask(name: str, **fields: object) -> dict[str, Any]:
                connection.request("POST", f"/api/{name}", json.dumps(fields), headers)
                answer: dict[str, Any] = json.loads(connection.getresponse().read())
                return answer

            try:
                yield ask
            finally:
                connection.close()
                process.terminate()


def seconds(action: Callable[[], object]) -> float:
    started = perf_counter()
    action()
    return perf_counter() - started


def cone(ruleset: Ruleset, label: str) -> str:
    """The text of the rules on which findings about a rule depend."""
    index = RulesetIndex(ruleset)
    group = next(one for one in groups_of(index) if label in one.labels)
    labels = {*group.labels, *partners(index, {label})}
    rules = (rule.span for rule in ruleset.rules if rule.label in labels)
    return "\n".join(ruleset.source.text[start:end] for start, end in rules)


def keystrokes(count: int) -> tuple[list[float], list[float]]:
    """The seconds of each answer of the server, and those of the check of the cone at the same time."""
    draw = random.Random(0)
    rules = random_rules(count).split("\n\n")
    answers, checks = [], []
    with server("\n\n".join(rules)) as ask:
        known = ask("check", text="\n\n".join(rules))["version"]
        for _ in range(TURNS):
            at = draw.randrange(count)
            head, *hedges = rules[at].split("\n")[1:]
            head = f"{head.rsplit(' ', 1)[0]} Obligation{draw.randrange(count)}"
            rules[at] = "\n".join([f"RULE r{at}", head, *hedges])
            text = "\n\n".join(rules)
            started = perf_counter()
            known = ask("check", text=text, since=known)["version"]
            answers.append(perf_counter() - started)
            part = cone(parse(text), f"r{at}")
            checks.append(seconds(lambda part=part: run_checks(parse(part))))  # type: ignore[misc]
    return answers, checks


def switches(count: int) -> tuple[list[float], list[float]]:
    """The seconds of each answer of the server, and those of `entail` at the same time."""
    draw = random.Random(0)
    text = random_rules(count)
    ruleset = parse(text)
    triggers, conditions = sorted(ruleset.triggers), sorted(ruleset.conditions)
    answers, entailments = [], []
    with server(text) as ask:
        known = ask("check", text=text)["of"]
        for _ in range(TURNS):
            chosen = draw.sample(triggers, 3)
            values = dict.fromkeys(draw.sample(conditions, 10), True)
            context = Context(frozenset(chosen), dict(values))
            answers.append(seconds(lambda: ask("situation", of=known, triggers=chosen, conditions=values)))  # noqa: B023
            entailments.append(seconds(lambda: entail(ruleset, context)))  # noqa: B023
    return answers, entailments


def main() -> None:
    answers, checks = keystrokes(100)
    ratio = quantiles(answers, n=20)[-1] / quantiles(checks, n=20)[-1]
    print(
        f"100 rules, a keystroke: {median(answers) * 1e3:.1f} ms, check of the cone {median(checks) * 1e3:.1f} ms, "
        f"95th percentiles {ratio:.1f} : 1 (at most {KEYSTROKE})"
    )
    answers, entailments = switches(1_000)
    print(
        f"1,000 rules, a switch: {median(answers) * 1e3:.1f} ms, entail {median(entailments) * 1e3:.1f} ms, "
        f"medians {median(answers) / median(entailments):.1f} : 1 (at most {SWITCH})"
    )
    answers, _ = keystrokes(2_000)
    print(f"2,000 rules, a keystroke: {median(answers) * 1e3:.0f} ms")


if __name__ == "__main__":
    main()
