(** What the theorems about rulesets rest on; [make -C proofs check] reads the answers.

    Written by `make theorems`; do not edit. *)

From Rulesets Require
  As_evaluated Care_robot Hospital_ward Hospital Household Medication_round.

Print Assumptions As_evaluated.as_evaluated_hospital_conflict_free.
Print Assumptions As_evaluated.as_evaluated_household_conflict_free.
Print Assumptions Care_robot.care_robot_hospital_conflict_free.
Print Assumptions Care_robot.care_robot_household_conflict_free.
Print Assumptions Hospital_ward.hospital_ward_conflict_free.
Print Assumptions Hospital.hospital_conflict_free.
Print Assumptions Household.household_conflict_free.
Print Assumptions Medication_round.medication_round_conflict_free.
