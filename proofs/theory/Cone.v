(** Cutting to the cone of influence ([sleec_verify/query/cone.py]; issue 5, theorem 5,
    second half): a question about one obligation concerns the rules that mention it,
    and their conditions. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings Clauses Cnf Clashes Conflict.
Import ListNotations.

(** * The cone of some obligations *)

Definition mentions (os : list name) (R : rule) : bool :=
  existsb (existsb (fun l => if in_dec Pos.eq_dec (about l) os then true else false)) (clauses R).

Definition cone (os : list name) (G : ruleset) : ruleset := filter (mentions os) G.

Lemma mentions_clause os R i l : In l (clause R i) -> In (about l) os -> mentions os R = true.
Proof.
  intros I M. unfold mentions. apply existsb_exists. exists (clause R i). split.
  - unfold clause in *. destruct (nth_in_or_default i (clauses R) []) as [J|J]; [exact J|].
    rewrite J in I. destruct I.
  - apply existsb_exists. exists l. split; [exact I|].
    destruct (in_dec _ _ _); [reflexivity|contradiction].
Qed.

Theorem cone_due r G chi os l :
  In (about l) os -> In l (due r (cone os G) chi) <-> In l (due r G chi).
Proof.
  intro M. rewrite !in_due. split.
  - intros [R [I H]]. apply filter_In in I. exists R. tauto.
  - intros [R [I [T L]]]. exists R. split; [|auto]. apply filter_In. split; [exact I|].
    eapply mentions_clause; eauto.
Qed.

Lemma cone_consistent r G chi os : consistent r G chi -> consistent r (cone os G) chi.
Proof.
  intro C. apply consistent_spec. intros l I J.
  assert (S : forall m, In m (due r (cone os G) chi) -> In m (due r G chi)).
  { intros m M. apply in_due in M. destruct M as [R [IR M]]. apply filter_In in IR.
    apply in_due. exists R. tauto. }
  exact (proj1 (consistent_spec r G chi) C l (S _ I) (S _ J)).
Qed.

(** What the cone entails, the ruleset does. *)
Theorem cone_sound r G chi os phi : entails r (cone os G) chi phi -> entails r G chi phi.
Proof.
  intros E v A M. apply E; [exact A|]. intros R I. apply filter_In in I. apply M, I.
Qed.

(** The cone of an obligation gives the ruleset's answer about it. *)
Theorem cone_preserves r G chi l :
  consistent r G chi ->
  entails_literal r (cone [about l] G) chi l <-> entails_literal r G chi l.
Proof.
  intro C. rewrite (entailed_iff_due r G chi l C).
  rewrite (entailed_iff_due r (cone [about l] G) chi l (cone_consistent r G chi _ C)).
  apply cone_due. left. reflexivity.
Qed.

(** Without consistency the ruleset entails everything, and the cone may not: this is
    all that can be lost. *)
Theorem cone_exact r G chi l :
  entails_literal r G chi l <->
  entails_literal r (cone [about l] G) chi l \/ contradictory (due r G chi) = true.
Proof.
  split.
  - intro E. destruct (contradictory (due r G chi)) eqn:C; [auto|].
    left. apply cone_preserves; [exact C|exact E].
  - intros [E|C]; [eapply cone_sound; exact E|apply contradiction_entails_all, C].
Qed.

Theorem cone_needs_consistency :
  exists G chi l, entails_literal Cascade G chi l /\
                  ~ entails_literal Cascade (cone [about l] G) chi l.
Proof.
  exists [Rule 1 1 (Truth true) [Do 1; Avoid 1] []]%positive, (fun _ => true), (Do 2%positive). split.
  - apply contradiction_entails_all. reflexivity.
  - intro E. apply entails_by_propagation_correct in E. discriminate.
Qed.

(** * Nor does the rest of the context matter *)

Lemma due_of_on_facts r chi psi R :
  (forall f, In f (facts_of_rule R) -> chi f = psi f) -> due_of r chi R = due_of r psi R.
Proof.
  intro H. unfold facts_of_rule in H.
  assert (T : triggered chi R = triggered psi R).
  { rewrite <- !eval_c0. apply eval_on_atoms. intros f I. apply H, in_app_iff. auto. }
  assert (B : truths chi R = truths psi R).
  { rewrite <- !eval_conditions. apply map_ext_in. intros c I. apply eval_on_atoms.
    intros f J. apply H, in_app_iff. right. apply in_flat_map. eauto. }
  unfold due_of, active. rewrite T, B. reflexivity.
Qed.

Lemma due_on_facts r chi psi G :
  (forall f, In f (facts_of G) -> chi f = psi f) -> due r G chi = due r G psi.
Proof.
  unfold due, facts_of. induction G as [|R G IH]; intro H; [reflexivity|]. cbn [flat_map] in *.
  rewrite (due_of_on_facts r chi psi R), IH; [reflexivity| |];
    intros; apply H, in_app_iff; auto.
Qed.

(** Contexts that agree on the facts of the cone have the same answer. *)
Theorem cone_context r G chi psi l :
  (forall f, In f (facts_of (cone [about l] G)) -> chi f = psi f) ->
  consistent r G chi -> consistent r G psi ->
  entails_literal r G chi l <-> entails_literal r G psi l.
Proof.
  intros H C D. rewrite <- (cone_preserves r G chi l C), <- (cone_preserves r G psi l D).
  rewrite !entailed_iff_due by (apply cone_consistent; assumption).
  rewrite (due_on_facts r chi psi _ H). reflexivity.
Qed.

(** * A question over all contexts *)

(** A clash needs the rules that mention its obligations, and no others. *)
Theorem clash_cone r G chi c :
  within (due r (cone (map about (literals c)) G) chi) c = within (due r G chi) c.
Proof.
  unfold within. apply Bool.eq_true_iff_eq. rewrite !forallb_forall.
  split; intros H l I; specialize (H l I); rewrite listed_In in *;
    (eapply cone_due; [apply in_map, I|exact H]) || (apply cone_due in H; [exact H|apply in_map, I]).
Qed.

(** Formulas that share no names can be asked apart. *)
Theorem disjoint_satisfiable {A} (dec : forall x y : A, {x = y} + {x <> y}) (f g : formula A) :
  (forall x, In x (atoms_of f) -> ~ In x (atoms_of g)) ->
  (exists v, eval v f = true /\ eval v g = true) <->
  (exists v, eval v f = true) /\ (exists v, eval v g = true).
Proof.
  intro D. split.
  - intros [v [F G]]. eauto.
  - intros [[v F] [w G]].
    exists (fun x => if in_dec dec x (atoms_of f) then v x else w x). split.
    + rewrite <- F. apply eval_on_atoms. intros x I.
      destruct (in_dec dec x (atoms_of f)); [reflexivity|contradiction].
    + rewrite <- G. apply eval_on_atoms. intros x I.
      destruct (in_dec dec x (atoms_of f)) as [J|]; [destruct (D x J I)|reflexivity].
Qed.

Definition fact_eq_dec (f g : fact) : {f = g} + {f <> g}.
Proof. decide equality; apply Pos.eq_dec. Defined.

(** Assumptions that share no names with a question, and that some context meets, can
    be left out of it. *)
Theorem assumptions_cut (question : formula fact) (near far : list (formula fact)) :
  (forall x, In x (atoms_of (And question (conj near))) -> ~ In x (atoms_of (conj far))) ->
  (exists chi, forallb (eval chi) far = true) ->
  (exists chi, eval chi question = true /\ forallb (eval chi) (near ++ far) = true) <->
  (exists chi, eval chi question = true /\ forallb (eval chi) near = true).
Proof.
  intros D [psi F]. rewrite <- eval_conj in F. split.
  - intros [chi [Q N]]. rewrite forallb_app, andb_true_iff in N. exists chi. tauto.
  - intros [chi [Q N]].
    destruct (proj2 (disjoint_satisfiable fact_eq_dec (And question (conj near)) (conj far) D))
      as [w [X Y]].
    + split; [exists chi; cbn [eval]; rewrite eval_conj, Q, N; reflexivity|eauto].
    + cbn [eval] in X. apply andb_true_iff in X. destruct X as [X1 X2].
      exists w. rewrite forallb_app, <- !eval_conj, X1, X2, Y. auto.
Qed.

(** So the question of one clash is decided by its cone: the rules that mention its
    obligations and the assumptions that share names with them. *)
Theorem clash_question_cut r G c (near far : list (formula fact)) :
  let question H := clash_formula r H c in
  let cut := cone (map about (literals c)) G in
  (forall x, In x (atoms_of (And (question cut) (conj near))) -> ~ In x (atoms_of (conj far))) ->
  (exists chi, forallb (eval chi) far = true) ->
  (exists chi, eval chi (question G) = true /\ forallb (eval chi) (near ++ far) = true) <->
  (exists chi, eval chi (question cut) = true /\ forallb (eval chi) near = true).
Proof.
  intros question cut D F.
  assert (E : forall chi, eval chi (question G) = eval chi (question cut)).
  { intro chi. unfold question, cut. rewrite !clash_formula_value, clash_cone. reflexivity. }
  rewrite <- (assumptions_cut (question cut) near far D F).
  split; intros [chi [Q N]]; exists chi; rewrite E in *; auto.
Qed.
