(** A question over all contexts ([sleec_verify/query/question.py]): is there one, among
    those that can be, in which a formula is true?  And its clauses. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Clauses Cnf Clashes.
Import ListNotations.

(** "One of these is true in a context that can be": the first clause says so. *)
Definition questions_clauses (Ks : list constraint) (phis : list (formula fact)) : cnf :=
  let (xs, s1) := build_facts phis start in
  let (ys, s2) := build_facts (map assumed Ks) s1 in
  xs :: map (fun y => [y]) ys ++ built s2.

Definition question_clauses (Ks : list constraint) (phi : formula fact) : cnf :=
  questions_clauses Ks [phi].

Lemma units_true_iff a (ys : list lit) :
  forallb (clause_true a) (map (fun y => [y]) ys) = forallb (lit_true a) ys.
Proof.
  rewrite forallb_map. induction ys as [|y ys IH]; [reflexivity|]. cbn [forallb].
  rewrite IH. unfold clause_true. cbn [existsb]. rewrite orb_false_r. reflexivity.
Qed.

Lemma questions_gates Ks phis :
  exists s (value : (positive -> bool) -> bool),
    extends start s /\
    (forall a, cnf_true a (built s) = true ->
       value a = possible Ks (facts_in a) && existsb (eval (facts_in a)) phis) /\
    (forall a, cnf_true a (questions_clauses Ks phis) = cnf_true a (built s) && value a).
Proof.
  unfold questions_clauses, build_facts. pose proof start_sound as S.
  pose proof (build_all_gives fact fact_number fact_number_even phis start) as P.
  destruct (build_all fact fact_number phis start) as [xs s1].
  pose proof (build_all_gives fact fact_number fact_number_even (map assumed Ks) s1) as Y.
  destruct (build_all fact fact_number (map assumed Ks) s1) as [ys s2].
  destruct (P S) as [X1 [_ [V _]]]. destruct (Y (extends_sound _ _ X1 S)) as [X2 [_ [W _]]].
  exists s2, (fun a => existsb (lit_true a) xs && forallb (lit_true a) ys). split; [|split].
  - eapply extends_trans; eauto.
  - intros a A. rewrite andb_comm. f_equal.
    + rewrite <- (forallb_map id (lit_true a)), (W a A), !forallb_map. reflexivity.
    + rewrite <- (existsb_map id (lit_true a)), (V a) by (eapply extends_true; eauto).
      rewrite existsb_map. reflexivity.
  - intro a. unfold cnf_true at 1. cbn [forallb]. rewrite forallb_app, units_true_iff.
    unfold clause_true at 1. fold (cnf_true a (built s2)).
    destruct (existsb (lit_true a) xs), (forallb (lit_true a) ys), (cnf_true a (built s2));
      reflexivity.
Qed.

(** The clauses are satisfiable exactly if the answer is yes, and a model is such a
    context. *)
Theorem questions_spec Ks phis :
  satisfiable (questions_clauses Ks phis) <->
  exists chi, possible Ks chi = true /\ existsb (eval chi) phis = true.
Proof.
  destruct (questions_gates Ks phis) as [s [value [[_ [_ [_ E]]] [V T]]]]. split.
  - intros [a A]. rewrite T, andb_true_iff in A. destruct A as [B X].
    rewrite (V a B), andb_true_iff in X. exists (facts_in a). exact X.
  - intros [chi [P F]].
    destruct (E start_sound (assignment_of (interpretation chi (fun _ => false)))) as [a [A B]];
      [reflexivity|].
    assert (X : forall f, facts_in a f = chi f).
    { intro f. unfold facts_in. rewrite A.
      - unfold assignment_of. rewrite atom_of_number. reflexivity.
      - destruct f; exact I. }
    exists a. rewrite T, B, (V a B), (possible_ext Ks _ chi X), P.
    apply existsb_exists in F. destruct F as [phi [I F]]. apply existsb_exists. exists phi.
    split; [exact I|]. rewrite (eval_ext _ chi phi X). exact F.
Qed.

(** They are unsatisfiable exactly if it is no to all. *)
Theorem questions_answered_no Ks phis :
  unsatisfiable (questions_clauses Ks phis) <->
  forall chi phi, possible Ks chi = true -> In phi phis -> eval chi phi = false.
Proof.
  rewrite unsatisfiable_iff, questions_spec. split.
  - intros N chi phi P I. apply not_true_is_false. intro F. apply N. exists chi.
    split; [exact P|]. apply existsb_exists. eauto.
  - intros H [chi [P F]]. apply existsb_exists in F. destruct F as [phi [I F]].
    rewrite (H chi phi P I) in F. discriminate.
Qed.

Corollary question_spec Ks phi :
  satisfiable (question_clauses Ks phi) <->
  exists chi, possible Ks chi = true /\ eval chi phi = true.
Proof.
  unfold question_clauses. rewrite questions_spec. cbn [existsb].
  setoid_rewrite orb_false_r. reflexivity.
Qed.

Corollary question_answered_no Ks phi :
  unsatisfiable (question_clauses Ks phi) <->
  forall chi, possible Ks chi = true -> eval chi phi = false.
Proof.
  unfold question_clauses. rewrite questions_answered_no. split.
  - intros H chi P. apply H; [exact P|left; reflexivity].
  - intros H chi psi P [<-|[]]. exact (H chi P).
Qed.
