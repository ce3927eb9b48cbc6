"""The ready test: how it is asked for, what it says, what it refuses, and how long it takes."""

from __future__ import annotations

import re
import threading
import time
from pathlib import Path

import contextpy3 as cop
import hypothesis
import pytest

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.language import load, parse
from sleec_verify import conformance
from sleec_verify.conformance import Bench, Nonconformance, NotASubject, check_conformance, conformance_test
from sleec_verify.conformance.exhaustive import each_rule
from sleec_verify.conformance.machine import run_machine
from sleec_verify.conformance.suite import PARTS, UnknownPart
from sleec_verify.conformance.threads import in_threads
from tests.support.robots import Log, listing_2, running

EIGHT = "rulesets/care-robot.sleec"


def make_sleec() -> Sleec:
    sleec = sleec_runtime.load(EIGHT)
    listing_2(sleec)
    return sleec


test_robot = conformance_test(make_sleec, examples=20)
test_robot_at_home = conformance_test(
    lambda: running_at("household"), EIGHT, domain="household", parts=["each-rule", "whole-changes", "replacement"]
)


def running_at(domain: str) -> Sleec:
    sleec = sleec_runtime.load(EIGHT, domain=domain)
    listing_2(sleec)
    return sleec


@pytest.mark.speed
def test_the_eight_rules_exhaustively_in_a_second() -> None:
    started = time.process_time()
    check_conformance(make_sleec, parts=["each-rule"])
    assert time.process_time() - started < 2


def test_the_ward_passes_as_well() -> None:
    def make() -> Sleec:
        sleec = sleec_runtime.load("rulesets/hospital-ward.sleec")
        listing_2(sleec)
        return sleec

    check_conformance(make, examples=10)


@pytest.mark.parametrize("conditions", [11, pytest.param(16, marks=pytest.mark.long)])
def test_contexts_are_gone_through_one_by_one(conditions: int) -> None:
    chain = " ".join(f"UNLESS c{n} IN WHICH CASE o{n}" for n in range(conditions))
    text = f"RULE r WHEN T THEN o {chain}"

    def make() -> Sleec:
        sleec = running(text)
        listing_2(sleec)
        return sleec

    assert each_rule(Bench(make)) == 2**conditions


def test_more_than_that_are_sampled() -> None:
    text = "RULE r WHEN T THEN o " + " ".join(f"UNLESS c{n} IN WHICH CASE o{n}" for n in range(17))

    def make() -> Sleec:
        sleec = running(text)
        listing_2(sleec)
        return sleec

    assert each_rule(Bench(make)) == 500


class Curtains:
    """Snake-case methods, arguments, and coroutines: nothing is marked, all is seen."""

    def open_curtains(self, message: str) -> None: ...
    async def refuse_request(self, message: str) -> None: ...
    async def explain_why(self, message: str) -> None: ...


ASKED = "RULE curtains WHEN Request THEN OpenCurtains UNLESS Undressed IN WHICH CASE RefuseRequest AND ExplainWhy"


def test_arguments_coroutines_and_unmarked_methods() -> None:
    def make() -> Sleec:
        sleec = running(ASKED)

        class Robot(Curtains):
            @sleec.rule("curtains")
            @cop.base
            def asked(self, message: str) -> None:
                self.open_curtains(message)

            @cop.around(sleec.layers["curtains.hc1"])  # type: ignore[no-redef]
            async def asked(self, message: str) -> None:  # noqa: F811
                await self.refuse_request(message)
                await self.explain_why(message)

        sleec.bind(Robot())
        return sleec

    check_conformance(make, arguments=("please",), examples=10)
    check_conformance(make, arguments=lambda triggers: triggers, parts=["each-rule"])


def test_what_implements_obligations_elsewhere_is_watched() -> None:
    actions = Log()
    actions.open_curtains = lambda: None  # type: ignore[attr-defined]

    def make() -> Sleec:
        sleec = running("RULE r WHEN T THEN OpenCurtains")

        class Robot:
            @sleec.rule("r")
            @cop.base
            def asked(self) -> None:
                actions.open_curtains()  # type: ignore[attr-defined]

        sleec.bind(Robot())
        return sleec

    with pytest.raises(Nonconformance, match="did not execute OpenCurtains"):
        check_conformance(make, parts=["each-rule"])
    check_conformance(make, parts=["each-rule"], watch=[actions])


def test_a_strict_instance_may_ask_for_what_is_missing() -> None:
    def make() -> Sleec:
        sleec = sleec_runtime.load(EIGHT, strict=True)
        listing_2(sleec)
        return sleec

    check_conformance(make, examples=10)


def test_the_report_says_what_was_due_and_by_which_clause() -> None:
    def make() -> Sleec:
        sleec = running(ASKED)
        log = Log()
        sleec.implement({name: lambda name=name: log.do(name) for name in ("OpenCurtains", "RefuseRequest")})
        sleec.implement({"ExplainWhy": lambda: log.do("OpenCurtains")})
        return sleec

    with pytest.raises(Nonconformance) as caught:
        check_conformance(make)
    assert str(caught.value).splitlines() == [
        "executed, although not required, OpenCurtains",
        "  situation: When `Request` occurs, `Undressed` is true (if nothing else holds)",
        "  executed:  RefuseRequest, ExplainWhy, OpenCurtains",
        "  required:  RefuseRequest, ExplainWhy",
        "    by rule curtains, clause 1, layer curtains.hc1: RefuseRequest AND ExplainWhy",
    ]


