"""The rules that a node executes. The tasks of a robot share the rules, and each has the code of some of them."""

from __future__ import annotations

from collections.abc import Iterable

import contextpy3

from sleec_runtime.dispatch.required_code import missing
from sleec_runtime.errors import NotBound, UnknownLabel, WrongType
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.model import Rule, literals
from sleec_runtime.ros.identity import snapshot_of
from sleec_runtime.ros.managed_triggers import managed_triggers


def claim_rules(sleec: Sleec, labels: Iterable[str] | None) -> frozenset[str]:
    """The labels of the rules that this node decides: `labels`, or by default the rules that have code.

    Those that the Context Manager decides are left out (see `managed_triggers`). The other rules of the same triggers
    get code that does nothing, because other nodes execute them. They are still decided, so that conflicts with them
    are found. Raises WrongType, UnknownLabel, and NotBound if code is missing or would never run.
    """
    rules, code = snapshot_of(sleec).index.whole.by_label, sleec.code
    if isinstance(labels, str):
        raise WrongType("rules", labels, "a list of labels", f"give [{labels!r}]")
    if labels is None:
        own = frozenset(label for label, rule in rules.items() if code.has_code(rule))
        clauses = (clause for rule in rules.values() for clause in rule.clauses())
        if not own and not any(code.given(literal.name) for clause in clauses for literal in literals(clause)):
            raise NotBound("this node has no code for the rules", (), "give it callables by `implement`, or methods")
    else:
        try:
            own = frozenset(labels)
        except TypeError:
            raise WrongType("rules", labels, "a list of labels") from None
        for label in own - rules.keys():
            raise UnknownLabel(label, rules)
    managed = managed_triggers(snapshot_of(sleec).index.whole)
    idle = sorted(label for label in own if rules[label].trigger in managed and code.has_method(label))
    if idle:
        raise NotBound(
            f"rule `{idle[0]}` has a method, which would never run: the Context Manager decides rules with time, and "
            "those that share obligations with them",
            idle,
            "give its obligations callables by `implement`, and remove the method",
        )
    own = frozenset(label for label in own if rules[label].trigger not in managed)
    problems = missing([rules[label] for label in own], code)
    if problems:
        raise NotBound(
            "; ".join(str(problem.message) for problem in problems.values()),
            sorted(problems),
            "add the code, or name the rules of this node with rules=[…]",
        )
    code.is_partial = True
    triggers = {rules[label].trigger for label in own}
    for label, rule in rules.items():
        if label not in own and rule.trigger in triggers and not code.has_method(label):
            sleec.bind(_method_without_effect(sleec, rule))
    return own


def _method_without_effect(sleec: Sleec, rule: Rule) -> object:
    """A method of `rule` whose variants do nothing."""
    for number, _ in enumerate(rule.clauses()):
        layer = rule.layer(number)
        decorator = contextpy3.base if layer is None else contextpy3.around(sleec.layers[layer])

        @decorator  # type: ignore[untyped-decorator]
        def elsewhere(*args: object, **kwargs: object) -> None:
            """Another node does it."""

    return sleec.rule(rule.label)(elsewhere)
