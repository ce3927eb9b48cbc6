(** Algorithm 1 in both readings ([sleec_runtime/evaluation/evaluation.py]).

    A rule is walked as it is written: no formula is compiled here.  That
    Equation 1 says the same is a theorem of [Equation.v]. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model.
Import ListNotations.

(** * One chain of hedges *)

(** The length of the longest true prefix. *)
Fixpoint longest_prefix (bs : list bool) : nat :=
  match bs with
  | true :: rest => S (longest_prefix rest)
  | _ => 0
  end.

(** The place, counted from 1, of the last true one; 0 if none is. *)
Fixpoint last_true (bs : list bool) : nat :=
  match bs with
  | [] => 0
  | b :: rest =>
      match last_true rest with
      | 0 => if b then 1 else 0
      | S k => S (S k)
      end
  end.

Definition decides (r : reading) (bs : list bool) : nat :=
  match r with
  | Cascade => longest_prefix bs
  | Priority => last_true bs
  end.

Lemma decides_bound r bs : decides r bs <= length bs.
Proof.
  destruct r; simpl; induction bs as [|b bs IH]; simpl; auto with arith.
  - destruct b; lia.
  - destruct (last_true bs); [destruct b|]; lia.
Qed.

(** * One rule *)

Definition truths (chi : context) (R : rule) : list bool :=
  map (fun h => satisfies chi (hedge_condition h)) (hedges R).

(** χ ⊨ C0, the trigger and the rule's guard. *)
Definition triggered (chi : context) (R : rule) : bool :=
  chi (Occurs (trigger R)) && satisfies chi (rule_guard R).

(** The number of the active clause, if the rule is triggered. *)
Definition active (r : reading) (chi : context) (R : rule) : nat :=
  decides r (truths chi R).

Lemma active_bound r chi R : active r chi R <= length (hedges R).
Proof.
  unfold active, truths.
  eapply Nat.le_trans; [apply decides_bound|]. rewrite map_length. auto.
Qed.

(** Algorithm 1 as printed: [i] is the loop's variable, [bs] the conditions that
    are still to be looked at.  [None] is ε, [Some i] is ℓ(R)i. *)
Fixpoint algorithm_1_from (i : nat) (bs : list bool) : option nat :=
  match bs with
  | true :: rest => algorithm_1_from (S i) rest
  | false :: _ => if i =? 1 then None else Some (i - 1)
  | [] => Some (i - 1)
  end.

Definition algorithm_1_as_printed (chi : context) (R : rule) : option nat :=
  algorithm_1_from 1 (truths chi R).

(** Algorithm 1 corrected: if no hedge decides it is ε, also without hedges. *)
Definition algorithm_1 (r : reading) (chi : context) (R : rule) : option nat :=
  match active r chi R with
  | 0 => None
  | S k => Some (S k)
  end.

Lemma algorithm_1_from_prefix i bs :
  bs <> [] -> 1 <= i ->
  algorithm_1_from i bs =
  match i - 1 + longest_prefix bs with 0 => None | S k => Some (S k) end.
Proof.
  revert i. induction bs as [|b bs IH]; intros i N I; [congruence|].
  destruct b; simpl.
  - destruct bs as [|b' bs].
    + simpl. destruct i; [lia|]. simpl. rewrite Nat.sub_0_r, Nat.add_1_r. reflexivity.
    + rewrite IH by (try congruence; lia).
      replace (i - 1 + S (longest_prefix (b' :: bs)))
        with (S i - 1 + longest_prefix (b' :: bs)) by lia.
      reflexivity.
  - destruct i as [|[|i]]; simpl; [lia| |]; rewrite ?Nat.sub_0_r, ?Nat.add_0_r; reflexivity.
Qed.

(** Where there are hedges, the algorithm is right as printed. *)
Theorem algorithm_1_as_printed_with_hedges chi R :
  hedges R <> [] -> algorithm_1_as_printed chi R = algorithm_1 Cascade chi R.
Proof.
  intro H. unfold algorithm_1_as_printed, algorithm_1, active.
  rewrite algorithm_1_from_prefix; auto.
  unfold truths. destruct (hedges R); simpl; congruence.
Qed.

(** Where there are none, it returns the layer number 0, which does not exist. *)
Theorem algorithm_1_as_printed_without_hedges chi R :
  hedges R = [] -> algorithm_1_as_printed chi R = Some 0.
Proof. intro H. unfold algorithm_1_as_printed, truths. rewrite H. reflexivity. Qed.

(** * All rules *)

(** What one rule obliges in a context. *)
Definition due_of (r : reading) (chi : context) (R : rule) : list literal :=
  if triggered chi R then clause R (active r chi R) else [].

(** What is due in a context: the literals of all clauses that decide. *)
Definition due (r : reading) (G : ruleset) (chi : context) : list literal :=
  flat_map (due_of r chi) G.

Lemma in_due r G chi l :
  In l (due r G chi) <->
  exists R, In R G /\ triggered chi R = true /\ In l (clause R (active r chi R)).
Proof.
  unfold due, due_of. rewrite in_flat_map. split.
  - intros [R [I H]]. exists R. destruct (triggered chi R); simpl in H; intuition.
  - intros [R [I [T H]]]. exists R. rewrite T. auto.
Qed.

(** The rules do not contradict each other in this context. *)
Definition consistent (r : reading) (G : ruleset) (chi : context) : Prop :=
  contradictory (due r G chi) = false.

Lemma consistent_spec r G chi :
  consistent r G chi <->
  forall l, In l (due r G chi) -> ~ In (opposite l) (due r G chi).
Proof.
  unfold consistent. split.
  - intros H l I J. apply Bool.not_true_iff_false in H. apply H.
    apply contradictory_spec. eauto.
  - intro H. apply Bool.not_true_iff_false. intro C.
    apply contradictory_spec in C. destruct C as [l [I J]]. exact (H l I J).
Qed.

(** Obligations without [NOT] never contradict each other. *)
Lemma positive_consistent r G chi :
  (forall R, In R G -> positive_rule R) -> consistent r G chi.
Proof.
  intro P. apply consistent_spec. intros l I J.
  assert (Q : forall m, In m (due r G chi) -> positive_literal m = true).
  { intros m M. apply in_due in M. destruct M as [R [? [_ M]]]. eapply P; eauto. }
  pose proof (Q _ I) as A. pose proof (Q _ J) as B. destruct l; simpl in *; congruence.
Qed.
