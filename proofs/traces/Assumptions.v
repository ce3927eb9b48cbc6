(** What the theorems about traces rest on; [make -C proofs check] reads the answers. *)

From Traces Require Trace Continuation RelationsSoFar.

Print Assumptions Trace.broken_nothing.
Print Assumptions Continuation.demand_open_spec.
Print Assumptions RelationsSoFar.law_open_exact.
Print Assumptions RelationsSoFar.broken_so_far_exact.
