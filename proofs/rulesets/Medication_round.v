(** No context of medication-round.sleec conflicts.

    Written by `make theorems`; do not edit. *)

From Coq Require Import List PArith.
From Sleec Require Import Model Nested Constraints.
From Checker Require Import Formula Checker.
From Oracle Require Import Certified.
Import ListNotations.
Local Open Scope positive_scope.

(** The rules.

    triggers: 1 MedicationDue, 2 PainkillerDue, 3 SleepingPillDue
    conditions: 1 ResidentRefuses, 2 LacksCapacity
    obligations: 1 OfferMedication, 2 RecordRefusal, 3 CallNurse, 4 OfferPainkiller,
      5 OfferSleepingPill
    rules: 1 offer_medication, 2 offer_painkiller, 3 offer_sleeping_pill *)
Module medication_round.

Definition rules : list nested_rule :=
  [ NestedRule 1 1 (Truth true)
     (Chain [Do 1]
      [ ((Atom (Holds 1)), (Chain [Do 2] []));
        ((Atom (Holds 2)), (Chain [Do 3] [])) ]);
    NestedRule 2 2 (Truth true)
     (Chain [Do 4]
      [ ((Atom (Holds 1)), (Chain [Do 2] []));
        ((And (Atom (Holds 1)) (Atom (Holds 2))), (Chain [Do 3] [])) ]);
    NestedRule 3 3 (Truth true)
     (Chain [Do 5]
      [ ((Or (Atom (Holds 1)) (Atom (Holds 2))), (Chain [Do 2] []));
        ((Atom (Holds 2)), (Chain [Do 3] [])) ]) ].

Definition constraints : list constraint := [].

Definition steps : list step :=
  [ Add 3 [] [1] ].

End medication_round.

Theorem medication_round_conflict_free :
  never_conflicts Cascade medication_round.rules medication_round.constraints.
Proof. apply (certified_never_conflicts _ _ _ medication_round.steps). vm_compute. reflexivity. Qed.
