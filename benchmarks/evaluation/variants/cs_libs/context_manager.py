"""The Context Manager Node of CS-libs: evaluates every rule when the context changes."""

from __future__ import annotations

import json
from typing import Any

from benchmarks.evaluation.variants.topics import CONDITIONS, DOMAIN
from sleec_runtime.ros.transport import Fields, Topic, Transport

SELECTED = Topic("/selected_clauses", latched=True, depth=1)
"""The selected clause of each rule: 0 for the default, or the number of the hedge clause. Rules of other domains are
not listed."""
LEGAL_AGE = 18
RISKS = ("r_low", "r_moderate", "r_severe")


class ContextManagerNode:
    def __init__(self, transport: Transport) -> None:
        self.domain: str | None = None
        self.conditions: dict[str, Any] = {}
        self.selected = transport.publisher(SELECTED)
        transport.subscribe(DOMAIN, self.on_domain)
        transport.subscribe(CONDITIONS, self.on_conditions)

    def on_domain(self, message: Fields) -> None:
        self.domain = json.loads(str(message["data"]))["domain"]
        self.evaluate_rules()

    def on_conditions(self, message: Fields) -> None:
        self.conditions.update(json.loads(str(message["data"])))
        self.evaluate_rules()

    def evaluate_rules(self) -> None:
        selected = {"human_on_floor": self.human_on_floor(), "mealtime": self.mealtime()}
        if self.domain == "hospital":
            selected["daisy_addressing"] = self.daisy_addressing()
            selected["daisy_instruction"] = self.daisy_instruction()
            selected["daisy_examination"] = self.daisy_examination()
        if self.domain == "household":
            selected["dress_assist"] = self.dress_assist()
            selected["dressing_started"] = self.dressing_started()
            selected["dressing_stop"] = self.dressing_stop()
        self.selected.publish({"data": json.dumps(selected)})

    def human_on_floor(self) -> int:
        if self.conditions.get("UserResponsive"):
            if self.conditions.get("UserWithCompanion"):
                return 2
            return 1
        return 0

    def mealtime(self) -> int:
        if self.conditions.get("UserOccupied"):
            return 1
        return 0

    def daisy_addressing(self) -> int:
        if self.conditions.get("UserNameUnknown"):
            if self.conditions.get("UserDirectsOtherwise"):
                return 2
            return 1
        return 0

    def daisy_instruction(self) -> int:
        repeat = self.conditions.get("InstructionRepeat")
        elapsed = self.conditions.get("TimeElapsed")
        if (repeat is not None and repeat >= 3) or (elapsed is not None and elapsed > 20):
            return 1
        return 0

    def daisy_examination(self) -> int:
        age = self.conditions.get("UserAge")
        if age is not None and age < LEGAL_AGE:
            return 1
        return 0

    def dress_assist(self) -> int:
        if self.conditions.get("UserUndressed"):
            if self.conditions.get("UserDistressed"):
                return 2
            return 1
        return 0

    def dressing_started(self) -> int:
        if self.conditions.get("MedicalEmergency") or self.conditions.get("UserAdvices"):
            return 1
        return 0

    def dressing_stop(self) -> int:
        risk = self.conditions.get("RiskLevel")
        if risk is not None and RISKS.index(risk) > RISKS.index("r_low"):
            return 1
        return 0
