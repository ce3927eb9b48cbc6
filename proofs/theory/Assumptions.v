(** What every main theorem rests on.  [make check] reads what this prints, and fails
    unless each answer is "Closed under the global context": no axiom, nothing
    admitted. *)

From Sleec Require
  Evaluation Equation Entailment Instance Readings Nested Linear
  Clauses Cnf Propagation Constraints Clashes Conflict ConflictClauses
  Question Checks Proposition1 Cone Dispatch.

Print Assumptions Evaluation.algorithm_1_as_printed_with_hedges.
Print Assumptions Evaluation.algorithm_1_as_printed_without_hedges.

Print Assumptions Equation.guard_iff_active.
Print Assumptions Equation.guards_mutually_exclusive.
Print Assumptions Equation.guards_exhaustive.
Print Assumptions Equation.guards_need_the_trigger.
Print Assumptions Equation.equation_spec.

Print Assumptions Entailment.models_iff_due.
Print Assumptions Entailment.contradiction_entails_all.
Print Assumptions Entailment.entailed_iff_due.
Print Assumptions Entailment.entails_by_table_correct.
Print Assumptions Entailment.entails_by_propagation_correct.
Print Assumptions Entailment.procedures_agree.

Print Assumptions Instance.due_executed.
Print Assumptions Instance.executed_due.
Print Assumptions Instance.executed_iff_due.
Print Assumptions Instance.layers_exist.
Print Assumptions Instance.empty_hedge_suppresses.

Print Assumptions Readings.readings_differ_iff.
Print Assumptions Readings.to_cascade_preserves.
Print Assumptions Readings.to_priority_preserves.
Print Assumptions Readings.to_cascade_entails.
Print Assumptions Readings.to_priority_entails.
Print Assumptions Readings.readings_agree_iff.
Print Assumptions Readings.readings_agree_entails.

Print Assumptions Nested.flatten_due.
Print Assumptions Nested.flatten_models.
Print Assumptions Nested.flatten_entails.

Print Assumptions Linear.linear_conservative.
Print Assumptions Linear.linear_equisatisfiable.
Print Assumptions Linear.linear_entails.
Print Assumptions Linear.linear_size.
Print Assumptions Linear.equation_size.

Print Assumptions Clauses.renumber_unsatisfiable.
Print Assumptions Clauses.dense_unsatisfiable.
Print Assumptions Clauses.derives_sound.
Print Assumptions Clauses.refutes_sound.
Print Assumptions Clauses.propagate_correct.
Print Assumptions Clauses.contradicts_correct.

Print Assumptions Cnf.equation_clauses_conservative.

Print Assumptions Propagation.unit_propagation_complete.
Print Assumptions Propagation.refutes_iff_inconsistent.
Print Assumptions Propagation.derived_iff_due.
Print Assumptions Propagation.entails_by_unit_propagation_correct.

Print Assumptions Constraints.exclusive_meaning.
Print Assumptions Clashes.clashes_decide.

Print Assumptions Conflict.clash_here_spec.
Print Assumptions Conflict.conflicts_iff.
Print Assumptions Conflict.compatible_or_conflicts.
Print Assumptions Conflict.compatible_by_table_correct.
Print Assumptions Conflict.compatible_without_constraints.
Print Assumptions Conflict.compatible_consistent.
Print Assumptions Conflict.positive_rules_never_conflict.
Print Assumptions Conflict.conflict_formula_spec.
Print Assumptions Conflict.conflict_check.
Print Assumptions ConflictClauses.clash_clauses_spec.
Print Assumptions ConflictClauses.conflict_clauses_spec.
Print Assumptions ConflictClauses.conflict_free_iff_unsatisfiable.
Print Assumptions ConflictClauses.conflict_free_in_parts.

Print Assumptions Question.questions_spec.
Print Assumptions Question.questions_answered_no.
Print Assumptions Question.question_spec.
Print Assumptions Question.question_answered_no.

Print Assumptions Checks.dead_rule_check.
Print Assumptions Checks.dead_hedge_check.
Print Assumptions Checks.same_due_check.
Print Assumptions Checks.same_due_entails.
Print Assumptions Checks.reading_check.
Print Assumptions Checks.vacuous_conflict_check.

Print Assumptions Proposition1.proposition_1_as_printed_false.
Print Assumptions Proposition1.shared_epsilon_executes_too_much.
Print Assumptions Proposition1.as_printed_false_with_shared_epsilon.
Print Assumptions Proposition1.no_hedges_no_layer.
Print Assumptions Proposition1.as_printed_false_without_hedges.
Print Assumptions Proposition1.proposition_1.
Print Assumptions Proposition1.proposition_1_positive.
Print Assumptions Proposition1.entailed_then_executed.
Print Assumptions Proposition1.executed_then_entailed.
Print Assumptions Proposition1.proposition_1_exact.
Print Assumptions Proposition1.prohibitions_kept.
Print Assumptions Proposition1.labels_needed.
Print Assumptions Proposition1.consistency_needed.
Print Assumptions Proposition1.prohibitions_need_consistency.
Print Assumptions Proposition1.own_epsilon_needed.
Print Assumptions Proposition1.proposition_1_with_constraints.
Print Assumptions Proposition1.conflict_freeness_needed.
Print Assumptions Proposition1.constraints_oblige_nothing.

Print Assumptions Cone.cone_due.
Print Assumptions Cone.cone_sound.
Print Assumptions Cone.cone_preserves.
Print Assumptions Cone.cone_exact.
Print Assumptions Cone.cone_needs_consistency.
Print Assumptions Cone.cone_context.
Print Assumptions Cone.clash_cone.
Print Assumptions Cone.disjoint_satisfiable.
Print Assumptions Cone.assumptions_cut.
Print Assumptions Cone.clash_question_cut.

Print Assumptions Dispatch.snapshot_refines.
Print Assumptions Dispatch.snapshot_executes.
Print Assumptions Dispatch.trigger_dispatched.
Print Assumptions Dispatch.run_progresses.
Print Assumptions Dispatch.others_leave_it.
Print Assumptions Dispatch.two_step_opens_the_curtains.
Print Assumptions Dispatch.two_step_does_not_refine.
Print Assumptions Dispatch.two_rules_are_torn.