def test_what_fails_now_and_then_fails() -> None:
    calls = iter(range(10**9))

    def make() -> Sleec:
        sleec = running("RULE r WHEN T THEN o UNLESS a IN WHICH CASE p")
        log = Log()
        sleec.implement({name: lambda name=name: log.do(name) for name in "op"})
        sleec.implement({"p": lambda: log.do("o") if next(calls) == 0 else None})
        return sleec

    with pytest.raises(Nonconformance, match="not every time"):
        check_conformance(make, parts=["together"])


HOUSEHOLD = load("rulesets/household.sleec")


@pytest.mark.parametrize("faulty", sorted(HOUSEHOLD.obligations))
def test_a_fault_off_the_main_thread_is_found_wherever_it_is(faulty: str) -> None:
    other = next(name for name in sorted(HOUSEHOLD.obligations) if name != faulty)

    def make() -> Sleec:
        sleec = Sleec(HOUSEHOLD, "household")
        robot = listing_2(sleec)
        do = robot.do

        def do_something_else(name: str) -> None:
            main = threading.current_thread() is threading.main_thread()
            do(name if main or name != faulty else other)

        robot.do = do_something_else  # type: ignore[method-assign]
        return sleec

    check_conformance(make, parts=["each-rule"])
    with pytest.raises(Nonconformance, match=f"did not execute {faulty}"):
        in_threads(Bench(make))


def test_the_machine_makes_steps_in_other_threads() -> None:
    def make(faulty: bool) -> Sleec:
        sleec = running("RULE r WHEN T THEN o UNLESS a IN WHICH CASE p")
        main = threading.current_thread()
        log = Log()
        sleec.implement({name: lambda name=name: log.do(name) for name in "op"})
        extra = lambda: log.do("o") if faulty and threading.current_thread() is not main else None  # noqa: E731
        sleec.implement({"p": extra})
        return sleec

    few = hypothesis.settings(
        max_examples=100, phases=[hypothesis.Phase.generate], derandomize=True, deadline=None, database=None
    )
    run_machine(Bench(lambda: make(False)), few, threads=True)
    with pytest.raises(Nonconformance) as caught:
        run_machine(Bench(lambda: make(True)), few, threads=True)
    assert "a is true" in str(caught.value)


@pytest.mark.parametrize(("made", "named"), [(None, "nothing"), (5, "a int"), (Log(), "a Log")])
def test_a_factory_must_make_an_instance(made, named: str) -> None:
    with pytest.raises(NotASubject, match=f"the factory returned {named}, which is not a Sleec"):
        check_conformance(lambda: made)


def test_an_unknown_part_is_refused_at_once() -> None:
    with pytest.raises(UnknownPart, match="no part 'threds'"):
        conformance_test(make_sleec, parts=["threds"])


def test_a_ruleset_may_be_a_file_or_a_value() -> None:
    other = parse(Path(EIGHT).read_text(encoding="utf-8").replace("RiskLevel > r_low", "RiskLevel > r_moderate"))
    check_conformance(make_sleec, EIGHT, parts=["each-rule"])
    with pytest.raises(Nonconformance, match="`RiskLevel` is r_moderate"):
        check_conformance(make_sleec, other, parts=["each-rule"])
    with pytest.raises(Nonconformance):
        check_conformance(make_sleec, EIGHT, reading="priority", parts=["each-rule"])


def test_the_failure_of_a_test_has_no_traceback(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(
        test_it="""
        from sleec_runtime import Sleec
        from sleec_runtime.language import parse
        from sleec_verify.conformance import conformance_test
        test_robot = conformance_test(lambda: Sleec(parse("RULE r WHEN T THEN o")))
        """
    )
    result = pytester.runpytest_subprocess("-p", "no:cacheprovider")
    result.assert_outcomes(failed=len(PARTS) - 2, passed=1)
    result.stdout.fnmatch_lines(["*did not execute o; raised NotBound*", "*by rule r, clause 0*"])
    result.stdout.no_fnmatch_line("*Traceback*")
    result.stdout.no_fnmatch_line("*suite.py*")


def test_public_names() -> None:
    for name in conformance.__all__:
        assert getattr(conformance, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'tests'"):
        conformance.tests  # noqa: B018


def test_the_counts_of_the_guide() -> None:
    """docs/conformance-tests.md prints the number of situations, beside the 800 dispatches of E1 (paper)."""
    guide = Path("docs/conformance-tests.md").read_text(encoding="utf-8")
    (situations,) = re.findall(r"\*\*(\d+)\*\* situations", guide)
    assert each_rule(Bench(make_sleec)) == int(situations)
    assert len(load(EIGHT).rules) == 8
