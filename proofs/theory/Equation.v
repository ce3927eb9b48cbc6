(** Guards and Equation 1 ([sleec_verify/encoding/equation.py]; paper, Section 3.2).

    This is the quadratic form, as the paper prints it.  The linear one is in
    [Linear.v]. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation.
Import ListNotations.

(** * Guards *)

(** The guard of clause [i] of a chain with conditions [cs], as a list of
    conjuncts; [c0] is the trigger.
    Cascade: C0 ∧ C1 ∧ … ∧ Ci ∧ ¬C(i+1), without the last part for the last clause.
    Priority: C0 ∧ Ci ∧ ¬C(i+1) ∧ … ∧ ¬Cn, without Ci for i = 0. *)
Definition conjuncts {A} (r : reading) (c0 : formula A) (cs : list (formula A)) (i : nat)
  : list (formula A) :=
  match r with
  | Cascade => c0 :: firstn i cs ++ map Not (firstn 1 (skipn i cs))
  | Priority => c0 :: firstn 1 (skipn (i - 1) (firstn i cs)) ++ map Not (skipn i cs)
  end.

Definition c0 (R : rule) : formula fact :=
  And (Atom (Occurs (trigger R))) (rule_guard R).

Definition conditions (R : rule) : list (formula fact) :=
  map hedge_condition (hedges R).

Definition guard (r : reading) (R : rule) (i : nat) : formula fact :=
  conj (conjuncts r (c0 R) (conditions R) i).

Definition clause_numbers (R : rule) : list nat := seq 0 (S (length (hedges R))).
Arguments clause_numbers R : simpl never.

(** * Equation 1 *)

Definition obliged (R : rule) (i : nat) : formula atom :=
  conj (map formula_of (clause R i)).

Definition implication (r : reading) (R : rule) (i : nat) : formula atom :=
  implies (rename Fact (guard r R i)) (obliged R i).

Definition equation (r : reading) (R : rule) : formula atom :=
  conj (map (implication r R) (clause_numbers R)).

(** * A guard is true exactly where its clause decides *)

Lemma forallb_app {A} (f : A -> bool) l m : forallb f (l ++ m) = forallb f l && forallb f m.
Proof. induction l; simpl; [reflexivity|]. rewrite IHl. apply andb_assoc. Qed.

Lemma cascade_guard bs i :
  i <= length bs ->
  forallb id (firstn i bs) && forallb negb (firstn 1 (skipn i bs)) = (longest_prefix bs =? i).
Proof.
  revert i. induction bs as [|b bs IH]; intros [|i] H; simpl in *; try reflexivity; try lia.
  - destruct b; reflexivity.
  - destruct b; simpl; [|reflexivity]. rewrite IH by lia. reflexivity.
Qed.

Lemma last_true_zero bs : forallb negb bs = (last_true bs =? 0).
Proof.
  induction bs as [|b bs IH]; simpl; [reflexivity|].
  rewrite IH. destruct (last_true bs), b; reflexivity.
Qed.

Lemma priority_guard bs i :
  i <= length bs ->
  forallb id (firstn 1 (skipn (i - 1) (firstn i bs))) && forallb negb (skipn i bs)
  = (last_true bs =? i).
Proof.
  revert i. induction bs as [|b bs IH]; intros [|i] H; try (exfalso; simpl in H; lia).
  - reflexivity.
  - change (forallb negb (b :: bs) = (last_true (b :: bs) =? 0)). apply last_true_zero.
  - change (last_true (b :: bs)) with
      (match last_true bs with 0 => if b then 1 else 0 | S k => S (S k) end).
    simpl in H. destruct i as [|i].
    + change ((b && true) && forallb negb bs
              = (match last_true bs with 0 => if b then 1 else 0 | S k => S (S k) end =? 1)).
      rewrite last_true_zero. destruct (last_true bs), b; reflexivity.
    + replace (skipn (S (S i) - 1) (firstn (S (S i)) (b :: bs)))
        with (skipn (S i - 1) (firstn (S i) bs)) by (simpl; rewrite Nat.sub_0_r; reflexivity).
      change (skipn (S (S i)) (b :: bs)) with (skipn (S i) bs).
      rewrite IH by lia. destruct (last_true bs), b; reflexivity.
Qed.

Lemma forallb_map {A B} (f : B -> bool) (g : A -> B) l :
  forallb f (map g l) = forallb (fun a => f (g a)) l.
Proof. induction l; simpl; congruence. Qed.

Lemma existsb_map {A B} (f : B -> bool) (g : A -> B) l :
  existsb f (map g l) = existsb (fun a => f (g a)) l.
Proof. induction l; simpl; congruence. Qed.

Lemma firstn_succ {A} i (l : list A) : firstn (S i) l = firstn i l ++ firstn 1 (skipn i l).
Proof.
  revert l. induction i as [|i IH]; intros [|a l]; try reflexivity.
  change (a :: firstn (S i) l = a :: (firstn i l ++ firstn 1 (skipn i l))). rewrite IH. reflexivity.
Qed.

(** The same for any chain, whatever its atoms are. *)
Lemma conjuncts_decide {A} (v : A -> bool) r c cs i :
  i <= length cs ->
  eval v (conj (conjuncts r c cs i)) = eval v c && (decides r (map (eval v) cs) =? i).
Proof.
  intro H. rewrite eval_conj.
  assert (N : forall l, forallb (eval v) (map Not l) = forallb negb (map (eval v) l)).
  { intro l. rewrite !forallb_map. reflexivity. }
  assert (I : forall l, forallb (eval v) l = forallb id (map (eval v) l)).
  { intro l. rewrite forallb_map. reflexivity. }
  destruct r; cbn [conjuncts forallb decides]; f_equal; rewrite forallb_app, N, I.
  - rewrite <- !firstn_map, <- !skipn_map.
    apply cascade_guard. rewrite map_length. exact H.
  - rewrite <- !firstn_map, <- !skipn_map, <- firstn_map.
    apply priority_guard. rewrite map_length. exact H.
Qed.

Lemma eval_c0 chi R : eval chi (c0 R) = triggered chi R.
Proof. reflexivity. Qed.

Lemma eval_conditions chi R : map (eval chi) (conditions R) = truths chi R.
Proof. unfold conditions, truths. apply map_map. Qed.

(** Equation 1 and Algorithm 1 choose the same clause. *)
Theorem guard_iff_active r chi R i :
  i <= length (hedges R) ->
  eval chi (guard r R i) = triggered chi R && (active r chi R =? i).
Proof.
  intro H. unfold guard. rewrite conjuncts_decide.
  - rewrite eval_c0, eval_conditions. reflexivity.
  - unfold conditions. rewrite map_length. exact H.
Qed.

Lemma guard_true r chi R i :
  i <= length (hedges R) ->
  eval chi (guard r R i) = true <-> triggered chi R = true /\ active r chi R = i.
Proof.
  intro H. rewrite guard_iff_active by assumption.
  rewrite andb_true_iff, Nat.eqb_eq. reflexivity.
Qed.

(** * Issue 5, theorem 3, first half *)

Theorem guards_mutually_exclusive r chi R i j :
  i <= length (hedges R) -> j <= length (hedges R) ->
  eval chi (guard r R i) = true -> eval chi (guard r R j) = true -> i = j.
Proof.
  intros I J A B. apply guard_true in A; auto. apply guard_true in B; auto.
  destruct A, B. congruence.
Qed.

Theorem guards_exhaustive r chi R :
  triggered chi R = true ->
  exists i, i <= length (hedges R) /\ eval chi (guard r R i) = true.
Proof.
  intro T. exists (active r chi R). split.
  - apply active_bound.
  - apply guard_true; auto using active_bound.
Qed.

(** A guard is true only where the rule is triggered. *)
Theorem guards_need_the_trigger r chi R i :
  i <= length (hedges R) -> eval chi (guard r R i) = true -> triggered chi R = true.
Proof. intros H G. apply guard_true in G; tauto. Qed.

(** * What Equation 1 says *)

Lemma in_clause_numbers R i : In i (clause_numbers R) <-> i <= length (hedges R).
Proof. unfold clause_numbers. rewrite in_seq. lia. Qed.

Lemma eval_obliged v R i :
  eval v (obliged R i) = true <-> forall l, In l (clause R i) -> true_in v l = true.
Proof. unfold obliged. rewrite eval_conj, forallb_map, forallb_forall. reflexivity. Qed.

(** The part of an interpretation that is a context. *)
Definition context_in (v : atom -> bool) : context := fun f => v (Fact f).

Theorem equation_spec r R v :
  eval v (equation r R) = true <->
  forall l, In l (due_of r (context_in v) R) -> true_in v l = true.
Proof.
  set (chi := context_in v).
  unfold equation, due_of. rewrite eval_conj, forallb_map, forallb_forall.
  split.
  - intros H l I. destruct (triggered chi R) eqn:T; [|destruct I].
    specialize (H (active r chi R)).
    rewrite in_clause_numbers in H. specialize (H (active_bound _ _ _)).
    unfold implication in H. rewrite eval_implies, eval_rename, eval_obliged in H.
    apply H; auto. apply guard_true; auto using active_bound.
  - intros H i I. apply in_clause_numbers in I.
    unfold implication. rewrite eval_implies, eval_rename, eval_obliged.
    change (fun a => v (Fact a)) with chi.
    intros G l L. apply guard_true in G; [|assumption]. destruct G as [T A]. apply H. rewrite T, A. exact L.
Qed.
