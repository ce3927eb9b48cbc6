(** No context of as-evaluated.sleec conflicts.

    A comparison of a measure is a condition here, as in `certificates.theory.boolean`;
    what is assumed of the order of these is true of all values.

    Written by `make theorems`; do not edit. *)

From Coq Require Import List PArith.
From Sleec Require Import Model Nested Constraints.
From Checker Require Import Formula Checker.
From Oracle Require Import Certified.
Import ListNotations.
Local Open Scope positive_scope.

(** The rules in the domain hospital.

    triggers: 1 HumanOnFloor, 2 MonitorMealTime, 3 AddressUserName, 4 InstructionFail,
      5 PreparingExamination
    conditions: 1 UserResponsive, 2 UserWithCompanion, 3 UserOccupied,
      4 UserNameUnknown, 5 UserDirectsOtherwise, 6 InstructionRepeat < 3, 7 TimeElapsed
      <= 20, 8 UserAge < 18
    obligations: 1 CallEmergencyServices, 2 AskForUserStatus, 3 AskCompanionToCheck,
      4 InformUser, 5 RemindLater, 6 UsePreferredName, 7 AddressSirOrMadam,
      8 UseUserChosenName, 9 RepeatInstruction, 10 CallSupport, 11 EnsurePrivateSpace,
      12 AskLegalPresence
    rules: 1 human_on_floor, 2 mealtime, 3 daisy_addressing, 4 daisy_instruction,
      5 daisy_examination *)
Module as_evaluated_hospital.

Definition rules : list nested_rule :=
  [ NestedRule 1 1 (Truth true)
     (Chain [Do 1]
      [ ((Atom (Holds 1)), (Chain [Do 2] []));
        ((Atom (Holds 2)), (Chain [Do 3] [])) ]);
    NestedRule 2 2 (Truth true)
     (Chain [Do 4]
      [ ((Atom (Holds 3)), (Chain [Do 5] [])) ]);
    NestedRule 3 3 (Truth true)
     (Chain [Do 6]
      [ ((Atom (Holds 4)), (Chain [Do 7] []));
        ((Atom (Holds 5)), (Chain [Do 8] [])) ]);
    NestedRule 4 4 (Truth true)
     (Chain [Do 9]
      [ ((Or (Not (Atom (Holds 6))) (Not (Atom (Holds 7)))), (Chain [Do 10] [])) ]);
    NestedRule 5 5 (Truth true)
     (Chain [Do 11]
      [ ((Atom (Holds 8)), (Chain [Do 12] [])) ]) ].

Definition constraints : list constraint := [].

Definition steps : list step :=
  [ Add 3 [] [1] ].

End as_evaluated_hospital.

Theorem as_evaluated_hospital_conflict_free :
  never_conflicts Cascade as_evaluated_hospital.rules as_evaluated_hospital.constraints.
Proof. apply (certified_never_conflicts _ _ _ as_evaluated_hospital.steps). vm_compute. reflexivity. Qed.

(** The rules in the domain household.

    triggers: 1 HumanOnFloor, 2 MonitorMealTime, 3 CurtainOpenRequest,
      4 DressingStarted, 5 UserSaysStop
    conditions: 1 UserResponsive, 2 UserWithCompanion, 3 UserOccupied, 4 UserUndressed,
      5 UserDistressed, 6 MedicalEmergency, 7 UserAdvices
    obligations: 1 CallEmergencyServices, 2 AskForUserStatus, 3 AskCompanionToCheck,
      4 InformUser, 5 RemindLater, 6 OpenCurtains, 7 RefuseRequest, 8 ExplainWhy,
      9 WarnUser, 10 CloseDoor, 11 DoNothing, 12 RobotStop, 13 AskToFinishFirst
    rules: 1 human_on_floor, 2 mealtime, 3 dress_assist, 4 dressing_started,
      5 dressing_stop *)
Module as_evaluated_household.

Definition rules : list nested_rule :=
  [ NestedRule 1 1 (Truth true)
     (Chain [Do 1]
      [ ((Atom (Holds 1)), (Chain [Do 2] []));
        ((Atom (Holds 2)), (Chain [Do 3] [])) ]);
    NestedRule 2 2 (Truth true)
     (Chain [Do 4]
      [ ((Atom (Holds 3)), (Chain [Do 5] [])) ]);
    NestedRule 3 3 (Truth true)
     (Chain [Do 6]
      [ ((Atom (Holds 4)), (Chain [Do 7; Do 8] []));
        ((Atom (Holds 5)), (Chain [Do 9; Do 6] [])) ]);
    NestedRule 4 4 (Truth true)
     (Chain [Do 10]
      [ ((Or (Atom (Holds 6)) (Atom (Holds 7))), (Chain [Do 11] [])) ]);
    NestedRule 5 5 (Truth true)
     (Chain [Do 12]
      [ ((Not (Truth true)), (Chain [Do 13] [])) ]) ].

Definition constraints : list constraint := [].

Definition steps : list step :=
  [ Add 3 [] [1] ].

End as_evaluated_household.

Theorem as_evaluated_household_conflict_free :
  never_conflicts Cascade as_evaluated_household.rules as_evaluated_household.constraints.
Proof. apply (certified_never_conflicts _ _ _ as_evaluated_household.steps). vm_compute. reflexivity. Qed.
