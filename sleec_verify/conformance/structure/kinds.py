"""The kinds of finding about a robot's code, each with rules and code that have it, and with some that have not."""

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
    "a rule that no method of the target is for",
    "What the rule obliges is never done: no method is marked with its label or bound to its layers, and no callables "
    "are given to its obligations.",
    "Write its method, or give its obligations to implement().",
    HEAD + TAIL,
)
_kind(
    602,
    "missing-base",
    "a method without a base variant",
    "The base is what runs where no hedge is active: without it the default of the rule is never done.",
    "Write the default under @cop.base.",
    HEAD + '    @sleec.rule("curtains")\n' + HEDGE + TAIL,
)
_kind(
    603,
    "missing-variant",
    "a hedge without a variant",
    "The exception that the rule makes is never made: the robot does nothing there, or, where layers are globally "
    "active, what the default says.",
    "Write a variant under the layer of the hedge.",
    HEAD + BASE + TAIL,
)
_kind(
    604,
    "unknown-layer",
    "a variant bound to a layer that the rules do not have",
    "The layer is never active, so the variant never runs.",
    "Use a layer of the rule: its label with .hc1, .hc2 and so on, in the order of its hedges.",
    ROBOT.replace("curtains.hc1", "curtain.hc1"),
)
_kind(
    605,
    "no-layer",
    "a variant bound to no layer",
    "Without a layer, a variant stands for the base and runs whatever the rule says.",
    "Name the layer of its hedge, or mark the base with @cop.base.",
    ROBOT.replace('@cop.around(sleec.layers["curtains.hc1"])', "@cop.around()"),
)
_kind(
    606,
    "foreign-layer",
    "a variant bound to a layer of another rule",
    "The layers of a rule are active where that rule says so. In the method of another rule such a variant never runs.",
    "Bind it to a layer of its own rule, or move it to the other rule's method.",
    ROBOT + BLINDS + HEDGE.replace("request", "blinds", 1),
    ROBOT + BLINDS,
    RULES + SECOND_RULE,
)
_kind(
    607,
    "wrong-layer",
    "a variant bound to the layer of another clause",
    "What the variant does is what another clause of its rule obliges: the layers are swapped, or one is mistyped.",
    "Bind the variant to the layer of the clause that it is for.",
    HEAD + BASE + HEDGE.replace("hc1", "hc2") + HEDGE_2.replace("hc2", "hc1") + TAIL,
    HEAD + BASE + HEDGE + HEDGE_2 + TAIL,
    RULES + SECOND_HEDGE,
)
_kind(
    608,
    "duplicate-variant",
    "two variants for one clause",
    "Only one of them runs: with layers, the one defined last; of two bases, the one that is defined first. The other "
    "looks as if it did something.",
    "Remove one, or bind it to the layer that it is for.",
    HEAD + BASE + HEDGE + HEDGE + TAIL,
)
_kind(
    609,
    "second-method",
    "a rule with two methods",
    "Each rule has one method (MM in the paper): binding a second one is an error at run time. It is no mistake where "
    "only one of the two is ever bound.",
    "Keep one of the two, or merge them. If the target holds several robots, check them one by one.",
    HEAD + BASE + HEDGE + TAIL + "\nclass Blinds:\n" + BASE + HEDGE + TAIL,
    severity="warning",
)
_kind(
    610,
    "unknown-rule",
    "a method marked for a rule that does not exist",
    "The label is that of no rule: the program stops at this line with UnknownLabel.",
    "Mend the spelling of the label, or write the rule.",
    ROBOT.replace('rule("curtains")', 'rule("curtain")'),
)
_kind(
    617,
    "guarded-variant",
    "a variant with a guard of its own",
    "Something besides the rule would choose whether the variant runs; bind() refuses it.",
    "Make the guard a condition of the rule.",
    ROBOT.replace('["curtains.hc1"])', '["curtains.hc1"], guard=lambda layers: True)'),
)
_kind(
    618,
    "lost-variant",
    "a variant that a later definition replaces",
    "A `def` without a decorator of ContextPy3 binds the name anew, and the variants above it are gone. Where layers "
    "are globally active, a base in a subclass does the same to the variants that it inherits.",
    "Put @cop.base above it, or give it another name.",
    HEAD + BASE + HEDGE + "    def request(self, message):\n        self.open_curtains()\n\n" + TAIL,
)
_kind(
    619,
    "unmarked",
    "a method that is bound to layers and marked for no rule",
    "Without @sleec.rule, bind() does not find the method and no trigger runs it. That is as intended only where its "
    "layers are globally active, the paper's own mode.",
    "Put @sleec.rule with the rule's label above its base.",
    ROBOT.replace('    @sleec.rule("curtains")\n', ""),
    severity="note",
)

# What a variant does --------------------------------------------------------------------------------------

