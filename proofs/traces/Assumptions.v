(** What the theorems about traces rest on; [make -C proofs check] reads the answers. *)

From Traces Require Trace.

Print Assumptions Trace.broken_nothing.
