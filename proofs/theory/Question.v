(** A question over all contexts ([sleec_verify/question.py]): is there one, among
    those that can be, in which a formula is true?  And its clauses. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Clauses Cnf Clashes.
Import ListNotations.

Definition question_clauses (Ks : list constraint) (phi : formula fact) : cnf :=
  let (x, s1) := build_fact phi start in
  let (ys, s2) := build_facts (map assumed Ks) s1 in
  [x] :: map (fun y => [y]) ys ++ built s2.

Lemma units_true_iff a (ys : list lit) :
  forallb (clause_true a) (map (fun y => [y]) ys) = forallb (lit_true a) ys.
Proof.
  rewrite forallb_map. induction ys as [|y ys IH]; [reflexivity|]. cbn [forallb].
  rewrite IH. unfold clause_true. cbn [existsb]. rewrite orb_false_r. reflexivity.
Qed.

Lemma question_gates Ks phi :
  exists s (value : (positive -> bool) -> bool),
    extends start s /\
    (forall a, cnf_true a (built s) = true ->
       value a = possible Ks (facts_in a) && eval (facts_in a) phi) /\
    (forall a, cnf_true a (question_clauses Ks phi) = cnf_true a (built s) && value a).
Proof.
  unfold question_clauses, build_fact, build_facts. pose proof start_sound as S.
  pose proof (build_gives fact fact_number fact_number_even phi start) as P.
  destruct (build fact fact_number phi start) as [x s1].
  pose proof (build_all_gives fact fact_number fact_number_even (map assumed Ks) s1) as Y.
  destruct (build_all fact fact_number (map assumed Ks) s1) as [ys s2].
  destruct (P S) as [X1 [_ [V _]]]. destruct (Y (extends_sound _ _ X1 S)) as [X2 [_ [W _]]].
  exists s2, (fun a => lit_true a x && forallb (lit_true a) ys). split; [|split].
  - eapply extends_trans; eauto.
  - intros a A. rewrite (V a) by (eapply extends_true; eauto). rewrite andb_comm. f_equal.
    rewrite <- (forallb_map id (lit_true a)), (W a A), !forallb_map. reflexivity.
  - intro a. unfold cnf_true at 1. cbn [forallb]. rewrite forallb_app, units_true_iff.
    unfold clause_true at 1. cbn [existsb]. rewrite orb_false_r. fold (cnf_true a (built s2)).
    destruct (lit_true a x), (forallb (lit_true a) ys), (cnf_true a (built s2)); reflexivity.
Qed.

(** The clauses are satisfiable exactly if the answer is yes, and a model is such a
    context. *)
Theorem question_spec Ks phi :
  satisfiable (question_clauses Ks phi) <->
  exists chi, possible Ks chi = true /\ eval chi phi = true.
Proof.
  destruct (question_gates Ks phi) as [s [value [[_ [_ [_ E]]] [V T]]]]. split.
  - intros [a A]. rewrite T, andb_true_iff in A. destruct A as [B X].
    rewrite (V a B), andb_true_iff in X. exists (facts_in a). exact X.
  - intros [chi [P F]].
    destruct (E start_sound (assignment_of (interpretation chi (fun _ => false)))) as [a [A B]];
      [reflexivity|].
    assert (X : forall f, facts_in a f = chi f).
    { intro f. unfold facts_in. rewrite A.
      - unfold assignment_of. rewrite atom_of_number. reflexivity.
      - destruct f; exact I. }
    exists a. rewrite T, B, (V a B), (possible_ext Ks _ chi X), P, (eval_ext _ chi phi X), F.
    reflexivity.
Qed.

(** They are unsatisfiable exactly if it is no. *)
Theorem question_answered_no Ks phi :
  unsatisfiable (question_clauses Ks phi) <->
  forall chi, possible Ks chi = true -> eval chi phi = false.
Proof.
  rewrite unsatisfiable_iff, question_spec. split.
  - intros N chi P. apply not_true_is_false. intro F. apply N. eauto.
  - intros H [chi [P F]]. rewrite (H chi P) in F. discriminate.
Qed.
