(** The two readings of a chain of hedges ([docs/semantics.md]): where they differ,
    and how each is written in the other (issue 5, theorem 4). *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment.
Import ListNotations.

(** * Where they choose different clauses *)

(** If the last true condition is not in the true prefix, one between is false. *)
Lemma prefix_or_gap bs :
  longest_prefix bs = last_true bs \/ S (longest_prefix bs) < last_true bs.
Proof.
  induction bs as [|[|] bs IH]; simpl; auto.
  - destruct (last_true bs); lia.
  - destruct (last_true bs); lia.
Qed.

(** They differ exactly where some condition is true after a false one. *)
Theorem readings_differ_iff bs :
  decides Cascade bs <> decides Priority bs <->
  exists i j, i < j /\ nth_error bs i = Some false /\ nth_error bs j = Some true.
Proof.
  simpl. induction bs as [|b bs IH].
  - split; [simpl; congruence|]. intros [[|i] [j [_ [H _]]]]; discriminate.
  - split.
    + intro D. destruct b.
      * destruct (proj1 IH) as [i [j [L [I J]]]].
        { intro E. apply D. simpl. rewrite E. destruct (last_true bs); reflexivity. }
        exists (S i), (S j). simpl. auto with arith.
      * assert (T : last_true bs <> 0) by (intro E; apply D; simpl; rewrite E; reflexivity).
        exists 0. clear D IH. assert (exists j, nth_error bs j = Some true) as [j J].
        { induction bs as [|c bs IH]; simpl in T; [congruence|]. destruct c; [exists 0; reflexivity|].
          destruct IH as [j J]; [intro E; rewrite E in T; congruence|]. exists (S j). exact J. }
        exists (S j). simpl. auto with arith.
    + intros [i [j [L [I J]]]] E. destruct j as [|j]; [lia|]. simpl in J, E.
      assert (T : last_true bs <> 0).
      { clear - J. revert j J. induction bs as [|c bs IH]; intros [|j] J; simpl in *; try discriminate.
        - injection J as ->. destruct (last_true bs); discriminate.
        - specialize (IH j J). destruct (last_true bs); congruence. }
      destruct b; [|destruct (last_true bs); congruence].
      destruct i as [|i]; [discriminate|]. simpl in I.
      apply (proj2 IH); [exists i, j; auto with arith|].
      destruct (last_true bs); congruence.
Qed.

(** The three points of the paper's own rules: C1 false, C2 true. *)
Example deciding_point :
  decides Cascade [false; true] = 0 /\ decides Priority [false; true] = 2.
Proof. split; reflexivity. Qed.

(** * From priority to cascade: Ci ∨ C(i+1) ∨ … ∨ Cn for Ci *)

Fixpoint suffixes_true (bs : list bool) : list bool :=
  match bs with
  | [] => []
  | b :: rest => existsb id bs :: suffixes_true rest
  end.

Lemma suffixes_true_length bs : length (suffixes_true bs) = length bs.
Proof. induction bs as [|b bs IH]; cbn [suffixes_true length]; congruence. Qed.

Lemma last_true_existsb bs : existsb id bs = negb (last_true bs =? 0).
Proof.
  induction bs as [|b bs IH]; simpl; [reflexivity|]. rewrite IH.
  destruct (last_true bs), b; reflexivity.
Qed.

Lemma cascade_of_suffixes bs : longest_prefix (suffixes_true bs) = last_true bs.
Proof.
  induction bs as [|b bs IH]; [reflexivity|].
  cbn [suffixes_true longest_prefix]. rewrite last_true_existsb, IH. simpl.
  destruct (last_true bs), b; reflexivity.
Qed.

Fixpoint with_suffixes (hs : list hedge) : list hedge :=
  match hs with
  | [] => []
  | h :: rest =>
      Hedge (disj (map hedge_condition hs)) (hedge_obliges h) :: with_suffixes rest
  end.

Definition to_cascade (R : rule) : rule :=
  Rule (label R) (trigger R) (rule_guard R) (default R) (with_suffixes (hedges R)).

Lemma to_cascade_clauses R : clauses (to_cascade R) = clauses R.
Proof.
  unfold clauses. simpl. f_equal.
  induction (hedges R); simpl; congruence.
Qed.

Lemma to_cascade_truths chi R : truths chi (to_cascade R) = suffixes_true (truths chi R).
Proof.
  unfold truths. simpl. induction (hedges R) as [|h hs IH]; [reflexivity|].
  cbn [with_suffixes map suffixes_true]. rewrite IH. f_equal.
  unfold satisfies at 1. cbn [hedge_condition]. rewrite eval_disj.
  change (existsb (satisfies chi) (map hedge_condition (h :: hs))
          = existsb id (map (fun h => satisfies chi (hedge_condition h)) (h :: hs))).
  rewrite !existsb_map. reflexivity.
Qed.

Theorem to_cascade_preserves chi R :
  due_of Cascade chi (to_cascade R) = due_of Priority chi R.
Proof.
  unfold due_of, active, clause. rewrite to_cascade_clauses, to_cascade_truths.
  cbn [decides]. rewrite cascade_of_suffixes. reflexivity.
Qed.

(** * From cascade to priority: C1 ∧ … ∧ Ci for Ci *)

Fixpoint prefixes_true (past : bool) (bs : list bool) : list bool :=
  match bs with
  | [] => []
  | b :: rest => (past && b) :: prefixes_true (past && b) rest
  end.

Lemma last_of_nothing bs : last_true (prefixes_true false bs) = 0.
Proof. induction bs as [|b bs IH]; simpl; [reflexivity|]. rewrite IH. reflexivity. Qed.

Lemma priority_of_prefixes bs : last_true (prefixes_true true bs) = longest_prefix bs.
Proof.
  induction bs as [|[|] bs IH]; simpl; [reflexivity| |].
  - rewrite IH. destruct (longest_prefix bs); reflexivity.
  - rewrite last_of_nothing. reflexivity.
Qed.

Fixpoint with_prefixes (past : list condition) (hs : list hedge) : list hedge :=
  match hs with
  | [] => []
  | h :: rest =>
      let upto := past ++ [hedge_condition h] in
      Hedge (conj upto) (hedge_obliges h) :: with_prefixes upto rest
  end.

Definition to_priority (R : rule) : rule :=
  Rule (label R) (trigger R) (rule_guard R) (default R) (with_prefixes [] (hedges R)).

Lemma to_priority_clauses R : clauses (to_priority R) = clauses R.
Proof.
  unfold clauses. simpl. f_equal. generalize (@nil condition).
  induction (hedges R) as [|h hs IH]; intro past; simpl; [reflexivity|].
  rewrite IH. reflexivity.
Qed.

Lemma with_prefixes_truths chi hs past :
  map (fun h => satisfies chi (hedge_condition h)) (with_prefixes past hs)
  = prefixes_true (forallb (satisfies chi) past)
                  (map (fun h => satisfies chi (hedge_condition h)) hs).
Proof.
  revert past. induction hs as [|h hs IH]; intro past; [reflexivity|].
  cbn [with_prefixes map prefixes_true]. rewrite IH.
  assert (E : forallb (satisfies chi) (past ++ [hedge_condition h])
              = forallb (satisfies chi) past && satisfies chi (hedge_condition h)).
  { rewrite forallb_app. simpl. rewrite andb_true_r. reflexivity. }
  rewrite E. f_equal. unfold satisfies at 1. cbn [hedge_condition].
  rewrite eval_conj. exact E.
Qed.

Lemma to_priority_truths chi R :
  truths chi (to_priority R) = prefixes_true true (truths chi R).
Proof. apply (with_prefixes_truths chi (hedges R) []). Qed.

Theorem to_priority_preserves chi R :
  due_of Priority chi (to_priority R) = due_of Cascade chi R.
Proof.
  unfold due_of, active, clause. rewrite to_priority_clauses, to_priority_truths.
  cbn [decides]. rewrite priority_of_prefixes. reflexivity.
Qed.

(** * Both preserve Definition 1, with every ruleset, in every context *)

Lemma entails_from_due r s G H chi phi :
  (forall l, In l (due r G chi) <-> In l (due s H chi)) ->
  entails r G chi phi <-> entails s H chi phi.
Proof.
  intro E. split; intros N v A M; apply (N v A);
    apply (models_iff_due _ _ chi v A); intros l I;
    apply (proj1 (models_iff_due _ _ chi v A) M), E, I.
Qed.

Lemma due_map r s f G chi :
  (forall R, due_of r chi (f R) = due_of s chi R) ->
  due r (map f G) chi = due s G chi.
Proof. intro H. unfold due. induction G; simpl; congruence. Qed.

Theorem to_cascade_entails G chi phi :
  entails Cascade (map to_cascade G) chi phi <-> entails Priority G chi phi.
Proof.
  apply entails_from_due. intro l.
  rewrite (due_map Cascade Priority) by (intro; apply to_cascade_preserves). reflexivity.
Qed.

Theorem to_priority_entails G chi phi :
  entails Priority (map to_priority G) chi phi <-> entails Cascade G chi phi.
Proof.
  apply entails_from_due. intro l.
  rewrite (due_map Priority Cascade) by (intro; apply to_priority_preserves). reflexivity.
Qed.

(** * When the readings agree on a rule *)

Definition same_literals (ls ms : list literal) : Prop := forall l, In l ls <-> In l ms.

Definition same_literalsb (ls ms : list literal) : bool :=
  forallb (fun l => listed l ms) ls && forallb (fun l => listed l ls) ms.

Lemma same_literalsb_spec ls ms : same_literalsb ls ms = true <-> same_literals ls ms.
Proof.
  unfold same_literalsb, same_literals. rewrite andb_true_iff, !forallb_forall. split.
  - intros [A B] l. rewrite <- !listed_In. split; intro I; apply listed_In in I.
    + apply A, I.
    + apply B, I.
  - intro H. split; intros l I; apply listed_In, H, I.
Qed.

(** In no context does it matter how the rule is read. *)
Definition readings_agree (R : rule) : Prop :=
  forall chi, same_literals (due_of Cascade chi R) (due_of Priority chi R).

(** C0 ∧ C1 ∧ … ∧ Ck ∧ ¬C(k+1), and Cj ∧ ¬C(j+1) ∧ … ∧ ¬Cn: where the cascade
    stops at clause k and clause j is the last true one. *)
Definition differ (R : rule) (k j : nat) : formula fact :=
  And (guard Cascade R k) (guard Priority R j).

Lemma agree_here chi R :
  (forall k j, S k < j -> j <= length (hedges R) ->
     same_literals (clause R k) (clause R j) \/ eval chi (differ R k j) = false) ->
  same_literals (due_of Cascade chi R) (due_of Priority chi R).
Proof.
  intro H. unfold due_of. destruct (triggered chi R) eqn:T; [|intro; reflexivity].
  unfold active at 1 2. cbn [decides].
  destruct (prefix_or_gap (truths chi R)) as [E|L].
  - rewrite E. intro; reflexivity.
  - pose proof (active_bound Priority chi R) as B. unfold active in B. cbn [decides] in B.
    destruct (H _ _ L B) as [S|N]; [exact S|]. exfalso.
    apply not_true_iff_false in N. apply N.
    unfold differ. cbn [eval]. apply andb_true_iff.
    split; apply guard_true; auto; lia.
Qed.

(** C0, not all of C1, …, C(j-1), and Cj ∧ ¬C(j+1) ∧ … ∧ ¬Cn: where clause j is the last
    true one, and the cascade stops before it. *)
Definition apart (R : rule) (j : nat) : formula fact :=
  And (Not (conj (firstn (j - 1) (conditions R)))) (guard Priority R j).

Lemma apart_if_differ chi R k j :
  S k < j -> j <= length (hedges R) -> eval chi (differ R k j) = true -> eval chi (apart R j) = true.
Proof.
  intros L B D. unfold differ, apart in *. cbn [eval] in *. apply andb_true_iff in D.
  destruct D as [C P]. rewrite P, andb_true_r. apply negb_true_iff, not_true_is_false.
  rewrite eval_conj, forallb_forall. intro A.
  apply guard_true in C; [|lia]. destruct C as [_ C].
  assert (X : forall bs i, i < length bs -> longest_prefix bs = i ->
              ~ forallb id (firstn (S i) bs) = true).
  { clear. induction bs as [|[|] bs IH]; intros i I Q; simpl in *; [lia| |congruence].
    subst i. intro F. apply (IH (longest_prefix bs)); [lia|reflexivity|exact F]. }
  apply (X (truths chi R) k).
  - unfold truths. rewrite map_length. lia.
  - exact C.
  - rewrite <- eval_conditions, firstn_map, forallb_map, forallb_forall. intros c I.
    apply A. replace (S k) with (min (S k) (j - 1)) in I by lia.
    rewrite <- firstn_firstn in I.
    rewrite <- (firstn_skipn (S k) (firstn (j - 1) (conditions R))). apply in_app_iff. left. exact I.
Qed.

(** The readings agree exactly when, for every two clauses with a third between,
    they oblige the same or no context is as [differ] says. *)
Theorem readings_agree_iff R :
  readings_agree R <->
  forall k j, S k < j -> j <= length (hedges R) ->
    same_literals (clause R k) (clause R j) \/
    (forall chi, eval chi (differ R k j) = false).
Proof.
  split.
  - intros A k j L B. destruct (same_literalsb (clause R k) (clause R j)) eqn:S.
    + left. apply same_literalsb_spec. exact S.
    + right. intro chi. apply not_true_is_false. intro D.
      unfold differ in D. cbn [eval] in D. apply andb_true_iff in D. destruct D as [C P].
      apply guard_true in C; [|lia]. apply guard_true in P; [|lia].
      destruct C as [T C]. destruct P as [_ P].
      specialize (A chi). unfold due_of in A. rewrite T, C, P in A.
      apply same_literalsb_spec in A. congruence.
  - intros H chi. apply agree_here. intros k j L B. destruct (H k j L B); auto.
Qed.

(** Where they agree on every rule, they agree on what is entailed. *)
Theorem readings_agree_entails G chi phi :
  (forall R, In R G -> readings_agree R) ->
  entails Cascade G chi phi <-> entails Priority G chi phi.
Proof.
  intro A. apply entails_from_due. intro l. unfold due. rewrite !in_flat_map.
  split; intros [R [I H]]; exists R; split; auto; apply (A R I chi); exact H.
Qed.
