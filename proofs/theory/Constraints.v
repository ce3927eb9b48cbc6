(** Constraints ([EXCLUSIVE], [NEVER], [ASSUME]), and the cases in which they are
    broken ([sleec_verify/query/inconsistent_sets.py]). *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment.
Import ListNotations.

(** These literals cannot all be due where all the labels are true. *)
Record clash := Clash { literals : list literal; labels : list (formula fact) }.

Definition here (chi : context) (c : clash) : bool := forallb (eval chi) (labels c).

Definition within (ls : list literal) (c : clash) : bool :=
  forallb (fun l => listed l ls) (literals c).

(** The interpretation makes true what must not be. *)
Definition strikes (v : atom -> bool) (c : clash) : bool :=
  here (context_in v) c && forallb (true_in v) (literals c).

(** * Constraints as clashes *)

Fixpoint pairs (os : list name) : list (name * name) :=
  match os with
  | [] => []
  | o :: rest => map (pair o) (filter (fun p => negb (Pos.eqb o p)) rest) ++ pairs rest
  end.

(** What must not come true. *)
Definition forbidden (k : constraint) : formula atom :=
  match k with
  | Exclusive os =>
      disj (map (fun p => And (Atom (Done (fst p))) (Atom (Done (snd p)))) (pairs os))
  | Never f => f
  | Assume _ => Truth false
  end.

Definition assumed (k : constraint) : formula fact :=
  match k with Assume f => f | _ => Truth true end.

Definition respects (Ks : list constraint) (v : atom -> bool) : Prop :=
  forall k, In k Ks -> eval v (forbidden k) = false.

(** Contexts that break an [Assume] do not count. *)
Definition possible (Ks : list constraint) (chi : context) : bool :=
  forallb (fun k => eval chi (assumed k)) Ks.

Lemma possible_ext Ks chi psi :
  (forall f, chi f = psi f) -> possible Ks chi = possible Ks psi.
Proof.
  intro H. unfold possible. induction Ks as [|k Ks IH]; [reflexivity|]. cbn [forallb].
  rewrite IH, (eval_ext chi psi _ H). reflexivity.
Qed.

Lemma in_pairs o p os : In (o, p) (pairs os) -> In o os /\ In p os /\ o <> p.
Proof.
  induction os as [|q os IH]; simpl; [tauto|]. intro H. apply in_app_iff in H. destruct H as [H|H].
  - apply in_map_iff in H. destruct H as [x [E F]]. injection E as -> ->.
    apply filter_In in F. destruct F as [I N]. apply negb_true_iff, Pos.eqb_neq in N. auto.
  - tauto.
Qed.

Lemma pairs_complete o p os :
  In o os -> In p os -> o <> p -> In (o, p) (pairs os) \/ In (p, o) (pairs os).
Proof.
  induction os as [|q os IH]; simpl; [tauto|]. intros I J N. rewrite !in_app_iff.
  assert (X : forall x, In x os -> q <> x ->
              In (q, x) (map (pair q) (filter (fun y => negb (Pos.eqb q y)) os))).
  { intros x Y Z. apply in_map, filter_In. split; [exact Y|].
    apply negb_true_iff, Pos.eqb_neq, Z. }
  destruct I as [->|I], J as [->|J]; [congruence| | |]; auto 6.
  destruct (IH I J N); auto.
Qed.

(** [EXCLUSIVE] means what it says: never two of these together. *)
Theorem exclusive_meaning v os :
  eval v (forbidden (Exclusive os)) = false <->
  forall o p, In o os -> In p os -> o <> p -> v (Done o) && v (Done p) = false.
Proof.
  unfold forbidden. rewrite eval_disj, existsb_map, <- not_true_iff_false, existsb_exists. split.
  - intros H o p I J N. apply not_true_is_false. intro T. apply H.
    destruct (pairs_complete o p os I J N) as [P|P].
    + exists (o, p). auto.
    + exists (p, o). simpl. rewrite andb_comm. auto.
  - intros H [[o p] [P T]]. apply in_pairs in P. destruct P as [I [J N]].
    simpl in T. rewrite (H o p I J N) in T. discriminate.
Qed.

(** ** Formulas as lists of clashes: their cases *)

(** Parts about situations only are not decomposed. *)
Fixpoint situation_only (f : formula atom) : option (formula fact) :=
  match f with
  | Truth b => Some (Truth b)
  | Atom (Fact x) => Some (Atom x)
  | Atom (Done _) => None
  | Not g => option_map Not (situation_only g)
  | And g h =>
      match situation_only g, situation_only h with
      | Some g', Some h' => Some (And g' h')
      | _, _ => None
      end
  | Or g h =>
      match situation_only g, situation_only h with
      | Some g', Some h' => Some (Or g' h')
      | _, _ => None
      end
  end.

Lemma situation_only_eval v f g :
  situation_only f = Some g -> eval v f = eval (context_in v) g.
Proof.
  revert g. induction f as [b|[x|o]|f IH|f IHf h IHh|f IHf h IHh]; intros g E; simpl in E.
  - injection E as <-. reflexivity.
  - injection E as <-. reflexivity.
  - discriminate.
  - destruct (situation_only f); [|discriminate]. injection E as <-. simpl.
    rewrite (IH _ eq_refl). reflexivity.
  - destruct (situation_only f), (situation_only h); try discriminate. injection E as <-.
    simpl. rewrite (IHf _ eq_refl), (IHh _ eq_refl). reflexivity.
  - destruct (situation_only f), (situation_only h); try discriminate. injection E as <-.
    simpl. rewrite (IHf _ eq_refl), (IHh _ eq_refl). reflexivity.
Qed.

Definition formula_eq_dec (f g : formula fact) : {f = g} + {f <> g}.
Proof. repeat decide equality. Defined.

Definition union {A} (dec : forall x y : A, {x = y} + {x <> y}) (xs ys : list A) : list A :=
  xs ++ filter (fun y => if in_dec dec y xs then false else true) ys.

Lemma in_union {A} dec (x : A) xs ys : In x (union dec xs ys) <-> In x xs \/ In x ys.
Proof.
  unfold union. rewrite in_app_iff, filter_In. split; [tauto|].
  intros [I|I]; [auto|]. destruct (in_dec dec x xs) as [Y|N]; [auto|].
  right. split; [exact I|]. destruct (in_dec dec x xs); [contradiction|reflexivity].
Qed.

Lemma forallb_union {A} dec (f : A -> bool) xs ys :
  forallb f (union dec xs ys) = forallb f xs && forallb f ys.
Proof.
  apply Bool.eq_true_iff_eq. rewrite andb_true_iff, !forallb_forall.
  setoid_rewrite in_union. intuition.
Qed.

Definition merge (c d : clash) : clash :=
  Clash (union literal_eq_dec (literals c) (literals d))
        (union formula_eq_dec (labels c) (labels d)).

Definition product (cs ds : list clash) : list clash :=
  flat_map (fun c => map (merge c) ds) cs.

(** The cases in which [f] has this value. *)
Fixpoint cases (value : bool) (f : formula atom) : list clash :=
  match situation_only f with
  | Some g => [Clash [] [if value then g else Not g]]
  | None =>
      match f with
      | Atom (Done o) => [Clash [if value then Do o else Avoid o] []]
      | Not g => cases (negb value) g
      | And g h =>
          if value then product (cases true g) (cases true h) else cases false g ++ cases false h
      | Or g h =>
          if value then cases true g ++ cases true h else product (cases false g) (cases false h)
      | _ => []
      end
  end.

Lemma strikes_merge v c d : strikes v (merge c d) = strikes v c && strikes v d.
Proof.
  unfold strikes, here, merge. cbn [literals labels]. rewrite !forallb_union.
  destruct (forallb _ (labels c)), (forallb _ (labels d)), (forallb _ (literals c)); auto with bool.
Qed.

Lemma strikes_product v cs ds :
  existsb (strikes v) (product cs ds) = existsb (strikes v) cs && existsb (strikes v) ds.
Proof.
  unfold product. induction cs as [|c cs IH]; [reflexivity|].
  cbn [flat_map existsb]. rewrite existsb_app, existsb_map, IH, andb_orb_distrib_l. f_equal.
  clear. induction ds as [|d ds IH]; simpl; [rewrite andb_false_r; reflexivity|].
  rewrite IH, strikes_merge, andb_orb_distrib_r. reflexivity.
Qed.

Lemma cases_spec v f value :
  existsb (strikes v) (cases value f) = Bool.eqb (eval v f) value.
Proof.
  assert (S : forall f g (value : bool), situation_only f = Some g ->
              existsb (strikes v) [Clash [] [if value then g else Not g]]
              = Bool.eqb (eval v f) value).
  { clear. intros f g value E. rewrite (situation_only_eval v f g E).
    unfold strikes, here. simpl. rewrite !andb_true_r, orb_false_r.
    destruct value; simpl; destruct (eval (context_in v) g); reflexivity. }
  revert value. induction f as [b|[x|o]|f IH|f IHf h IHh|f IHf h IHh]; intro value;
    cbn [cases];
    match goal with |- context [situation_only ?x] => destruct (situation_only x) as [g|] eqn:E end;
    try (apply S; exact E); try discriminate E.
  - unfold strikes, here. simpl.
    destruct value; unfold true_in; simpl; destruct (v (Done o)); reflexivity.
  - rewrite IH. simpl. destruct (eval v f), value; reflexivity.
  - destruct value; rewrite ?strikes_product, ?existsb_app, IHf, IHh; simpl;
      destruct (eval v f), (eval v h); reflexivity.
  - destruct value; rewrite ?strikes_product, ?existsb_app, IHf, IHh; simpl;
      destruct (eval v f), (eval v h); reflexivity.
Qed.

Definition constraint_clashes (Ks : list constraint) : list clash :=
  flat_map (fun k => cases true (forbidden k)) Ks.

Lemma constraint_clashes_spec Ks v :
  respects Ks v <-> forall c, In c (constraint_clashes Ks) -> strikes v c = false.
Proof.
  unfold respects, constraint_clashes. split.
  - intros H c I. apply in_flat_map in I. destruct I as [k [K I]].
    apply not_true_is_false. intro T.
    assert (X : existsb (strikes v) (cases true (forbidden k)) = true).
    { apply existsb_exists. eauto. }
    rewrite cases_spec, (H k K) in X. discriminate.
  - intros H k K. apply not_true_is_false. intro T.
    assert (X : existsb (strikes v) (cases true (forbidden k)) = true).
    { rewrite cases_spec, T. reflexivity. }
    apply existsb_exists in X. destruct X as [c [I X]].
    rewrite H in X; [discriminate|]. apply in_flat_map. eauto.
Qed.
