(** What the oracle's theorems rest on; [make -C proofs check] reads the answers. *)

From Oracle Require Certified Findings.

Print Assumptions Certified.flat_conflict_free.
Print Assumptions Certified.default_as_hedge.
Print Assumptions Certified.certified_never_conflicts.
Print Assumptions Certified.certified_reads_alike.
Print Assumptions Findings.deciding_due.
Print Assumptions Findings.clause_guard_spec.
Print Assumptions Findings.certified_findings.
Print Assumptions Findings.certified_dead_rule.
Print Assumptions Findings.certified_dead_hedge.
Print Assumptions Findings.certified_redundant_rule.
Print Assumptions Findings.certified_redundant_hedge.
Print Assumptions Findings.certified_vacuous_conflict.
Print Assumptions Findings.certified_no_situation.
Print Assumptions Findings.ask_sound.
