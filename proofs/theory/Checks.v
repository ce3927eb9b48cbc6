(** The other checks ([sleec_verify/checks/]): each is a question over all contexts,
    and its clauses are unsatisfiable exactly if the property holds. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings Clauses Clashes Conflict Question.
Import ListNotations.

(** * Dead rules and hedges *)

Theorem dead_rule_check Ks R :
  unsatisfiable (question_clauses Ks (c0 R)) <->
  forall chi, possible Ks chi = true -> triggered chi R = false.
Proof.
  rewrite question_answered_no. split; intros H chi P; specialize (H chi P);
    rewrite eval_c0 in *; exact H.
Qed.

Theorem dead_hedge_check r Ks R i :
  i <= length (hedges R) ->
  unsatisfiable (question_clauses Ks (guard r R i)) <->
  forall chi, possible Ks chi = true -> triggered chi R = true -> active r chi R <> i.
Proof.
  intro I. rewrite question_answered_no. split.
  - intros H chi P T A. specialize (H chi P). apply not_true_iff_false in H. apply H.
    apply guard_true; auto.
  - intros H chi P. apply not_true_is_false. intro G. apply guard_true in G; [|exact I].
    exact (H chi P (proj1 G) (proj2 G)).
Qed.

(** * Rulesets that oblige the same *)

Definition different (f g : formula fact) : formula fact := Or (And f (Not g)) (And (Not f) g).

(** Some literal is due by the one and not by the other. *)
Definition difference (r : reading) (G : ruleset) (s : reading) (H : ruleset) : formula fact :=
  disj (map (fun l => different (due_formula r G l) (due_formula s H l))
            (nodup literal_eq_dec (obliged_literals G ++ obliged_literals H))).

Lemma difference_spec r G s H chi :
  eval chi (difference r G s H) = false <-> same_literals (due r G chi) (due s H chi).
Proof.
  unfold difference. rewrite eval_disj, existsb_map, <- not_true_iff_false, existsb_exists.
  assert (D : forall l, eval chi (different (due_formula r G l) (due_formula s H l)) = true <->
              ~ (In l (due r G chi) <-> In l (due s H chi))).
  { intro l. unfold different. cbn [eval]. rewrite !due_formula_spec, <- !listed_In.
    destruct (listed l (due r G chi)), (listed l (due s H chi)); simpl; intuition discriminate. }
  split.
  - intros N l.
    assert (X : In l (nodup literal_eq_dec (obliged_literals G ++ obliged_literals H)) ->
                (In l (due r G chi) <-> In l (due s H chi))).
    { intro I. destruct (listed l (due r G chi)) eqn:A, (listed l (due s H chi)) eqn:B;
        try (apply listed_In in A); try (apply listed_In in B); try tauto;
        try (exfalso; apply N; exists l; split; [exact I|]; apply D;
             rewrite <- !listed_In in *; rewrite ?A, ?B; intuition congruence).
      rewrite <- !listed_In, A, B. reflexivity. }
    split; intro I; apply X; try exact I; apply nodup_In, in_app_iff.
    + left. exact (due_obliged _ _ _ _ I).
    + right. exact (due_obliged _ _ _ _ I).
  - intros S [l [_ T]]. apply D in T. exact (T (S l)).
Qed.

(** For redundant rules and hedges, the reading of a rule, and the comparison of two
    rulesets: the one with and without, or read one way and the other. *)
Theorem same_due_check r G s H Ks :
  unsatisfiable (question_clauses Ks (difference r G s H)) <->
  forall chi, possible Ks chi = true -> same_literals (due r G chi) (due s H chi).
Proof.
  rewrite question_answered_no. split; intros X chi P; specialize (X chi P);
    apply difference_spec; exact X.
Qed.

(** Then they entail the same, in every context that can be. *)
Theorem same_due_entails r G s H Ks chi phi :
  unsatisfiable (question_clauses Ks (difference r G s H)) -> possible Ks chi = true ->
  entails r G chi phi <-> entails s H chi phi.
Proof. intros U P. apply entails_from_due, (proj1 (same_due_check r G s H Ks) U chi P). Qed.

(** Without assumptions, the reading check of one rule is [Readings.readings_agree]. *)
Theorem reading_check R :
  unsatisfiable (question_clauses [] (difference Cascade [R] Priority [R])) <-> readings_agree R.
Proof.
  rewrite same_due_check. unfold readings_agree, due. cbn [flat_map]. setoid_rewrite app_nil_r.
  split; [intros H chi; apply H; reflexivity|auto].
Qed.

(** * Rules that can be triggered in conflicts only *)

Theorem vacuous_conflict_check r G Ks R :
  unsatisfiable (question_clauses Ks
    (And (c0 R) (Not (disj (map (clash_formula r G) (all_clashes G Ks)))))) <->
  forall chi, possible Ks chi = true -> triggered chi R = true -> conflicts r G Ks chi.
Proof.
  assert (V : forall chi, eval chi (disj (map (clash_formula r G) (all_clashes G Ks)))
                          = clash_here r G Ks chi).
  { intro chi. rewrite eval_disj, existsb_map. unfold clash_here, one_here.
    induction (all_clashes G Ks) as [|c cs IH]; [reflexivity|]. cbn [existsb].
    rewrite IH, clash_formula_value. reflexivity. }
  rewrite question_answered_no. split.
  - intros H chi P T. apply conflicts_iff. specialize (H chi P). cbn [eval] in H.
    rewrite eval_c0, T, V in H. simpl in H. apply negb_false_iff in H. exact H.
  - intros H chi P. cbn [eval]. rewrite eval_c0, V.
    destruct (triggered chi R) eqn:T; [|reflexivity].
    rewrite (proj1 (conflicts_iff r G Ks chi) (H chi P T)). reflexivity.
Qed.
