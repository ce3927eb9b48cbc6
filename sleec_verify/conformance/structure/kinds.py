"""The kinds of finding about a robot's code, each with an example with and one without the problem."""

from __future__ import annotations

from sleec_verify.checks.base import FindingKind
from sleec_verify.conformance.structure.examples import (
    BASE,
    BLINDS,
    BODY,
    BUTTON,
    HEAD,
    HEDGE,
    HEDGE_2,
    PROHIBITING,
    ROBOT,
    RULES,
    SECOND_HEDGE,
    SECOND_RULE,
    TABLE,
    TAIL,
    example,
)
from sleec_verify.results.finding import Severity

KINDS: dict[str, FindingKind] = {}
"""By the names that the modules of this check have for them."""


def _kind(
    number: int,
    name: str,
    title: str,
    explanation: str,
    mend: str,
    bad: str,
    good: str = ROBOT,
    rules: str = RULES,
    severity: Severity = "error",
) -> None:
    KINDS[name] = FindingKind(
        f"SLEEC{number}", severity, title, explanation, mend, example(bad, rules), example(good, rules)
    )


# Methods, variants and layers -----------------------------------------------------------------------------

_kind(
    601,
    "missing-method",
    "a rule without a method",
    "The robot never does what the rule requires: no method is marked with the label of the rule or bound to its "
    "layers, and its obligations have no callables.",
    "Write a method for the rule, or pass its obligations to implement().",
    HEAD + TAIL,
)
_kind(
    602,
    "missing-base",
    "a method without a base variant",
    "The base runs if no exception applies. Without it, the default response is never executed.",
    "Write the default response under @cop.base.",
    HEAD + '    @sleec.rule("curtains")\n' + HEDGE + TAIL,
)
_kind(
    603,
    "missing-variant",
    "an exception without a variant",
    "If the exception applies, the robot does nothing. If layers are globally active, it does the default response.",
    "Write a variant under the layer of the exception.",
    HEAD + BASE + TAIL,
)
_kind(
    604,
    "unknown-layer",
    "a variant bound to a layer that the rules do not have",
    "The layer is never active, so the variant never runs.",
    "Use a layer of the rule: its label with .hc1, .hc2 and so on, in the order of its exceptions.",
    ROBOT.replace("curtains.hc1", "curtain.hc1"),
)
_kind(
    605,
    "no-layer",
    "a variant without a layer",
    "A variant without a layer takes the place of the base and always runs.",
    "Name the layer of its exception, or mark the base with @cop.base.",
    ROBOT.replace('@cop.around(sleec.layers["curtains.hc1"])', "@cop.around()"),
)
_kind(
    606,
    "foreign-layer",
    "a variant bound to a layer of another rule",
    "A layer is active only for its own rule, so this variant never runs.",
    "Bind it to a layer of its own rule, or move it to the other rule's method.",
    ROBOT + BLINDS + HEDGE.replace("request", "blinds", 1),
    ROBOT + BLINDS,
    RULES + SECOND_RULE,
)
_kind(
    607,
    "wrong-layer",
    "a variant bound to the layer of another clause",
    "The variant does what another clause of the rule requires. Probably two layers are swapped, or one is mistyped.",
    "Bind the variant to the layer of its own clause.",
    HEAD + BASE + HEDGE.replace("hc1", "hc2") + HEDGE_2.replace("hc2", "hc1") + TAIL,
    HEAD + BASE + HEDGE + HEDGE_2 + TAIL,
    RULES + SECOND_HEDGE,
)
_kind(
    608,
    "duplicate-variant",
    "two variants for one clause",
    "Only one of them runs: the last one with a layer, the first of two bases. The other has no effect.",
    "Remove one of them, or bind it to its own layer.",
    HEAD + BASE + HEDGE + HEDGE + TAIL,
)
_kind(
    609,
    "second-method",
    "a rule with two methods",
    "Each rule has one method (MM in the paper). Binding a second one is an error at run time. Two methods are correct "
    "if only one of them is ever bound.",
    "Keep one of the two, or merge them. If the target holds several robots, check them one by one.",
    HEAD + BASE + HEDGE + TAIL + "\nclass Blinds:\n" + BASE + HEDGE + TAIL,
    severity="warning",
)
_kind(
    610,
    "unknown-rule",
    "a method marked for a rule that does not exist",
    "No rule has this label. The program stops at this line with UnknownLabel.",
    "Correct the label, or write the rule.",
    ROBOT.replace('rule("curtains")', 'rule("curtain")'),
)
_kind(
    617,
    "guarded-variant",
    "a variant with a guard of its own",
    "The guard would decide whether the variant runs, in addition to the rule. bind() rejects it.",
    "Make the guard a condition of the rule.",
    ROBOT.replace('["curtains.hc1"])', '["curtains.hc1"], guard=lambda layers: True)'),
)
_kind(
    618,
    "lost-variant",
    "a variant that a later definition replaces",
    "A `def` without a decorator of ContextPy3 redefines the name and removes the variants above it. If layers are "
    "globally active, a base in a subclass does the same to inherited variants.",
    "Add @cop.base above it, or give it another name.",
    HEAD + BASE + HEDGE + "    def request(self, message):\n        self.open_curtains()\n\n" + TAIL,
)
_kind(
    619,
    "unmarked",
    "a method with layers but without a rule",
    "Without @sleec.rule, bind() does not find the method and no trigger runs it. This is correct only if its layers "
    "are globally active, as in the paper.",
    "Add @sleec.rule with the label of the rule above the base.",
    ROBOT.replace('    @sleec.rule("curtains")\n', ""),
    severity="note",
)

