(** Unit propagation decides Definition 1 (issue 5, theorem 5, first half).

    Responses are conjunctions of literals and the context is total; so one
    propagation over Equation 1 gives every literal that is entailed, or ends in a
    contradiction where everything is. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings Clauses Cnf.
Import ListNotations.

(** χ and {¬ι | ι ∉ χ}, of the facts that the rules mention. *)
Definition units (chi : context) (G : ruleset) : cnf :=
  map (fun f => [(chi f, fact_number f)]) (facts_of G).

Definition propagation_clauses (r : reading) (G : ruleset) (chi : context) : cnf :=
  units chi G ++ equation_clauses r G.

Lemma units_true chi G a :
  cnf_true a (units chi G) = true <-> forall f, In f (facts_of G) -> facts_in a f = chi f.
Proof.
  unfold units. rewrite cnf_true_spec. split.
  - intros H f I. assert (C : clause_true a [(chi f, fact_number f)] = true).
    { apply H, in_map_iff. exists f. auto. }
    unfold clause_true in C. cbn [existsb] in C. rewrite lit_true_pair, orb_false_r in C.
    apply eqb_prop in C. symmetry. exact C.
  - intros H c C. apply in_map_iff in C. destruct C as [f [<- I]].
    unfold clause_true. cbn [existsb]. rewrite lit_true_pair, orb_false_r.
    rewrite <- (H f I). apply eqb_reflx.
Qed.

(** What is due is derived. *)
Lemma due_derived r G chi l :
  In l (due r G chi) -> derives (propagation_clauses r G chi) (lit_of l).
Proof.
  intro D. set (f := propagation_clauses r G chi).
  destruct (assignment_exists r G (interpretation chi (fun _ => false))) as [a [A T]].
  assert (X : forall x, facts_in a x = chi x) by (intro x; apply (A (Fact x))).
  assert (DA : In l (due r G (facts_in a))).
  { rewrite (due_ext r _ chi) by exact X. exact D. }
  unfold f, propagation_clauses, equation_clauses.
  pose proof (guarded_due r G start a l start_sound T) as GD.
  pose proof (build_rules_gives r G start) as P.
  unfold guarded in *. destruct (build_rules r G start) as [gs s]. cbn [fst snd] in *.
  destruct (P start_sound) as [_ [_ [_ K]]].
  apply GD in DA. destruct DA as [O [g [I [TG L]]]].
  set (h := units chi G ++ implications (combine (all_clauses G) gs) ++ built s).
  assert (DG : derives h g).
  { specialize (K h a). assert (KG : known h a g).
    { apply K.
      - intros c C. unfold h. rewrite !in_app_iff. auto.
      - exact T.
      - intros x N. apply in_map_iff in N. destruct N as [y [<- N]].
        unfold known. rewrite lit_true_pair. change (a (fact_number y)) with (facts_in a y).
        rewrite X. apply derives_unit. unfold h. apply in_app_iff. left.
        apply in_map_iff. exists y. split; [|exact N].
        destruct (chi y); reflexivity.
      - apply in_combine_r in I. exact I. }
    unfold known in KG. rewrite TG in KG. exact KG. }
  apply (unit_clause h [negate g; lit_of l]).
  - unfold h. rewrite !in_app_iff. right. left. unfold implications.
    apply in_flat_map. exists (O, g). split; [exact I|]. apply in_map_iff. exists l. auto.
  - right. left. reflexivity.
  - intros m [<-|[<-|[]]] N; [|destruct (N eq_refl)].
    rewrite negate_involutive. exact DG.
Qed.

(** Every model of Equation 1 in the context is one of the clauses. *)
Lemma propagation_model r G chi v :
  agrees chi v -> models r G v ->
  exists a, (forall x, atoms_in a x = v x) /\
            cnf_true a (propagation_clauses r G chi) = true.
Proof.
  intros A M. apply equation_clauses_conservative in M. destruct M as [a [E T]].
  exists a. split; [exact E|]. unfold propagation_clauses.
  rewrite cnf_true_app, T, andb_true_r. apply units_true.
  intros f _. unfold facts_in. specialize (E (Fact f)). unfold atoms_in in E. rewrite E. apply A.
Qed.

Theorem unit_propagation_complete r G chi l :
  entails_literal r G chi l <->
  derives (propagation_clauses r G chi) (lit_of l) \/ refutes (propagation_clauses r G chi).
Proof.
  split.
  - intro E. destruct (contradictory (due r G chi)) eqn:C.
    + right. apply contradictory_spec in C. destruct C as [m [I J]].
      exists (lit_of m). rewrite <- lit_of_opposite. split; apply due_derived; assumption.
    + left. apply due_derived, entailed_iff_due; assumption.
  - intros D v A M. destruct (propagation_model r G chi v A M) as [a [E T]].
    destruct D as [D|D].
    + apply (derives_sound _ _ _ D) in T. rewrite lit_of_true in T. rewrite <- T.
      apply eval_ext. intro x. symmetry. apply E.
    + rewrite (refutes_sound _ D) in T. discriminate.
Qed.

(** It ends in a contradiction exactly where the rules contradict each other. *)
Theorem refutes_iff_inconsistent r G chi :
  refutes (propagation_clauses r G chi) <-> contradictory (due r G chi) = true.
Proof.
  split.
  - intro D. destruct (contradictory (due r G chi)) eqn:C; [reflexivity|]. exfalso.
    assert (M : models r G (least_model chi (due r G chi))).
    { apply (models_iff_due r G chi); [apply interpretation_agrees|].
      intros m I. apply least_model_true; assumption. }
    destruct (propagation_model r G chi _ (interpretation_agrees _ _) M) as [a [_ T]].
    rewrite (refutes_sound _ D) in T. discriminate.
  - intro C. apply contradictory_spec in C. destruct C as [m [I J]].
    exists (lit_of m). rewrite <- lit_of_opposite. split; apply due_derived; assumption.
Qed.

(** Where they do not, what is derived of the obligations is what is due. *)
Corollary derived_iff_due r G chi l :
  consistent r G chi ->
  derives (propagation_clauses r G chi) (lit_of l) <-> In l (due r G chi).
Proof.
  intro C. rewrite <- (entailed_iff_due r G chi l C), unit_propagation_complete.
  rewrite refutes_iff_inconsistent. unfold consistent in C. rewrite C. intuition discriminate.
Qed.

(** Definition 1 decided by one propagation, computed. *)
Definition entails_by_unit_propagation (r : reading) (G : ruleset) (chi : context) (l : literal)
  : bool :=
  let known := propagate (propagation_clauses r G chi) in
  mem (lit_of l) known || contradicts known.

Theorem entails_by_unit_propagation_correct r G chi l :
  entails_by_unit_propagation r G chi l = true <-> entails_literal r G chi l.
Proof.
  unfold entails_by_unit_propagation. cbv zeta.
  rewrite orb_true_iff, mem_In, propagate_correct, contradicts_correct.
  symmetry. apply unit_propagation_complete.
Qed.
