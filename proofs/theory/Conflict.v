(** The conflict check ([sleec_verify/checks/conflict.py]; issue 5, theorem 6): a
    formula that is unsatisfiable exactly if no context conflicts.  Its clauses are in
    [ConflictClauses.v]. *)

From Coq Require Import List Bool PArith Arith Lia FMapPositive.
From Sleec Require Import Model Evaluation Equation Entailment Clashes.
Import ListNotations.

(** * Conflicts *)

(** What is due, the context and the constraints have a common model over O. *)
Definition compatible (r : reading) (G : ruleset) (Ks : list constraint) (chi : context) : Prop :=
  jointly_possible Ks chi (due r G chi).

Definition conflicts r G Ks chi : Prop := ~ compatible r G Ks chi.

(** A ruleset is conflict-free if no context that can be conflicts. *)
Definition conflict_free (r : reading) (G : ruleset) (Ks : list constraint) : Prop :=
  forall chi, possible Ks chi = true -> compatible r G Ks chi.

Definition obliged_literals (G : ruleset) : list literal := flat_map (@concat _) (map clauses G).

Lemma due_obliged r G chi : incl (due r G chi) (obliged_literals G).
Proof.
  intros l I. apply in_due in I. destruct I as [R [I [_ L]]].
  unfold obliged_literals. apply in_flat_map. exists (clauses R).
  split; [apply in_map, I|]. apply in_concat. exists (clause R (active r chi R)).
  split; [|exact L]. apply nth_In. rewrite clauses_length. pose proof (active_bound r chi R). lia.
Qed.

(** Names as a set: to look for each among thousands. *)
Definition set_of (os : list name) : PositiveMap.t unit :=
  fold_right (fun o m => PositiveMap.add o tt m) (PositiveMap.empty unit) os.

Lemma set_of_find o os : PositiveMap.find o (set_of os) = Some tt <-> In o os.
Proof.
  induction os as [|p os IH]; cbn [set_of fold_right].
  - rewrite PositiveMap.gempty. split; [discriminate|intros []].
  - destruct (Pos.eq_dec o p) as [->|N].
    + rewrite PositiveMap.gss. split; [left; reflexivity|reflexivity].
    + rewrite PositiveMap.gso by exact N. fold (set_of os). rewrite IH. simpl.
      split; [auto|intros [E|I]; [congruence|exact I]].
Qed.

(** What a list of literals tells not to do. *)
Definition to_avoid (ls : list literal) : list name :=
  flat_map (fun l => match l with Do _ => [] | Avoid o => [o] end) ls.

Lemma in_to_avoid o ls : In o (to_avoid ls) <-> In (Avoid o) ls.
Proof.
  unfold to_avoid. rewrite in_flat_map. split.
  - intros [[p|p] [H I]]; simpl in I; [destruct I | destruct I as [->|[]]; assumption].
  - intro H. exists (Avoid o). simpl. auto.
Qed.

(** A name and its negation, where rules oblige both. *)
Definition direct_clashes (ls : list literal) : list clash :=
  let avoided := set_of (to_avoid ls) in
  flat_map (fun o => match PositiveMap.find o avoided with
                     | Some _ => [Clash [Do o; Avoid o] []]
                     | None => []
                     end)
           (map fst (PositiveMap.elements (set_of (to_do ls)))).

Lemma in_direct_clashes c ls :
  In c (direct_clashes ls) <->
  exists o, c = Clash [Do o; Avoid o] [] /\ In (Do o) ls /\ In (Avoid o) ls.
Proof.
  unfold direct_clashes. rewrite in_flat_map. split.
  - intros [o [I J]]. apply in_map_iff in I. destruct I as [[p []] [<- I]]. simpl in J.
    apply PositiveMap.elements_complete, set_of_find, in_to_do in I.
    destruct (PositiveMap.find p (set_of (to_avoid ls))) as [[]|] eqn:F; [|destruct J].
    apply set_of_find, in_to_avoid in F. destruct J as [<-|[]]. eauto.
  - intros [o [-> [I J]]]. exists o. split.
    + apply in_map_iff. exists (o, tt). split; [reflexivity|].
      apply PositiveMap.elements_correct, set_of_find, in_to_do, I.
    + apply in_to_avoid, set_of_find in J. rewrite J. left. reflexivity.
Qed.

Definition all_clashes (G : ruleset) (Ks : list constraint) : list clash :=
  direct_clashes (obliged_literals G) ++ clashes Ks (obliged_literals G).

(** Some clash of [cs] is among what is due, and its labels are true. *)
Definition one_here (r : reading) (G : ruleset) (chi : context) (cs : list clash) : bool :=
  existsb (fun c => here chi c && within (due r G chi) c) cs.

Definition clash_here (r : reading) (G : ruleset) (Ks : list constraint) (chi : context) : bool :=
  one_here r G chi (all_clashes G Ks).

Lemma direct_clashes_spec chi ls ms :
  incl ms ls ->
  existsb (fun c => here chi c && within ms c) (direct_clashes ls) = contradictory ms.
