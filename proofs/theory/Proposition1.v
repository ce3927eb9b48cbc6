(** Proposition 1: false as printed, true as corrected (issue 5, theorems 1 and 2).

    "Γ entails the obligation to do O in context χ iff γ(Γ) executes impl(O) in
    context χ." *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Instance Clashes Conflict.
Import ListNotations.
Local Open Scope positive_scope.

Definition entails_to_do r G chi o := entails r G chi (Atom (Done o)).

(** * Corrected *)

(** For every finite ruleset, context and obligation, in both readings, whatever
    methods the rules share.  The two hypotheses are needed: see
    [labels_needed] and [consistency_needed] below. *)
Theorem proposition_1 r method G chi o :
  unique_labels G -> consistent r G chi ->
  entails_to_do r G chi o <-> executes (gamma r method G) G chi o.
Proof.
  intros U C. rewrite executed_iff_due by exact U.
  exact (entailed_iff_due r G chi (Do o) C).
Qed.

(** The paper's own rules have no [NOT]; then unique labels are enough. *)
Corollary proposition_1_positive r method G chi o :
  (forall R, In R G -> positive_rule R) -> unique_labels G ->
  entails_to_do r G chi o <-> executes (gamma r method G) G chi o.
Proof. intros P U. apply proposition_1; auto using positive_consistent. Qed.

(** One half needs no labels, the other no consistency. *)
Theorem entailed_then_executed r method G chi o :
  consistent r G chi -> entails_to_do r G chi o -> executes (gamma r method G) G chi o.
Proof. intros C E. apply due_executed, (entailed_iff_due r G chi (Do o) C), E. Qed.

Theorem executed_then_entailed r method G chi o :
  unique_labels G -> executes (gamma r method G) G chi o -> entails_to_do r G chi o.
Proof.
  intros U E v A M.
  exact (proj1 (models_iff_due r G chi v A) M (Do o) (executed_due r method G chi o U E)).
Qed.

(** Consistency cannot be weakened: the equivalence for all obligations is the
    same thing.  (An instance executes finitely many; a contradiction entails all.) *)
Theorem proposition_1_exact r method G chi :
  unique_labels G ->
  (forall o, entails_to_do r G chi o <-> executes (gamma r method G) G chi o) <->
  consistent r G chi.
Proof.
  intro U. split.
  - intro E. unfold consistent. apply not_true_is_false. intro C.
    set (top := fold_right Pos.max 1 (to_do (due r G chi))).
    assert (B : forall o, In o (to_do (due r G chi)) -> o <= top).
    { unfold top. induction (to_do (due r G chi)) as [|p ps IH]; simpl; [tauto|].
      intros o [<-|I]; [lia|]. specialize (IH _ I). lia. }
    assert (X : executes (gamma r method G) G chi (Pos.succ top)).
    { apply E. apply contradiction_entails_all. exact C. }
    apply executed_iff_due, in_to_do, B in X; [|exact U]. lia.
  - intros C o. apply proposition_1; assumption.
Qed.

(** A prohibition that is entailed is kept: nothing executes what it negates. *)
Theorem prohibitions_kept r method G chi o :
  unique_labels G -> consistent r G chi ->
  entails_literal r G chi (Avoid o) -> ~ executes (gamma r method G) G chi o.
Proof.
  intros U C E X. apply (entailed_iff_due r G chi (Avoid o) C) in E.
  apply executed_iff_due in X; [|exact U].
  exact (proj1 (consistent_spec r G chi) C _ X E).
Qed.

(** * As printed *)

(** As printed, and for the paper's rules only: positive obligations, no two
    rules with one label or one method. *)
Definition as_printed_for (G : ruleset) : Prop :=
  forall method chi o,
    (forall R, In R G -> positive_rule R) -> unique_labels G ->
    (forall R R', In R G -> In R' G -> method R = method R' -> R = R') ->
    (entails_to_do Cascade G chi o <-> executes (gamma_as_printed method G) G chi o).

(** The context in which these triggers occur and these conditions hold, and no
    others do. *)
Definition only (triggers held : list name) : context := fun f =>
  match f with
  | Occurs t => if in_dec Pos.eq_dec t triggers then true else false
  | Holds c => if in_dec Pos.eq_dec c held then true else false
  end.

(** [WHEN t THEN o UNLESS c IN WHICH CASE o'] *)
Definition one_hedge (l t o c o' : name) : rule :=
  Rule l t (Truth true) [Do o] [Hedge (Atom (Holds c)) [Do o']].

(** [WHEN t THEN …] *)
Definition no_hedge (l t : name) (ls : list literal) : rule :=
  Rule l t (Truth true) ls [].

Ltac decide_rules :=
  simpl; intros;
  repeat match goal with H : _ \/ _ |- _ => destruct H as [<-|H] | H : False |- _ => destruct H end;
  try reflexivity; try discriminate; try congruence.

Lemma entails_computed r G chi l :
  entails_by_propagation r G chi l = true -> entails_literal r G chi l.
Proof. apply entails_by_propagation_correct. Qed.

Lemma entails_not_computed r G chi l :
  entails_by_propagation r G chi l = false -> ~ entails_literal r G chi l.
Proof. intros F E. apply entails_by_propagation_correct in E. congruence. Qed.

Lemma executes_computed I G chi o :
  (if in_dec Pos.eq_dec o (executed I G chi) then true else false) = true ->
  executes I G chi o.
Proof. destruct (in_dec _ _ _); [intros _; apply executed_spec; assumption|discriminate]. Qed.

Lemma executes_not_computed I G chi o :
  (if in_dec Pos.eq_dec o (executed I G chi) then true else false) = false ->
  ~ executes I G chi o.
Proof. destruct (in_dec _ _ _) as [|N]; [discriminate|]. intros _ E. apply N, executed_spec, E. Qed.

Lemma positive_clauses R :
  forallb (forallb positive_literal) (clauses R) = true -> positive_rule R.
Proof.
  intros H i l I. unfold clause in I.
  destruct (nth_in_or_default i (clauses R) []) as [J|J].
  - rewrite forallb_forall in H. specialize (H _ J). rewrite forallb_forall in H. auto.
  - rewrite J in I. destruct I.
Qed.

(** [R1: WHEN a THEN o1 UNLESS c IN WHICH CASE o2],
    [R2: WHEN b THEN o3 UNLESS d IN WHICH CASE o4], χ = {a, b, c}. *)
Definition R1 := one_hedge 1 1 1 1 2.
Definition R2 := one_hedge 2 2 3 2 4.
Definition abc := only [1; 2] [1].

(** R2 yields ε, and R1's base is bound with it: o1 is executed, not entailed. *)
Theorem shared_epsilon_executes_too_much method :
  (forall o, entails_to_do Cascade [R1; R2] abc o <-> o = 2 \/ o = 3) /\
  executes (gamma_as_printed method [R1; R2]) [R1; R2] abc 1 /\
  executes (gamma_shared Cascade method [R1; R2]) [R1; R2] abc 1.
Proof.
  split.
  - intro o. change (entails_literal Cascade [R1; R2] abc (Do o) <-> o = 2 \/ o = 3).
    rewrite entailed_iff_due by (vm_compute; reflexivity). vm_compute.
    split; [intros [H|[H|[]]]; inversion H; auto|intros [->| ->]; auto].
  - split; exists R1, SharedEpsilon, [1]; repeat split; try (vm_compute; tauto);
      apply in_variants; exists R1, 0%nat; vm_compute; intuition.
Qed.

Theorem as_printed_false_with_shared_epsilon : ~ as_printed_for [R1; R2].
Proof.
  intro P. specialize (P label abc 1).
  apply (entails_not_computed Cascade [R1; R2] abc (Do 1)); [reflexivity|].
  apply P.
  - decide_rules; apply positive_clauses; reflexivity.
  - unfold unique_labels. decide_rules.
  - decide_rules.
  - apply (proj1 (proj2 (shared_epsilon_executes_too_much label))).
Qed.

(** [WHEN a THEN o1], χ = {a}: a rule without hedges, and no other rule. *)
Definition bare := no_hedge 1 1 [Do 1].

(** Algorithm 1, line 8, returns ℓ(R)0, which is not a layer of the instance. *)
Theorem no_hedges_no_layer method :
  layer_manager (gamma_as_printed method [bare]) (only [1] []) = [Layer 1 0] /\
  ~ In (Layer 1 0) (layers (gamma_as_printed method [bare])).
Proof. split; [reflexivity|]. simpl. intros [H|[]]. discriminate. Qed.

Theorem as_printed_false_without_hedges : ~ as_printed_for [bare].
Proof.
  intro P. specialize (P label (only [1] []) 1).
  apply (executes_not_computed (gamma_as_printed label [bare]) [bare] (only [1] []) 1);
    [vm_compute; reflexivity|].
  apply P.
  - decide_rules; apply positive_clauses; reflexivity.
  - unfold unique_labels. decide_rules.
  - decide_rules.
  - apply (entails_computed Cascade [bare] _ (Do 1)). reflexivity.
Qed.

(** So the proposition as printed is false. *)
Theorem proposition_1_as_printed_false : ~ forall G, as_printed_for G.
Proof. intro P. exact (as_printed_false_with_shared_epsilon (P _)). Qed.

(** * No hypothesis can be dropped *)

(** Two rules with one label: each runs what the other's layer says, methods of their
    own or not. *)
Definition R1' := one_hedge 1 1 3 2 4.

Theorem labels_needed :
  exists G chi o, forall method,
    consistent Cascade G chi /\ (forall R, In R G -> positive_rule R) /\
    executes (gamma Cascade method G) G chi o /\ ~ entails_to_do Cascade G chi o.
Proof.
  exists [R1; R1'], (only [1] [1]), 1. intro method. split; [reflexivity|]. split.
  - decide_rules; apply positive_clauses; reflexivity.
  - split.
    + exists R1, (Epsilon 1), [1]. repeat split; try (vm_compute; tauto).
      apply in_variants. exists R1, 0%nat. vm_compute. intuition.
    + apply (entails_not_computed _ _ _ (Do 1)). reflexivity.
Qed.

(** Two rules that contradict each other, and a third that is not triggered:
    everything is entailed, o2 too, and nothing executes it. *)
Definition at_odds := [no_hedge 1 1 [Do 1]; no_hedge 2 1 [Avoid 1]; no_hedge 3 2 [Do 2]].

Theorem consistency_needed :
  exists G chi o, forall method,
    unique_labels G /\ entails_to_do Cascade G chi o /\
    ~ executes (gamma Cascade method G) G chi o.
Proof.
  assert (U : unique_labels at_odds) by (unfold unique_labels; decide_rules).
  exists at_odds, (only [1] []), 2. intro method. split; [exact U|split].
  - apply (entails_computed _ _ _ (Do 2)). reflexivity.
  - rewrite executed_iff_due by exact U. vm_compute. intuition discriminate.
Qed.

(** In the same context what is forbidden is executed. *)
Theorem prohibitions_need_consistency :
  exists G chi o,
    unique_labels G /\ entails_literal Cascade G chi (Avoid o) /\
    executes (gamma Cascade label G) G chi o.
Proof.
  exists at_odds, (only [1] []), 1. split; [|split].
  - unfold unique_labels. decide_rules.
  - apply entails_computed. reflexivity.
  - apply executes_computed. vm_compute. reflexivity.
Qed.

(** An ε for each rule is needed: with the others corrected, a shared one fails. *)
Theorem own_epsilon_needed :
  exists G chi o, forall method,
    unique_labels G /\ (forall R, In R G -> positive_rule R) /\
    executes (gamma_shared Cascade method G) G chi o /\ ~ entails_to_do Cascade G chi o.
Proof.
  exists [R1; R2], abc, 1. intro method. split; [unfold unique_labels; decide_rules|]. split.
  - decide_rules; apply positive_clauses; reflexivity.
  - split.
    + apply shared_epsilon_executes_too_much.
    + apply (entails_not_computed _ _ _ (Do 1)). reflexivity.
Qed.

(** * Constraints *)

(** They forbid and oblige nothing: what is due comes from the rules alone.  In a
    context that does not conflict the proposition holds, and what is executed, and
    not executed because it is forbidden, can be had with all constraints kept. *)
Theorem proposition_1_with_constraints r method G Ks chi :
  unique_labels G -> compatible r G Ks chi ->
  (forall o, entails_to_do r G chi o <-> executes (gamma r method G) G chi o) /\
  (exists v, agrees chi v /\ models r G v /\ respects Ks v /\
             (forall o, executes (gamma r method G) G chi o -> v (Done o) = true) /\
             (forall o, entails_literal r G chi (Avoid o) -> v (Done o) = false)).
Proof.
  intros U P. pose proof (compatible_consistent r G Ks chi P) as C.
  split; [intro o; apply proposition_1; assumption|].
  destruct P as [v [A [T K]]]. exists v.
  pose proof (proj2 (models_iff_due r G chi v A) T) as M.
  split; [exact A|]. split; [exact M|]. split; [exact K|]. split.
  - intros o E. exact (T (Do o) (executed_due r method G chi o U E)).
  - intros o E. apply (entailed_iff_due r G chi (Avoid o) C), T in E.
    unfold true_in in E. simpl in E. apply negb_true_iff. exact E.
Qed.

(** Conflict-freeness is needed for that: o1 and o2 are due and exclude each other. *)
Theorem conflict_freeness_needed :
  exists G Ks chi,
    unique_labels G /\ consistent Cascade G chi /\
    ~ exists v, agrees chi v /\ respects Ks v /\
        forall o, executes (gamma Cascade label G) G chi o -> v (Done o) = true.
Proof.
  set (G := [no_hedge 1 1 [Do 1]; no_hedge 2 1 [Do 2]]). set (Ks := [Exclusive [1; 2]]).
  set (chi := only [1] []). exists G, Ks, chi.
  assert (U : unique_labels G) by (unfold G, unique_labels; decide_rules).
  split; [exact U|]. split; [reflexivity|]. intros [v [_ [K E]]].
  specialize (K _ (or_introl eq_refl)). rewrite exclusive_meaning in K.
  assert (D : forall o, In (Do o) (due Cascade G chi) -> v (Done o) = true).
  { intros o I. apply E, due_executed, I. }
  specialize (K 1 2). rewrite (D 1), (D 2) in K by (vm_compute; auto).
  discriminate K; simpl; auto; discriminate.
Qed.

(** If constraints were premises of Definition 1, more would be entailed than is
    executed: [NEVER o1 AND NOT o2], and o1 is due. *)
Theorem constraints_oblige_nothing :
  exists G Ks chi o,
    unique_labels G /\ compatible Cascade G Ks chi /\
    (forall v, agrees chi v -> models Cascade G v -> respects Ks v -> v (Done o) = true) /\
    ~ executes (gamma Cascade label G) G chi o.
Proof.
  set (G := [no_hedge 1 1 [Do 1]]).
  set (never := And (Atom (Done 1)) (Not (Atom (Done 2)))).
  exists G, [Never never], (only [1] []), 2.
  split; [unfold G, unique_labels; decide_rules|]. split; [|split].
  - apply clash_here_spec. vm_compute. reflexivity.
  - intros v A M K. specialize (K _ (or_introl eq_refl)). simpl in K.
    assert (T : v (Done 1) = true).
    { apply (proj1 (models_iff_due Cascade G (only [1] []) v A) M (Do 1)). vm_compute. auto. }
    rewrite T in K. simpl in K. apply negb_false_iff in K. exact K.
  - apply executes_not_computed. vm_compute. reflexivity.
Qed.
