(** Definition 1 ([sleec_verify/entailment/entailment.py]): what a ruleset entails in a
    context, over all interpretations; and two procedures that decide it, one by
    definition, one by propagation.  Both are meant to be extracted. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation.
Import ListNotations.

(** * Definition 1 *)

(** A model of χ and of {¬ι | ι ∉ χ}. *)
Definition agrees (chi : context) (v : atom -> bool) : Prop :=
  forall f, v (Fact f) = chi f.

Definition models (r : reading) (G : ruleset) (v : atom -> bool) : Prop :=
  forall R, In R G -> eval v (equation r R) = true.

(** ⋃ compile(R), χ, {¬ι | ι ∉ χ} ⊨ φ *)
Definition entails (r : reading) (G : ruleset) (chi : context) (phi : formula atom) : Prop :=
  forall v, agrees chi v -> models r G v -> eval v phi = true.

Definition entails_literal r G chi l := entails r G chi (formula_of l).

(** * Models and what is due *)

(** An interpretation is a context and, for each obligation, whether it is done. *)
Definition interpretation (chi : context) (w : name -> bool) (a : atom) : bool :=
  match a with Fact f => chi f | Done o => w o end.

Lemma interpretation_agrees chi w : agrees chi (interpretation chi w).
Proof. intro f. reflexivity. Qed.

Lemma due_of_ext r chi psi R :
  (forall f, chi f = psi f) -> due_of r chi R = due_of r psi R.
Proof.
  intro H. unfold due_of, triggered, active, truths, satisfies.
  rewrite H. rewrite (eval_ext _ psi) by auto.
  erewrite map_ext; [reflexivity|]. intro h. apply eval_ext. auto.
Qed.

Lemma due_ext r chi psi G : (forall f, chi f = psi f) -> due r G chi = due r G psi.
Proof. intro H. unfold due. apply flat_map_ext. intro R. apply due_of_ext, H. Qed.

(** In a context, Equation 1 of all rules says that what is due is true, no more
    and no less. *)
Theorem models_iff_due r G chi v :
  agrees chi v ->
  models r G v <-> forall l, In l (due r G chi) -> true_in v l = true.
Proof.
  intro A. unfold models, due. split.
  - intros M l I. apply in_flat_map in I. destruct I as [R [IR I]].
    specialize (M R IR). rewrite equation_spec in M. apply M.
    rewrite (due_of_ext _ _ chi) by exact A. exact I.
  - intros D R IR. apply equation_spec. intros l I. apply D.
    apply in_flat_map. exists R. split; auto.
    rewrite <- (due_of_ext _ (context_in v)) by exact A. exact I.
Qed.

(** Two extreme ones: do only what is to be done; do all but what is not to be. *)
Definition least_model (chi : context) (ls : list literal) : atom -> bool :=
  interpretation chi (fun o => listed (Do o) ls).

Definition greatest_model (chi : context) (ls : list literal) : atom -> bool :=
  interpretation chi (fun o => negb (listed (Avoid o) ls)).

Lemma least_model_true chi ls l :
  contradictory ls = false -> In l ls -> true_in (least_model chi ls) l = true.
Proof.
  intros C I. destruct l as [o|o]; unfold true_in; simpl.
  - apply listed_In. exact I.
  - apply negb_true_iff, not_true_iff_false. rewrite listed_In. intro J.
    apply not_true_iff_false in C. apply C. apply contradictory_spec.
    exists (Avoid o). auto.
Qed.

Lemma greatest_model_true chi ls l :
  contradictory ls = false -> In l ls -> true_in (greatest_model chi ls) l = true.
Proof.
  intros C I. destruct l as [o|o]; unfold true_in; simpl.
  - apply negb_true_iff, not_true_iff_false. rewrite listed_In. intro J.
    apply not_true_iff_false in C. apply C. apply contradictory_spec.
    exists (Do o). auto.
  - rewrite negb_involutive. apply listed_In. exact I.
Qed.

(** Ex falso: in a context in which the rules contradict each other, everything
    is entailed. *)
Theorem contradiction_entails_all r G chi phi :
  contradictory (due r G chi) = true -> entails r G chi phi.
Proof.
  intros C v A M. apply contradictory_spec in C. destruct C as [l [I J]].
  pose proof (proj1 (models_iff_due r G chi v A) M) as D.
  pose proof (D _ I) as X. pose proof (D _ J) as Y.
  rewrite true_in_opposite, X in Y. discriminate.
Qed.

(** Where they do not, exactly the literals that are due are entailed. *)
Theorem entailed_iff_due r G chi l :
  consistent r G chi -> entails_literal r G chi l <-> In l (due r G chi).
Proof.
  intro C. split.
  - intro E. apply listed_In. destruct l as [o|o].
    + specialize (E (least_model chi (due r G chi)) (interpretation_agrees _ _)).
      apply E. apply (models_iff_due _ _ _ _ (interpretation_agrees _ _)).
      intros m I. apply least_model_true; assumption.
    + specialize (E (greatest_model chi (due r G chi)) (interpretation_agrees _ _)).
      assert (X : true_in (greatest_model chi (due r G chi)) (Avoid o) = true).
      { apply E. apply (models_iff_due _ _ _ _ (interpretation_agrees _ _)).
        intros m I. apply greatest_model_true; assumption. }
      unfold true_in in X. simpl in X. rewrite negb_involutive in X. exact X.
  - intros I v A M. exact (proj1 (models_iff_due r G chi v A) M l I).
Qed.

(** * Deciding it by definition: a table over the named obligations *)

Definition obligations_in (phi : formula atom) : list name :=
  flat_map (fun a => match a with Fact _ => [] | Done o => [o] end) (atoms_of phi).

Definition obligations_of_ruleset (r : reading) (G : ruleset) : list name :=
  flat_map (fun R => obligations_in (equation r R)) G.

(** Every way to do some of these and no other. *)
Fixpoint valuations (names : list name) : list (name -> bool) :=
  match names with
  | [] => [fun _ => false]
  | o :: rest =>
      flat_map (fun w => [w; fun p => if Pos.eqb p o then true else w p]) (valuations rest)
  end.

Definition entails_by_table (r : reading) (G : ruleset) (chi : context) (phi : formula atom)
  : bool :=
  forallb
    (fun w =>
       let v := interpretation chi w in
       implb (forallb (fun R => eval v (equation r R)) G) (eval v phi))
    (valuations (nodup Pos.eq_dec (obligations_in phi ++ obligations_of_ruleset r G))).

Lemma valuations_complete names (w : name -> bool) :
  exists w', In w' (valuations names) /\ forall o, In o names -> w' o = w o.
Proof.
  induction names as [|o names [w' [I H]]].
  - exists (fun _ => false). simpl. intuition.
  - destruct (w o) eqn:W.
    + exists (fun p => if Pos.eqb p o then true else w' p). split.
      * simpl. apply in_flat_map. exists w'. simpl. auto.
      * intros p [<-|P]; [rewrite Pos.eqb_refl; congruence|].
        destruct (Pos.eqb_spec p o); [congruence|auto].
    + destruct (in_dec Pos.eq_dec o names) as [Y|N].
      * exists w'. split; [simpl; apply in_flat_map; exists w'; simpl; auto|].
        intros p [<-|P]; auto.
      * (* Not named below, so this valuation leaves it undone. *)
        assert (F : forall names u, In u (valuations names) -> ~ In o names -> u o = false).
        { clear. induction names as [|q names IH]; simpl; intros u U N.
          - destruct U as [<-|[]]. reflexivity.
          - apply in_flat_map in U. destruct U as [u' [U' [<-|[<-|[]]]]].
            + apply IH; tauto.
            + destruct (Pos.eqb_spec o q); [subst; tauto|]. apply IH; tauto. }
        exists w'. split; [simpl; apply in_flat_map; exists w'; simpl; auto|].
        intros p [<-|P]; auto. rewrite W. eapply F; eauto.
Qed.

Lemma eval_on_obligations chi v w phi :
  agrees chi v -> (forall o, In o (obligations_in phi) -> v (Done o) = w o) ->
  eval v phi = eval (interpretation chi w) phi.
Proof.
  intros A H. apply eval_on_atoms. intros [f|o] I; simpl; [apply A|].
  apply H. unfold obligations_in. apply in_flat_map. exists (Done o). simpl. auto.
Qed.

Theorem entails_by_table_correct r G chi phi :
  entails_by_table r G chi phi = true <-> entails r G chi phi.
Proof.
  unfold entails_by_table. rewrite forallb_forall. split.
  - intros T v A M.
    destruct (valuations_complete
                (nodup Pos.eq_dec (obligations_in phi ++ obligations_of_ruleset r G))
                (fun o => v (Done o))) as [w [W H]].
    specialize (T w W). cbv zeta in T.
    assert (S : forall o, In o (obligations_in phi ++ obligations_of_ruleset r G) ->
                          v (Done o) = w o).
    { intros o I. symmetry. apply H, nodup_In, I. }
    rewrite (eval_on_obligations chi v w phi A) by auto using in_or_app.
    replace (forallb _ G) with true in T; [exact T|].
    symmetry. apply forallb_forall. intros R IR.
    rewrite <- (eval_on_obligations chi v w (equation r R) A); [auto|].
    intros o I. apply S, in_or_app. right. apply in_flat_map. eauto.
  - intros E w _. cbv zeta.
    destruct (forallb (fun R => eval (interpretation chi w) (equation r R)) G) eqn:M;
      [simpl|reflexivity].
    apply E; [apply interpretation_agrees|].
    rewrite forallb_forall in M. exact M.
Qed.

(** * Deciding it by one propagation over Equation 1 *)

(** The literals of the clauses whose guards are true.  Unlike [due] this
    evaluates the guards of Equation 1 and walks no chain. *)
Definition propagated (r : reading) (G : ruleset) (chi : context) : list literal :=
  flat_map
    (fun R =>
       flat_map (fun i => if eval chi (guard r R i) then clause R i else [])
                (clause_numbers R))
    G.

Definition entails_by_propagation (r : reading) (G : ruleset) (chi : context) (l : literal)
  : bool :=
  let ls := propagated r G chi in listed l ls || contradictory ls.

Lemma in_propagated r G chi l : In l (propagated r G chi) <-> In l (due r G chi).
Proof.
  unfold propagated. rewrite in_flat_map, in_due. split.
  - intros [R [IR H]]. apply in_flat_map in H. destruct H as [i [I H]].
    destruct (eval chi (guard r R i)) eqn:E; [|destruct H].
    apply in_clause_numbers in I. apply guard_true in E; auto. destruct E as [T <-].
    eauto.
  - intros [R [IR [T H]]]. exists R. split; auto. apply in_flat_map.
    exists (active r chi R). split; [apply in_clause_numbers, active_bound|].
    replace (eval _ _) with true; auto. symmetry. apply guard_true; auto using active_bound.
Qed.

Lemma contradictory_same ls ms :
  (forall l, In l ls <-> In l ms) -> contradictory ls = contradictory ms.
Proof.
  intro H. apply Bool.eq_true_iff_eq. rewrite !contradictory_spec.
  split; intros [l [I J]]; exists l; rewrite ?H, <- ?H in *; auto; split; apply H; auto.
Qed.

Theorem entails_by_propagation_correct r G chi l :
  entails_by_propagation r G chi l = true <-> entails_literal r G chi l.
Proof.
  unfold entails_by_propagation. cbv zeta.
  rewrite (contradictory_same _ (due r G chi)) by (intro; apply in_propagated).
  rewrite orb_true_iff, listed_In, in_propagated.
  destruct (contradictory (due r G chi)) eqn:C.
  - split; auto. intros _. apply contradiction_entails_all. exact C.
  - rewrite <- (entailed_iff_due r G chi l C). intuition discriminate.
Qed.

(** The two procedures agree on every literal. *)
Corollary procedures_agree r G chi l :
  entails_by_propagation r G chi l = entails_by_table r G chi (formula_of l).
Proof.
  apply Bool.eq_true_iff_eq.
  rewrite entails_by_propagation_correct, entails_by_table_correct. reflexivity.
Qed.
