"""The check as a whole: rules, methods, tables and what reaches around them."""

from __future__ import annotations

import ast
from collections import Counter

from sleec_runtime.model import Rule, Ruleset, constructs
from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.structure.abstract_execution import AbstractExecutor
from sleec_verify.conformance.structure.bypasses import BypassCheck
from sleec_verify.conformance.structure.completion import CompletionCheck
from sleec_verify.conformance.structure.layering import MethodCheck
from sleec_verify.conformance.structure.methods import Group, Method, groups, methods
from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.own_conditions import OwnConditions
from sleec_verify.conformance.structure.program import Assignment, Class, Function, TargetProgram
from sleec_verify.conformance.structure.prohibitions import LastingProhibitions
from sleec_verify.conformance.structure.report import Findings
from sleec_verify.conformance.structure.resolve import Resolver
from sleec_verify.conformance.structure.tables import Tables
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.conformance.structure.uses import Use, uses
from sleec_verify.conformance.structure.values import ClassOf, Layer, OwnLayer
from sleec_verify.results.finding import Finding


def findings_on(ruleset: Ruleset, files: tuple[PythonFile, ...], domain: str | None) -> tuple[Finding, ...]:
    """All that is found in `files`."""
    return StructureCheck(ruleset, files, domain).findings.found