_kind(
    611,
    "missing-obligation",
    "a variant that does not do what its clause obliges",
    "An obligation of the clause is never executed in its variant. A properly structured variant calls the "
    "implementation of every obligation of its clause, in order, and nothing else (paper, Section 3.2).",
    "Call the implementation of the obligation, or take the obligation out of the rule.",
    ROBOT.replace("        self.explain_why()\n", ""),
)
_kind(
    612,
    "obligation-order",
    "a variant that does its obligations in another order",
    "The clause lists its obligations in the order in which they are to be executed.",
    "Swap the calls, or the obligations in the rule.",
    ROBOT.replace(BODY, "        self.explain_why()\n        self.refuse_request()\n"),
)
_kind(
    613,
    "extra-obligation",
    "a variant that does more than its clause obliges",
    "An obligation is executed that the clause does not have, or has once and is executed twice. What is not entailed "
    "must not be executed (Proposition 1 of the paper).",
    "Remove the call, or add the obligation to the clause.",
    ROBOT.replace(BODY, BODY + "        self.open_curtains()\n"),
)
_kind(
    614,
    "prohibited-obligation",
    "a variant that does what its clause prohibits",
    "The clause says NOT, and the variant does it all the same.",
    "Remove the call, or change the rule.",
    ROBOT.replace(BODY, "        self.open_curtains()\n"),
    ROBOT.replace(BODY, "        pass\n"),
    PROHIBITING,
)
_kind(
    615,
    "conditional-obligation",
    "an obligation that a variant may not do",
    "Whether the call runs, or runs once, depends on more than the rule: it stands under `if`, `try` or a loop, in a "
    "function that something else must call, after a place where the variant may be left, or is not awaited.",
    "The rule alone is to decide: make what decides a condition of it, and call the obligation unconditionally.",
    ROBOT.replace(BODY, "        if message:\n            self.refuse_request()\n        self.explain_why()\n"),
)
_kind(
    616,
    "proceed",
    "a variant that calls proceed()",
    "proceed() runs the base after all, and so the default that the hedge is an exception to.",
    "Call what the clause obliges instead.",
    ROBOT.replace(BODY, BODY + "        cop.proceed(message)\n"),
)
_kind(
    620,
    "endless-trigger",
    "a variant that triggers its own rule again",
    "The same trigger in the same context means the same clause, and so the same variant: this comes to an end only "
    "if something changes the context meanwhile.",
    "Update the context first, or trigger once this one is served.",
    ROBOT.replace(BODY, BODY + '        sleec.trigger("CurtainRequest", message)\n'),
    severity="warning",
)

# Around the dispatch --------------------------------------------------------------------------------------

_kind(
    621,
    "obligation-around",
    "an obligation executed around the dispatch",
    "The implementation of an obligation is called from elsewhere than a variant: it is executed whatever the rules "
    "say.",
    "Trigger the rule instead, or move what is not the obligation into a function of its own.",
    ROBOT + BUTTON + "        self.open_curtains()\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    622,
    "method-around",
    "a rule's method called directly",
    "Called directly, and not by trigger(), the method runs its base whatever the rule says, because no layer is "
    "active.",
    "Call sleec.trigger(…), or activate the layers with activate_globally().",
    ROBOT + BUTTON + "        self.request(None)\n",
    ROBOT + BUTTON + '        sleec.trigger("CurtainRequest", None)\n',
)
_kind(
    623,
    "layer-by-hand",
    "a layer of a rule activated by hand",
    "The rules decide which layers are active. Activated by hand, a variant runs in situations in which its clause is "
    "not the one that decides.",
    "Update the context, and trigger.",
    ROBOT + BUTTON + '        cop.global_activate_layer(sleec.layers["curtains.hc1"])\n',
    ROBOT + BUTTON + '        sleec.update({"UserUndressed": True})\n',
)

# implement ------------------------------------------------------------------------------------------------

_kind(
    631,
    "unknown-obligation",
    "a callable for an obligation that the rules do not have",
    "The table names an obligation that no rule has: the program stops there with UnknownObligation.",
    "Mend the spelling of the name.",
    TABLE.replace('"ExplainWhy": ', '"ExplainWhy": print,\n    "ExplainWy": '),
    TABLE,
)
_kind(
    632,
    "missing-callable",
    "an obligation without a callable",
    "Rules without a method of their own run the callables of their obligations, and for this one there is none.",
    "Give it one with implement().",
    TABLE.replace('    "ExplainWhy": lambda message: print("you are undressed"),\n', ""),
    TABLE,
)
_kind(
    690,
    "undecided",
    "a place that cannot be decided without running the program",
    "What happens here depends on what is known only at run time: a layer's name that is computed, a decorator that "
    "may replace the method, code that is made as it runs. It is neither right nor wrong; the exit code is 3.",
    "Write it out, or leave it to the tests that run the code (`sleec_verify.conformance`).",
    ROBOT.replace('layers["curtains.hc1"]', "layers[input()]"),
    severity="warning",
)