Proof.
  intro S. apply Bool.eq_true_iff_eq. rewrite existsb_exists, contradictory_spec. split.
  - intros [c [I X]]. apply in_direct_clashes in I. destruct I as [o [-> _]].
    unfold here, within in X. simpl in X. rewrite andb_true_r, andb_true_iff in X.
    exists (Do o). simpl. rewrite <- !listed_In. exact X.
  - assert (E : forall o, In (Do o) ms -> In (Avoid o) ms ->
        exists c, In c (direct_clashes ls) /\ here chi c && within ms c = true).
    { intros o I J. exists (Clash [Do o; Avoid o] []). split.
      - apply in_direct_clashes. exists o. auto.
      - unfold here, within. simpl. rewrite andb_true_r, andb_true_iff, !listed_In. auto. }
    intros [[o|o] [I J]]; eauto.
Qed.

(** The ∀ over obligations is gone: a context conflicts exactly where a clash is. *)
Theorem clash_here_spec r G Ks chi :
  compatible r G Ks chi <-> clash_here r G Ks chi = false.
Proof.
  unfold clash_here, one_here, all_clashes, compatible. rewrite existsb_app, orb_false_iff.
  rewrite direct_clashes_spec by apply due_obliged.
  assert (N : existsb (fun c => here chi c && within (due r G chi) c)
                      (clashes Ks (obliged_literals G)) = false <->
              forall c, In c (clashes Ks (obliged_literals G)) ->
                        here chi c && within (due r G chi) c = false).
  { rewrite <- not_true_iff_false, existsb_exists. split.
    - intros H c I. apply not_true_is_false. intro T. apply H. eauto.
    - intros H [c [I T]]. rewrite (H c I) in T. discriminate. }
  rewrite N. split.
  - intro P. assert (C : contradictory (due r G chi) = false).
    { apply not_true_is_false. intro C. apply contradictory_spec in C.
      destruct C as [l [I J]]. destruct P as [v [_ [T _]]].
      pose proof (T _ I) as X. pose proof (T _ J) as Y.
      rewrite true_in_opposite, X in Y. discriminate. }
    split; [exact C|]. apply clashes_decide; auto using due_obliged.
  - intros [C H]. apply (clashes_decide Ks (obliged_literals G)); auto using due_obliged.
Qed.

Corollary conflicts_iff r G Ks chi :
  conflicts r G Ks chi <-> clash_here r G Ks chi = true.
Proof.
  unfold conflicts. rewrite clash_here_spec, not_false_iff_true. reflexivity.
Qed.

(** A context conflicts or it does not: no excluded middle is assumed. *)
Corollary compatible_or_conflicts r G Ks chi :
  compatible r G Ks chi \/ conflicts r G Ks chi.
Proof.
  rewrite conflicts_iff, clash_here_spec.
  destruct (clash_here r G Ks chi); auto.
Qed.

(** ** By definition: a table over the named obligations *)

Definition compatible_by_table (r : reading) (G : ruleset) (Ks : list constraint) (chi : context)
  : bool :=
  let ls := due r G chi in
  existsb
    (fun w =>
       let v := interpretation chi w in
       forallb (true_in v) ls && forallb (fun k => negb (eval v (forbidden k))) Ks)
    (valuations (nodup Pos.eq_dec
                   (map about ls ++ flat_map (fun k => obligations_in (forbidden k)) Ks))).

Theorem compatible_by_table_correct r G Ks chi :
  compatible_by_table r G Ks chi = true <-> compatible r G Ks chi.
Proof.
  unfold compatible_by_table, compatible, jointly_possible. cbv zeta.
  rewrite existsb_exists. split.
  - intros [w [_ T]]. apply andb_true_iff in T. destruct T as [T K].
    rewrite forallb_forall in T, K. exists (interpretation chi w).
    split; [apply interpretation_agrees|]. split; [exact T|].
    intros k I. apply negb_true_iff, K, I.
  - intros [v [A [T K]]].
    set (names := map about (due r G chi) ++ flat_map (fun k => obligations_in (forbidden k)) Ks).
    destruct (valuations_complete (nodup Pos.eq_dec names) (fun o => v (Done o))) as [w [W H]].
    exists w. split; [exact W|].
    assert (S : forall o, In o names -> v (Done o) = w o).
    { intros o I. symmetry. apply H, nodup_In, I. }
    apply andb_true_iff. split; apply forallb_forall.
    + intros l L. rewrite <- (T l L). unfold true_in. symmetry.
      apply eval_on_obligations; [exact A|]. intros o I. apply S, in_app_iff. left.
      replace o with (about l); [apply in_map, L|].
      destruct l; simpl in I; destruct I as [I|[]]; exact I.
    + intros k I. apply negb_true_iff. rewrite <- (K k I). symmetry.
      apply eval_on_obligations; [exact A|]. intros o J. apply S, in_app_iff. right.
      apply in_flat_map. eauto.
Qed.

