(** What the theorems about traces rest on; [make -C proofs check] reads the answers. *)

From Traces Require Trace Continuation RelationsSoFar Dominance Situation UntimedConflict.

Print Assumptions Trace.broken_nothing.
Print Assumptions Continuation.demand_open_spec.
Print Assumptions RelationsSoFar.law_open_exact.
Print Assumptions RelationsSoFar.broken_so_far_exact.
Print Assumptions Dominance.earliest_deadline.
Print Assumptions Dominance.latest_prohibition.
Print Assumptions Dominance.one_slot_exact.
Print Assumptions Dominance.slots_exact.
Print Assumptions Dominance.flags_suffice.
Print Assumptions Situation.can_comply_fewer.
Print Assumptions UntimedConflict.minimal_conflict_decides.
Print Assumptions UntimedConflict.conflict_in_situation.
Print Assumptions UntimedConflict.untimed_conflicts.
Print Assumptions UntimedConflict.other_triggers.
