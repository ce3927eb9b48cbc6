"""The kinds of finding about a robot's code. Each has an example with the problem and one without it."""

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
    TIMED_ROBOT,
    TIMED_RULES,
    TIMED_TABLE,
    example,
)
from sleec_verify.results.finding import Severity

KINDS: dict[str, FindingKind] = {}
"""From the names that the modules of this check use to the kinds."""


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
    "No code runs for this rule: no method is marked with its label or bound to its layers, and its obligations have "
    "no callables.",
    "Write its method, or pass callables for its obligations to implement().",
    HEAD + TAIL,
)
_kind(
    602,
    "missing-base",
    "a method without a base variant",
    "The base runs if no exception applies. Without a base, no code runs for the rule's default response.",
    "Write a variant for the default response under @cop.base.",
    HEAD + '    @sleec.rule("curtains")\n' + HEDGE + TAIL,
)
_kind(
    603,
    "missing-variant",
    "an exception without a variant",
    "No code runs for this exception. If the layers are globally active, the base runs instead.",
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
    "a variant bound to no layer",
    "A variant without a layer counts as the base. It runs in every situation, whatever the rule requires.",
    "Name the layer of its exception, or mark the base with @cop.base.",
    ROBOT.replace('@cop.around(sleec.layers["curtains.hc1"])', "@cop.around()"),
)
_kind(
    606,
    "foreign-layer",
    "a variant bound to a layer of another rule",
    "The layers of a rule are active only while that rule is dispatched. In the method of another rule, this variant "
    "never runs.",
    "Bind it to a layer of its own rule, or move it to the other rule's method.",
    ROBOT + BLINDS + HEDGE.replace("request", "blinds", 1),
    ROBOT + BLINDS,
    RULES + SECOND_RULE,
)
_kind(
    607,
    "wrong-layer",
    "a variant bound to the layer of another clause",
    "The variant does what another clause of its rule requires. The layers are swapped, or one is misspelled.",
    "Bind the variant to the layer of the clause that it implements.",
    HEAD + BASE + HEDGE.replace("hc1", "hc2") + HEDGE_2.replace("hc2", "hc1") + TAIL,
    HEAD + BASE + HEDGE + HEDGE_2 + TAIL,
    RULES + SECOND_HEDGE,
)
_kind(
    608,
    "duplicate-variant",
    "two variants for one clause",
    "Only one of them runs: of two variants with the same layer, the last definition; of two bases, the first. The "
    "other one has no effect.",
    "Remove one, or bind it to the layer of the clause that it implements.",
    HEAD + BASE + HEDGE + HEDGE + TAIL,
)
_kind(
    609,
    "second-method",
    "a rule with two methods",
    "Each rule has one method. If the program binds a second one, it stops with an error. This is fine if the program "
    "binds only one of them.",
    "Keep one of the two, or merge them. If the target contains several robots, check them one by one.",
    HEAD + BASE + HEDGE + TAIL + "\nclass Blinds:\n" + BASE + HEDGE + TAIL,
    severity="warning",
)
_kind(
    610,
    "unknown-rule",
    "a method marked for a rule that does not exist",
    "No rule has this label. The program stops at this line with UnknownLabel.",
    "Correct the spelling of the label, or write the rule.",
    ROBOT.replace('rule("curtains")', 'rule("curtain")'),
)
_kind(
    617,
    "guarded-variant",
    "a variant with a guard",
    "Only the rule may decide whether a variant runs. bind() rejects a variant with a guard.",
    "Move the guard into the rule as a condition.",
    ROBOT.replace('["curtains.hc1"])', '["curtains.hc1"], guard=lambda layers: True)'),
)
_kind(
    618,
    "lost-variant",
    "a variant that a later definition replaces",
    "A `def` without a decorator of ContextPy3 replaces the variants above it. If the layers are globally active, a "
    "base in a subclass also replaces the variants that it inherits.",
    "Put @cop.base above it, or give it another name.",
    HEAD + BASE + HEDGE + "    def request(self, message):\n        self.open_curtains()\n\n" + TAIL,
)
_kind(
    619,
    "unmarked",
    "a method with layers, but without a rule",
    "Without @sleec.rule, bind() does not find the method, and no trigger runs it. This is correct only if its layers "
    "are globally active.",
    "Put @sleec.rule with the rule's label above its base.",
    ROBOT.replace('    @sleec.rule("curtains")\n', ""),
    severity="note",
)

