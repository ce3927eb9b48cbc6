"""The runtime's face as the design shows it, on the ruleset that it names. These spellings must keep working."""

from __future__ import annotations

import contextpy3 as cop

import sleec_runtime
from tests.support.paths import ROOT

RULES = ROOT / "rulesets" / "household.sleec"


def test_a_class_of_variants():
    sleec = sleec_runtime.load(RULES, domain="household")
    done_by_code = []

    class Curtains:
        @sleec.rule("dress_assist")
        @cop.base
        def open_curtains_request(self, message):
            self.open_curtains()

        @cop.around(sleec.layers["dress_assist.hc1"])  # type: ignore[no-redef]
        def open_curtains_request(self, message):  # noqa: F811
            self.refuse_request()
            self.explain_why()

        @cop.around(sleec.layers["dress_assist.hc2"])  # type: ignore[no-redef]
        def open_curtains_request(self, message):  # noqa: F811
            self.warn_user()
            self.open_curtains()

        def open_curtains(self):
            done_by_code.append("OpenCurtains")

        def refuse_request(self):
            done_by_code.append("RefuseRequest")

        @sleec_runtime.obligation("ExplainWhy")
        def explain_why(self):
            done_by_code.append("ExplainWhy")

        def warn_user(self):
            done_by_code.append("WarnUser")

    sleec.bind(Curtains())
    sleec.update({"UserUndressed": True, "UserAge": 15})
    done = sleec.trigger("CurtainOpenRequest", "message")
    assert done.obligations == ("RefuseRequest", "ExplainWhy")
    assert [(clause.rule, clause.clause) for clause in done.clauses] == [("dress_assist", 1)]
    assert "UserUndressed" in done.explain()
    assert done_by_code == ["RefuseRequest", "ExplainWhy"]


def test_no_variant_written_by_hand():
    sleec = sleec_runtime.load(RULES, domain="household")
    done_by_code = []
    sleec.implement(
        {name: lambda *_, name=name: done_by_code.append(name) for name in sorted(sleec.ruleset.obligations)}
    )
    sleec.update({"UserUndressed": True, "UserDistressed": True})
    done = sleec.trigger("CurtainOpenRequest", "message")
    assert done.obligations == ("WarnUser", "OpenCurtains")
    assert done_by_code == ["WarnUser", "OpenCurtains"]
