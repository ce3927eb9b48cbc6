(** What the oracle's theorems rest on; [make -C proofs check] reads the answers. *)

From Oracle Require Certified.

Print Assumptions Certified.flat_conflict_free.
Print Assumptions Certified.default_as_hedge.
Print Assumptions Certified.certified_never_conflicts.
Print Assumptions Certified.certified_reads_alike.
Print Assumptions Certified.ask_sound.