(** Without constraints to conflict is to contradict: a literal and its opposite. *)
Theorem compatible_without_constraints r G chi :
  compatible r G [] chi <-> consistent r G chi.
Proof.
  split.
  - intros [v [_ [T _]]]. apply consistent_spec. intros l I J.
    pose proof (T _ I) as X. pose proof (T _ J) as Y.
    rewrite true_in_opposite, X in Y. discriminate.
  - intro C. exists (least_model chi (due r G chi)). split; [apply interpretation_agrees|].
    split; [intros; apply least_model_true; assumption|intros k []].
Qed.

(** A context that does not conflict is consistent, so Proposition 1 holds there. *)
Theorem compatible_consistent r G Ks chi : compatible r G Ks chi -> consistent r G chi.
Proof.
  intros [v [A [T _]]]. apply compatible_without_constraints. exists v.
  split; [exact A|]. split; [exact T|intros k []].
Qed.

(** Obligations without [NOT], and no constraints: nothing can conflict. *)
Theorem positive_rules_never_conflict r G :
  (forall R, In R G -> positive_rule R) -> conflict_free r G [].
Proof. intros P chi _. apply compatible_without_constraints, positive_consistent, P. Qed.

(** * The formula *)

(** Where a literal is due: the guards of the clauses that oblige it. *)
Definition due_formula (r : reading) (G : ruleset) (l : literal) : formula fact :=
  disj (flat_map (fun R =>
          flat_map (fun i => if listed l (clause R i) then [guard r R i] else [])
                   (clause_numbers R)) G).

Lemma due_formula_spec r G l chi : eval chi (due_formula r G l) = listed l (due r G chi).
Proof.
  unfold due_formula. rewrite eval_disj. apply Bool.eq_true_iff_eq.
  rewrite existsb_exists, listed_In, in_due. split.
  - intros [f [I E]]. apply in_flat_map in I. destruct I as [R [IR I]].
    apply in_flat_map in I. destruct I as [i [Ii I]].
    destruct (listed l (clause R i)) eqn:L; [|destruct I]. destruct I as [<-|[]].
    apply in_clause_numbers in Ii. apply guard_true in E; [|exact Ii].
    destruct E as [T <-]. exists R. rewrite <- listed_In. auto.
  - intros [R [IR [T L]]]. exists (guard r R (active r chi R)). split.
    + apply in_flat_map. exists R. split; [exact IR|]. apply in_flat_map.
      exists (active r chi R). split; [apply in_clause_numbers, active_bound|].
      rewrite (proj2 (listed_In _ _) L). left. reflexivity.
    + apply guard_true; auto using active_bound.
Qed.

Definition clash_formula (r : reading) (G : ruleset) (c : clash) : formula fact :=
  And (conj (labels c)) (conj (map (due_formula r G) (literals c))).

Lemma clash_formula_value r G c chi :
  eval chi (clash_formula r G c) = here chi c && within (due r G chi) c.
Proof.
  unfold clash_formula. cbn [eval]. rewrite !eval_conj. f_equal.
  unfold within. rewrite forallb_map. induction (literals c) as [|l ls IH]; [reflexivity|].
  cbn [forallb]. rewrite due_formula_spec, IH. reflexivity.
Qed.

(** Some clash is due, in a context that can be. *)
Definition conflict_formula (r : reading) (G : ruleset) (Ks : list constraint) : formula fact :=
  And (conj (map assumed Ks)) (disj (map (clash_formula r G) (all_clashes G Ks))).

Lemma conflict_formula_value r G Ks chi :
  eval chi (conflict_formula r G Ks) = possible Ks chi && clash_here r G Ks chi.
Proof.
  unfold conflict_formula, possible, clash_here, one_here. cbn [eval]. rewrite eval_conj, forallb_map. f_equal.
  rewrite eval_disj, existsb_map. induction (all_clashes G Ks) as [|c cs IH]; [reflexivity|].
  cbn [existsb]. rewrite IH, clash_formula_value. reflexivity.
Qed.

(** The formula is true in the contexts that conflict, and in no others. *)
Theorem conflict_formula_spec r G Ks chi :
  eval chi (conflict_formula r G Ks) = true <->
  possible Ks chi = true /\ conflicts r G Ks chi.
Proof. rewrite conflict_formula_value, andb_true_iff, conflicts_iff. reflexivity. Qed.

(** Soundness and completeness of the check. *)
Theorem conflict_check r G Ks :
  conflict_free r G Ks <-> forall chi, eval chi (conflict_formula r G Ks) = false.
Proof.
  unfold conflict_free. split.
  - intros F chi. apply not_true_is_false. intro E. apply conflict_formula_spec in E.
    destruct E as [P C]. exact (C (F chi P)).
  - intros U chi P. destruct (compatible_or_conflicts r G Ks chi) as [C|C]; [exact C|].
    exfalso. assert (E : eval chi (conflict_formula r G Ks) = true).
    { apply conflict_formula_spec. auto. }
    rewrite U in E. discriminate.
Qed.
