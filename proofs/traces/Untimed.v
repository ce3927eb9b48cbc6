(** Rules and constraints without time, as a special case of those with time: a trace
    complies with them if and only if what is due at each instant occurs there.  And what
    they oblige depends on the triggers that they name, and on conditions. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints Clashes Conflict.
From Traces Require Import Trace History Continuation Growth Situation.
Import ListNotations.
Local Open Scope Z_scope.

(** * Rules without time, as rules with time *)

Definition timed_literals (ls : list literal) : list response :=
  map (fun l => Response l None []) ls.

Definition timed_of (R : rule) : timed_rule :=
  TimedRule (trigger R) (rule_guard R)
    (TimedChain (timed_literals (default R))
       (map (fun h => (hedge_condition h, TimedChain (timed_literals (hedge_obliges h)) []))
            (hedges R))).

Definition timed_ruleset_of (r : reading) (G : ruleset) (Ks : list constraint) (mere : name -> bool)
  : timed_ruleset := TimedRuleset r At (map timed_of G) (map Stated Ks) mere.

Definition triggers_in (fs : list (formula fact)) : list name := flat_map events_in fs.

Definition conditions_of (R : rule) : list (formula fact) :=
  rule_guard R :: map hedge_condition (hedges R).

(** Triggers are mere inputs, and obligations and names in constraints are not: no
    response triggers a rule. *)
Record no_chains (G : ruleset) (Ks : list constraint) (mere : name -> bool) : Prop := {
  triggers_mere : forall R x, In R G -> x = trigger R \/ In x (triggers_in (conditions_of R)) ->
    mere x = true;
  obligations_act : forall R ls l, In R G -> In ls (clauses R) -> In l ls -> mere (about l) = false;
  assumed_mere : forall k x, In k Ks -> In (Occurs x) (atoms_of (assumed k)) -> mere x = true;
  forbidden_mere : forall k x, In k Ks -> In (Fact (Occurs x)) (atoms_of (forbidden k)) ->
    mere x = true;
  forbidden_act : forall k o, In k Ks -> In (Done o) (atoms_of (forbidden k)) -> mere o = false }.

(** * One instant *)

(** At an instant, to be done is to occur. *)
Definition done_at (i : instant) (a : atom) : bool := context_of i (event_of a).

(** The constraints hold at an instant, and what is due there occurs there. *)
Definition kept_at (r : reading) (S : ruleset) (Ks : list constraint) (i : instant) : Prop :=
  possible Ks (context_of i) = true /\ respects Ks (done_at i)
  /\ forall l, In l (due r S (context_of i)) -> true_in (done_at i) l = true.

Definition at_once (l : literal) : demand := Atomic (Occurrence l 0 (Some 0)).

Lemma at_once_met tr i l :
  ordered tr -> In i tr -> satisfied tr (time i) (at_once l) = true_in (done_at i) l.
Proof.
  intros O I. assert (E : occurs tr (time i) (Occurrence l 0 (Some 0)) = events i (about l)).
  { apply Bool.eq_true_iff_eq. unfold occurs. rewrite existsb_exists. split.
    - intros [j [J H]]. apply andb_true_iff in H. destruct H as [E C]. unfold covers in C.
      cbn [first final] in C. rewrite andb_true_iff, !Z.leb_le in C.
      rewrite (same_time tr i j O I J) by lia. exact E.
    - intro E. exists i. split; [exact I|]. cbn [what]. rewrite E. unfold covers. cbn [first final].
      rewrite andb_true_l, andb_true_iff, !Z.leb_le. lia. }
  unfold at_once. cbn [satisfied]. unfold met. rewrite E. destruct l; reflexivity.
Qed.

Lemma timed_demand r i R :
  rule_demand r At i (timed_of R)
  = Every (map at_once (clause R (active r (context_of i) R))).
Proof.
  unfold rule_demand, timed_of. cbn [timed_response chain_demand].
  assert (D : forall ls, map (demand_of r At i 0) (timed_literals ls) = map at_once ls).
  { intro ls. unfold timed_literals. rewrite map_map. apply map_ext. reflexivity. }
  rewrite D, !map_map. cbn [fst snd]. unfold active, truths, satisfies, clause, clauses.
  rewrite <- (map_nth (fun ls => Every (map at_once ls)) _ []). cbn [map]. f_equal. f_equal.
  rewrite map_map. apply map_ext. intro h. cbn [chain_demand map].
  destruct r; cbn [decides longest_prefix last_true nth]; rewrite D; reflexivity.
Qed.

Lemma timed_rule_kept r tr i R :
  ordered tr -> In i tr ->
  rule_kept r At tr i (timed_of R) = true <->
  forall l, In l (due_of r (context_of i) R) -> true_in (done_at i) l = true.
Proof.
  intros O I. unfold rule_kept. rewrite timed_demand. unfold due_of.
  change (is_triggered i (timed_of R)) with (triggered (context_of i) R).
  destruct (triggered (context_of i) R); cbn [implb satisfied]; [|split; [intros _ l []|reflexivity]].
  rewrite forallb_forall. split.
  - intros H l L. rewrite <- (at_once_met tr i l O I). apply H, in_map, L.
  - intros H d D. apply in_map_iff in D. destruct D as [l [<- L]]. rewrite at_once_met; auto.
Qed.

Lemma stated_kept earlier i later k :
  relation_kept earlier i later (Stated k)
  = eval (context_of i) (assumed k) && negb (eval (done_at i) (forbidden k)).
Proof. cbn [relation_kept invariant eval]. rewrite eval_rename. reflexivity. Qed.

Lemma complies_iff r G Ks mere S e :
  ordered e ->
  complies (timed_ruleset_of r G Ks mere) (map timed_of S) e <->
  forall i, In i e -> kept_at r S Ks i.
Proof.
  intro O. unfold complies, lawful, laws_of. cbn [relations ruleset_reading ruleset_untimed timed_ruleset_of].
  split.
  - intros H i I. destruct (in_split _ _ I) as [earlier [later E]].
    assert (K : forall k, In k Ks -> eval (context_of i) (assumed k) = true
                                     /\ eval (done_at i) (forbidden k) = false).
    { intros k K. specialize (H earlier i later (RelationLaw (Stated k)) E). cbn [law_kept] in H.
      rewrite stated_kept, andb_true_iff, negb_true_iff in H. apply H.
      apply in_app_iff. right. apply in_map, in_map, K. }
    split; [|split].
    + apply forallb_forall. intros k I'. apply K, I'.
    + intros k I'. apply K, I'.
    + intros l L. apply in_flat_map in L. destruct L as [R [IR L]].
      specialize (H earlier i later (RuleLaw (timed_of R)) E). cbn [law_kept] in H. rewrite <- E in H.
      rewrite timed_rule_kept in H by assumption. apply H; [|exact L].
      apply in_app_iff. left. apply in_map, in_map, IR.
  - intros H earlier i later k E K. assert (I : In i e) by (rewrite E; apply in_elt).
    destruct (H i I) as [P [Q D]]. apply in_app_iff in K.
    destruct K as [K|K]; apply in_map_iff in K; destruct K as [x [<- K]];
      apply in_map_iff in K; destruct K as [y [<- K]]; cbn [law_kept].
    + rewrite <- E. apply timed_rule_kept; [assumption..|]. intros l L. apply D.
      apply in_flat_map. eauto.
    + rewrite stated_kept, (Q y K). unfold possible in P. rewrite forallb_forall in P.
      rewrite (P y K). reflexivity.
Qed.

Lemma kept_at_fewer r S T Ks i : incl T S -> kept_at r S Ks i -> kept_at r T Ks i.
Proof.
  intros I [P [Q D]]. split; [exact P|]. split; [exact Q|]. intros l L. apply D.
  apply in_flat_map in L. destruct L as [R [IR L]]. apply in_flat_map. eauto.
Qed.

(** No continuation violates what a lawful history has done. *)
Lemma lawful_kept r G Ks mere s :
  ordered (past s ++ [now s]) -> lawful_so_far (timed_ruleset_of r G Ks mere) s ->
  forall i, In i (past s) -> kept_at r G Ks i.
Proof.
  intros O H i I. destruct (in_split _ _ I) as [earlier [later E]].
  assert (K : forall k, In k Ks -> eval (context_of i) (assumed k) = true
                                   /\ eval (done_at i) (forbidden k) = false).
  { intros k K. destruct (H earlier i later (RelationLaw (Stated k)) E) as [c [_ X]].
    - apply in_app_iff. right. apply in_map, in_map, K.
    - cbn [law_kept] in X. rewrite stated_kept, andb_true_iff, negb_true_iff in X. exact X. }
  split; [|split].
  - apply forallb_forall. intros k I'. apply K, I'.
  - intros k I'. apply K, I'.
  - intros l L. apply in_flat_map in L. destruct L as [R [IR L]].
    destruct (H earlier i later (RuleLaw (timed_of R)) E) as [c [C X]].
    + apply in_app_iff. left. apply in_map, in_map, IR.
    + cbn [law_kept ruleset_reading ruleset_untimed timed_ruleset_of] in X. change (i :: later ++ c) with ((i :: later) ++ c) in X.
      rewrite app_assoc, <- E in X. revert l L. apply (timed_rule_kept r (past s ++ c)); [| |exact X].
      * apply ordered_app in O. destruct O as [Op [_ B]]. destruct C as [Oc F].
        apply ordered_app. split; [exact Op|]. split; [exact Oc|]. intros a b A Bc.
        specialize (B a (now s) A (or_introl eq_refl)). rewrite Forall_forall in F.
        specialize (F b Bc). lia.
      * apply in_or_app. auto.
Qed.

(** * Contexts with the same inputs *)

Definition same_inputs (mere : name -> bool) (chi psi : context) : Prop :=
  (forall x, mere x = true -> chi (Occurs x) = psi (Occurs x))
  /\ forall c, chi (Holds c) = psi (Holds c).

Lemma same_eval mere chi psi f :
  same_inputs mere chi psi -> (forall x, In (Occurs x) (atoms_of f) -> mere x = true) ->
  eval chi f = eval psi f.
Proof. intros [O H] M. apply eval_on_atoms. intros [x|c] I; auto. Qed.

(** Rules and constraints that name only these triggers. *)
Definition rules_over (mere : name -> bool) (S : ruleset) : Prop :=
  forall R x, In R S -> x = trigger R \/ In x (triggers_in (conditions_of R)) -> mere x = true.

Definition constraints_over (mere : name -> bool) (Ks : list constraint) : Prop :=
  forall k x, In k Ks ->
    In (Occurs x) (atoms_of (assumed k)) \/ In (Fact (Occurs x)) (atoms_of (forbidden k)) ->
    mere x = true.

Lemma same_due_of mere r S R chi psi :
  rules_over mere S -> In R S -> same_inputs mere chi psi -> due_of r chi R = due_of r psi R.
Proof.
  intros N I E.
  assert (C : forall f, In f (conditions_of R) -> satisfies chi f = satisfies psi f).
  { intros f F. apply (same_eval mere); [exact E|]. intros x X.
    apply (N R x I). right. apply in_flat_map. exists f. split; [exact F|].
    apply in_flat_map. exists (Occurs x). simpl. auto. }
  unfold due_of, triggered, active, truths.
  rewrite (proj1 E (trigger R)) by (apply (N R _ I); auto).
  rewrite (C (rule_guard R)) by (simpl; auto).
  replace (map (fun h => satisfies chi (hedge_condition h)) (hedges R))
    with (map (fun h => satisfies psi (hedge_condition h)) (hedges R)); [reflexivity|].
  apply map_ext_in. intros h H. symmetry. apply C. right. apply in_map, H.
Qed.

Lemma same_due mere r S T chi psi :
  rules_over mere S -> incl T S -> same_inputs mere chi psi -> due r T chi = due r T psi.
Proof.
  intros N I E. unfold due. induction T as [|R T IH]; [reflexivity|]. cbn [flat_map].
  rewrite (same_due_of mere r S R chi psi N (I R (or_introl eq_refl)) E), IH; [reflexivity|].
  intros Q IQ. apply I. right. exact IQ.
Qed.

Lemma same_possible mere Ks chi psi :
  constraints_over mere Ks -> same_inputs mere chi psi -> possible Ks chi = possible Ks psi.
Proof.
  intros N E. unfold possible. apply Bool.eq_true_iff_eq. rewrite !forallb_forall.
  split; intros H k K; rewrite <- (H k K);
    [symmetry|]; apply (same_eval mere); auto; intros x X; apply (N k x K); auto.
Qed.

Lemma same_compatible mere r S T Ks chi psi :
  rules_over mere S -> constraints_over mere Ks -> incl T S -> same_inputs mere chi psi ->
  compatible r T Ks chi -> compatible r T Ks psi.
Proof.
  intros N K I E [v [A [D Q]]]. exists (interpretation psi (fun o => v (Done o))).
  split; [apply interpretation_agrees|]. split.
  - intros l L. rewrite <- (same_due mere r S T chi psi N I E) in L. rewrite <- (D l L).
    destruct l; reflexivity.
  - intros k Ik. rewrite <- (Q k Ik). apply eval_on_atoms. intros [[x|c]|o] X; simpl;
      [|rewrite A; symmetry; apply (proj2 E)|reflexivity].
    rewrite A. symmetry. apply (proj1 E). apply (K k x Ik). auto.
Qed.

Lemma chains_rules_over G Ks mere : no_chains G Ks mere -> rules_over mere G.
Proof. intros N R x I H. exact (triggers_mere _ _ _ N R x I H). Qed.

Lemma chains_constraints_over G Ks mere : no_chains G Ks mere -> constraints_over mere Ks.
Proof.
  intros N k x K [H|H]; [exact (assumed_mere _ _ _ N k x K H)|exact (forbidden_mere _ _ _ N k x K H)].
Qed.

Lemma due_acts mere r G Ks S chi l :
  no_chains G Ks mere -> incl S G -> In l (due r S chi) -> mere (about l) = false.
Proof.
  intros N I L. apply in_due in L. destruct L as [R [IR [_ L]]].
  apply (obligations_act _ _ _ N R (clause R (active r chi R))); auto.
  apply nth_In. rewrite clauses_length. pose proof (active_bound r chi R). lia.
Qed.