# What a variant does --------------------------------------------------------------------------------------

_kind(
    611,
    "missing-obligation",
    "a variant that omits an obligation of its clause",
    "The variant does not execute an obligation of its clause. A properly structured variant calls the "
    "implementation of every obligation of its clause, in order, and no other (paper, Section 3.2).",
    "Call the implementation of the obligation, or remove the obligation from the rule.",
    ROBOT.replace("        self.explain_why()\n", ""),
)
_kind(
    612,
    "obligation-order",
    "a variant with its obligations in the wrong order",
    "A variant must execute the obligations of its clause in the order of the text.",
    "Swap the calls, or the obligations in the rule.",
    ROBOT.replace(BODY, "        self.explain_why()\n        self.refuse_request()\n"),
)
_kind(
    613,
    "extra-obligation",
    "a variant that does more than its clause requires",
    "The variant executes an obligation that its clause does not have, or it executes an obligation twice. The robot "
    "must not execute what the rules do not entail (Proposition 1 of the paper).",
    "Remove the call, or add the obligation to the clause.",
    ROBOT.replace(BODY, BODY + "        self.open_curtains()\n"),
)
_kind(
    614,
    "prohibited-obligation",
    "a variant that does what its clause forbids",
    "The clause forbids this with NOT, but the variant still does it.",
    "Remove the call, or change the rule.",
    ROBOT.replace(BODY, "        self.open_curtains()\n"),
    ROBOT.replace(BODY, "        pass\n"),
    PROHIBITING,
)
_kind(
    615,
    "conditional-obligation",
    "an obligation that might not be executed",
    "The call may run never, or more than once. It is under `if`, `try` or a loop, in a function that other code must "
    "call, or after a point where the variant can return. Or it is a coroutine that is not awaited.",
    "Move the test into the rule as a condition. Then call the obligation unconditionally.",
    ROBOT.replace(BODY, "        if message:\n            self.refuse_request()\n        self.explain_why()\n"),
)
_kind(
    616,
    "proceed",
    "a variant that calls proceed()",
    "proceed() runs the default, which this exception replaces.",
    "Call the implementations of the clause's obligations instead.",
    ROBOT.replace(BODY, BODY + "        cop.proceed(message)\n"),
)
_kind(
    620,
    "endless-trigger",
    "a variant that triggers its own rule again",
    "The same trigger in the same context runs the same variant again. This recursion ends only if the context "
    "changes.",
    "Update the context first, or trigger after this trigger is handled.",
    ROBOT.replace(BODY, BODY + '        sleec.trigger("CurtainRequest", message)\n'),
    severity="warning",
)

# Outside the variants -------------------------------------------------------------------------------------

_kind(
    621,
    "obligation-around",
    "an obligation that is executed outside a variant",
    "This code calls the implementation of an obligation, but is not part of a variant. So the obligation is executed "
    "whether or not the rules require it.",
    "Trigger the rule instead. If you need only part of the implementation, move that part into another function.",
    ROBOT + BUTTON + "        self.open_curtains()\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    622,
    "method-around",
    "a rule's method that is called directly",
    "In a direct call, no layer is active. So the method runs its base, even if an exception applies.",
    "Call sleec.trigger(…), or activate the layers with activate_globally().",
    ROBOT + BUTTON + "        self.request(None)\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    623,
    "layer-by-hand",
    "a layer of a rule that is activated by hand",
    "The rules decide which layers are active. If other code activates a layer, its variant also runs if the exception "
    "does not apply.",
    "Update the context, then call trigger().",
    ROBOT + BUTTON + '        cop.global_activate_layer(sleec.layers["curtains.hc1"])\n',
    ROBOT + BUTTON + '        sleec.update({"UserUndressed": True})\n',
)