class StructureCheck:
    def __init__(self, ruleset: Ruleset, files: tuple[PythonFile, ...], domain: str | None) -> None:
        self.ruleset = ruleset
        self.findings = Findings(ruleset)
        self.layers = {
            layer: (rule.label, number)
            for rule in ruleset.rules
            for number, _ in enumerate(rule.clauses())
            if (layer := rule.layer(number)) is not None
        }
        program = TargetProgram(files)
        self.resolver = Resolver(program)
        self.names = Names(ruleset.obligations, self.resolver)
        everything = list(uses(program))
        calls = [(use, use.node) for use in everything if isinstance(use.node, ast.Call)]
        made: set[Class] = set()
        for use, call in calls:
            value = self.resolver.of(call.func, use.scope)
            if isinstance(value, ClassOf):
                made.add(value.class_)
        in_force = ruleset if domain is None else ruleset.in_domain(domain)
        self.timed = any(constructs(in_force))
        self.globally = self._activates_globally(calls)
        found = list(groups(program, self.resolver))
        self.methods = list(methods(program, self.resolver, found, made))
        self.labels = {method: self._labels(method) for method in self.methods}
        concerned = [group for group in found if group.concerns_rules]
        self.tracer = AbstractExecutor(
            self.resolver, self.names, {v.function for group in concerned for v in group.variants}
        )
        self.tables = Tables(self.resolver, self.names, self.findings)
        for use, _ in calls:
            self.tables.read(use)
        self._rules(in_force.rules)
        for group in concerned:
            self._definitions(group)
        for method in self.methods:
            self._bound_otherwise(method)
        conditions = OwnConditions(self.resolver, everything)
        prohibitions = LastingProhibitions(in_force.rules, self.findings, conditions)
        if self.timed:
            completion = CompletionCheck(self.resolver, self.names, prohibitions, self.findings)
            for use in everything:
                completion.read(use)
            completion.report()
        around = BypassCheck(
            self.resolver,
            self.names,
            self.findings,
            self.tracer,
            self.tables,
            self.methods,
            self.layers,
            self.globally,
            prohibitions,
        )
        for use in everything:
            around.look(use)

    def _activates_globally(self, calls: list[tuple[Use, ast.Call]]) -> bool:
        """Whether the target activates layers globally. With rules with time, it cannot: that is reported."""
        found = [
            (use.scope.file, call)
            for use, call in calls
            if isinstance(call.func, ast.Attribute) and call.func.attr == "activate_globally"
        ]
        for at in found if self.timed else ():
            self.findings.add(
                "timed-global-activation",
                "global activation rejects rules with time, so this raises UnsupportedTimes",
                at,
                help="run the methods with trigger()",
            )
        return bool(found) and not self.timed

    def _rules(self, rules: tuple[Rule, ...]) -> None:
        """Each rule against its methods; those that have none against the tables."""
        without: list[Rule] = []
        of_rule: dict[str, list[Method]] = {}
        for method, labels in self.labels.items():
            for label in labels:
                of_rule.setdefault(label, []).append(method)
        for rule in rules:
            own = of_rule.get(rule.label, [])
            for method in own:
                by_hand = self.globally or not method.marks
                MethodCheck(method, rule, self.labels[method], self.layers, self.tracer, self.findings, by_hand).run()
            # Without a mark, only global activation runs a method, which rules with time do not have.
            bound = [method for method in own if method.marks or not self.timed]
            if not bound:
                without.append(rule)
            self._second(rule, own)
        unimplemented = self.tables.check(without)
        for rule in rules:
            if rule not in unimplemented:
                self.tables.check_alternatives(rule, next(iter(of_rule.get(rule.label, ())), None))
        for rule in unimplemented:
            self.findings.add(
                "missing-method",
                f"rule `{rule.label}` has no method in the target",
                None,
                span=rule.heading_span,
                rules=(rule.label,),
                help=f'mark one with @sleec.rule("{rule.label}"), or implement() its obligations',
            )

    def _labels(self, method: Method) -> list[str]:
        """The rules that a method is for: those that it is marked for, or else those that its layers are of."""
        if method.marks:
            near = (
                label if label in self.ruleset.by_label else nearest(label, self.ruleset.by_label)
                for label in method.labels
            )
            return list(dict.fromkeys(label for label in near if label is not None))
        counted: Counter[str] = Counter()
        for name in method.layer_names:
            layer = name if name in self.layers else nearest(name, self.layers)
            if layer is not None:
                counted[self.layers[layer][0]] += 1
        complete = [
            label
            for label, number in counted.items()
            if number >= sum(1 for _ in self.ruleset.by_label[label].clauses()) - 1
        ]
        return complete or [label for label, _ in counted.most_common(1)]

    def _second(self, rule: Rule, own: list[Method]) -> None:
        """Methods of one rule that have no definition in common."""
        for place, method in enumerate(own):
            first = own[0]
            if place and not set(first.groups) & set(method.groups):
                at = method.variants[0].function
                earlier = first.variants[0].function
                line = earlier.node.lineno
                self.findings.add(
                    "second-method",
                    f"{rule.label} has a second method, {first.name} ({earlier.file.source.path}:{line})",
                    (at.file, at.node),
                    rules=(rule.label,),
                    help="mark only one of them, unless only one is ever bound",
                )

    def _definitions(self, group: Group) -> None:
        """Reports errors in the definitions of a method that do not depend on its rule."""
        name = group.name
        for mark, node in group.marks:
            file = group.scope.file
            if mark.label is None:
                self.findings.undecided(file, node, "the label of the rule is known only at run time")
            elif mark.label not in self.ruleset.by_label:
                near = nearest(mark.label, self.ruleset.by_label)
                hint = f"did you mean `{near}`?" if near else f"the rules are {', '.join(self.ruleset.by_label)}"
                self.findings.add("unknown-rule", f"no rule is called `{mark.label}`", (file, node), help=hint)
        for variant in group.variants:
            file = variant.function.file
            if variant.guarded:
                message = f"this variant of {name} has a guard, so not only the rule decides whether it runs"
                self.findings.add(
                    "guarded-variant", message, (file, variant.at), help="add it as a condition to the rule"
                )
            for decorator in variant.foreign:
                why = f"this decorator may replace {name}"
                self.findings.undecided(file, decorator, why)
            if not variant.function.certain:
                self.findings.undecided(file, variant.function.node, f"this variant of {name} is defined conditionally")
            if variant.layer is not None and not isinstance(variant.layer, (Layer, OwnLayer)):
                self.findings.undecided(file, variant.at, "the layer is known only at run time")
        for old, new in group.lost:
            self.findings.add(
                "lost-variant",
                f"the {name} on line {new.function.node.lineno} replaces this variant",
                (old.function.file, old.at),
                help="add @cop.base above the later one, or give it another name",
            )
        self._unmarked(group)

    def _bound_otherwise(self, method: Method) -> None:
        """A subclass that gives the name of a rule's method to something else than a `def`, such as a lambda."""
        classes = () if method.class_ is None else self.resolver.order(method.class_)[0]
        for class_ in classes:
            for binding in class_.inner.bindings.get(method.name, ()):
                if not isinstance(binding, Function):
                    node = binding.value if isinstance(binding, Assignment) else class_.node
                    why = f"{method.name} is bound without `def`, which may replace the method of a rule"
                    self.findings.undecided(class_.scope.file, node, why)

    def _unmarked(self, group: Group) -> None:
        holders = [method for method in self.methods if group.name == method.name and group in method.groups]
        inherited = any(method.marks for method in holders)
        labels = [label for method in holders for label in self.labels[method]]
        if not inherited and labels and not any(group.marks):
            first = group.variants[0].function
            self.findings.add(
                "unmarked",
                f"{group.name} is bound to layers of {labels[0]} but not marked as its method, so no trigger runs it",
                (first.file, first.node),
                rules=(labels[0],),
                help=f'put @sleec.rule("{labels[0]}") above it, unless its layers are globally active',
            )