# What a variant does --------------------------------------------------------------------------------------

_kind(
    611,
    "missing-obligation",
    "a variant that omits an obligation of its clause",
    "The variant never executes an obligation of its clause. A properly structured variant calls the implementation of "
    "every obligation of its clause, in order, and nothing else (paper, Section 3.2).",
    "Call the implementation of the obligation, or remove the obligation from the rule.",
    ROBOT.replace("        self.explain_why()\n", ""),
)
_kind(
    612,
    "obligation-order",
    "a variant with its obligations in the wrong order",
    "The obligations of a clause must be executed in the order of the rule.",
    "Swap the calls, or the obligations in the rule.",
    ROBOT.replace(BODY, "        self.explain_why()\n        self.refuse_request()\n"),
)
_kind(
    613,
    "extra-obligation",
    "a variant that does more than its clause requires",
    "The variant executes an obligation that its clause does not have, or executes one twice. Obligations that are not "
    "entailed must not be executed (Proposition 1 of the paper).",
    "Remove the call, or add the obligation to the clause.",
    ROBOT.replace(BODY, BODY + "        self.open_curtains()\n"),
)
_kind(
    614,
    "prohibited-obligation",
    "a variant that does what its clause prohibits",
    "The clause says NOT, but the variant does it.",
    "Remove the call, or change the rule.",
    ROBOT.replace(BODY, "        self.open_curtains()\n"),
    ROBOT.replace(BODY, "        pass\n"),
    PROHIBITING,
)
_kind(
    615,
    "conditional-obligation",
    "an obligation that a variant may omit",
    "The call may run never or more than once, independently of the rule: it is inside `if`, `try` or a loop, in a "
    "function that other code must call, after a possible return, or it is not awaited.",
    "Add the condition to the rule, and call the obligation unconditionally.",
    ROBOT.replace(BODY, "        if message:\n            self.refuse_request()\n        self.explain_why()\n"),
)
_kind(
    616,
    "proceed",
    "a variant that calls proceed()",
    "proceed() also runs the base, and so the default response that the exception replaces.",
    "Call the obligations of the clause instead.",
    ROBOT.replace(BODY, BODY + "        cop.proceed(message)\n"),
)
_kind(
    620,
    "endless-trigger",
    "a variant that triggers its own rule again",
    "The same trigger in the same context activates the same clause and the same variant. This ends only if the "
    "context changes in between.",
    "Update the context first, or trigger after this variant has finished.",
    ROBOT.replace(BODY, BODY + '        sleec.trigger("CurtainRequest", message)\n'),
    severity="warning",
)

# Around the dispatch --------------------------------------------------------------------------------------

_kind(
    621,
    "obligation-around",
    "an obligation executed outside the dispatch",
    "The implementation of an obligation is called outside a variant, so it is executed whatever the rules say.",
    "Trigger the rule instead, or move the other code into a separate function.",
    ROBOT + BUTTON + "        self.open_curtains()\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    622,
    "method-around",
    "a rule's method called directly",
    "A direct call, without trigger(), runs the base whatever the rule says, because no layer is active.",
    "Call sleec.trigger(…), or activate the layers with activate_globally().",
    ROBOT + BUTTON + "        self.request(None)\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    623,
    "layer-by-hand",
    "a layer of a rule activated by the code",
    "The rules decide which layers are active. If code activates a layer, a variant runs in situations in which its "
    "clause does not apply.",
    "Update the context, and call trigger().",
    ROBOT + BUTTON + '        cop.global_activate_layer(sleec.layers["curtains.hc1"])\n',
    ROBOT + BUTTON + '        sleec.update({"UserUndressed": True})\n',
)

# implement ------------------------------------------------------------------------------------------------

_kind(
    631,
    "unknown-obligation",
    "a callable for an obligation that the rules do not have",
    "The table names an obligation that no rule has. The program stops there with UnknownObligation.",
    "Correct the name.",
    TABLE.replace('"ExplainWhy": ', '"ExplainWhy": print,\n    "ExplainWy": '),
    TABLE,
)
_kind(
    632,
    "missing-callable",
    "an obligation without a callable",
    "Rules without a method run the callables of their obligations, but this obligation has none.",
    "Pass one to implement().",
    TABLE.replace('    "ExplainWhy": lambda message: print("you are undressed"),\n', ""),
    TABLE,
)
_kind(
    690,
    "undecided",
    "a place that cannot be decided without running the program",
    "The behaviour of this code is known only at run time: for example a computed layer name, a decorator that may "
    "replace the method, or generated code. The check is inconclusive; the exit code is 3.",
    "Write it explicitly, or use the tests that run the code (`sleec_verify.conformance`).",
    ROBOT.replace('layers["curtains.hc1"]', "layers[input()]"),
    severity="warning",
)