# implement ------------------------------------------------------------------------------------------------

_kind(
    631,
    "unknown-obligation",
    "a callable for an obligation that the rules do not have",
    "The table, or a call of completed(), names an obligation that no rule has. The program stops at this line with "
    "UnknownObligation.",
    "Correct the spelling of the name.",
    TABLE.replace('"ExplainWhy": ', '"ExplainWhy": print,\n    "ExplainWy": '),
    TABLE,
)
_kind(
    632,
    "missing-callable",
    "an obligation without a callable",
    "A rule without a method runs the callables of its obligations. The same applies to what follows OTHERWISE and "
    "ELSE, also if the rule has a method. This obligation has no callable.",
    "Pass a callable for it to implement().",
    TABLE.replace('    "ExplainWhy": lambda message: print("you are undressed"),\n', ""),
    TABLE,
)

# Rules with time ------------------------------------------------------------------------------------------

_kind(
    641,
    "different-starts",
    "a method for obligations that start at different times",
    "A method is called once for a clause. If the windows of the clause open at different times, the trigger raises "
    "NotBound.",
    "Pass callables for the obligations to implement(), or write two rules.",
    TIMED_ROBOT.replace("self.call_nurse()", "self.offer_water()\n        self.call_nurse()")
    + "    def offer_water(self): ...\n",
    TIMED_TABLE,
    TIMED_RULES.replace("CallNurse", "OfferWater WITHIN 1 TO 9 minutes AND CallNurse", 1),
)
_kind(
    642,
    "unguarded-act",
    "a forbidden act that no dispatch guards",
    "A rule forbids this act for a time, and the runtime rejects each dispatch of it in that time. This code is not "
    "part of a dispatch. So it may execute the act while the act is forbidden.",
    "Write a rule that requires the act, and trigger this rule.",
    TIMED_ROBOT + "    def on_button(self):\n        self.vacuum()\n",
    TIMED_ROBOT + '    def on_button(self):\n        sleec.trigger("DustSeen")\n',
    TIMED_RULES,
)
_kind(
    643,
    "never-completed",
    "an obligation that is never completed",
    "The code is marked with completes=False, so it only starts the obligation. The obligation is met when the robot "
    "calls completed(). No code of the target does so, so the deadline is always missed.",
    "Call sleec.completed() with the name of the obligation when it is done.",
    TIMED_ROBOT.replace('("CallNurse")', '("CallNurse", completes=False)'),
    TIMED_ROBOT.replace('("CallNurse")', '("CallNurse", completes=False)')
    + '    def on_answer(self):\n        sleec.completed("CallNurse")\n',
    TIMED_RULES,
)
_kind(
    644,
    "timed-global-activation",
    "global activation of rules with time",
    "Global activation has no deadlines and rejects rules with time. The program stops at this line with "
    "UnsupportedTimes.",
    "Run the methods with trigger().",
    TIMED_ROBOT + "\nsleec.activate_globally()\n",
    TIMED_ROBOT + '\nsleec.trigger("UserFell")\n',
    TIMED_RULES,
)
_kind(
    690,
    "undecided",
    "code that cannot be checked without running it",
    "The effect of this code is known only at run time. Examples are a computed layer name, a decorator that may "
    "replace the method, and generated code. If there is no other finding, the exit code is 3.",
    "Write the names and calls directly in the code, or test the code by running it (`sleec_verify.conformance`).",
    ROBOT.replace('layers["curtains.hc1"]', "layers[input()]"),
    severity="warning",
)
