(** What rules are made of ([sleec_runtime/model/rules.py]; paper, Section 3.2).

    Three kinds of names are kept apart: triggers, conditions and obligations.
    "It happened" and "it is to be done" are different atoms even where a text
    uses one word for both.  A comparison of a measure with a value is a
    condition; what follows from the order of numbers is an [Assume]. *)

From Coq Require Import List Bool PArith Lia.
Import ListNotations.

Definition name := positive.

(** * Formulas *)

Inductive formula (A : Type) : Type :=
| Truth (b : bool)
| Atom (a : A)
| Not (f : formula A)
| And (f g : formula A)
| Or (f g : formula A).

Arguments Truth {A}.
Arguments Atom {A}.
Arguments Not {A}.
Arguments And {A}.
Arguments Or {A}.

Fixpoint eval {A} (v : A -> bool) (f : formula A) : bool :=
  match f with
  | Truth b => b
  | Atom a => v a
  | Not g => negb (eval v g)
  | And g h => eval v g && eval v h
  | Or g h => eval v g || eval v h
  end.

Fixpoint rename {A B} (h : A -> B) (f : formula A) : formula B :=
  match f with
  | Truth b => Truth b
  | Atom a => Atom (h a)
  | Not g => Not (rename h g)
  | And g k => And (rename h g) (rename h k)
  | Or g k => Or (rename h g) (rename h k)
  end.

Fixpoint atoms_of {A} (f : formula A) : list A :=
  match f with
  | Truth _ => []
  | Atom a => [a]
  | Not g => atoms_of g
  | And g h | Or g h => atoms_of g ++ atoms_of h
  end.

Definition implies {A} (f g : formula A) : formula A := Or (Not f) g.

Fixpoint conj {A} (fs : list (formula A)) : formula A :=
  match fs with
  | [] => Truth true
  | f :: rest => And f (conj rest)
  end.

Fixpoint disj {A} (fs : list (formula A)) : formula A :=
  match fs with
  | [] => Truth false
  | f :: rest => Or f (disj rest)
  end.

Lemma eval_conj {A} (v : A -> bool) fs : eval v (conj fs) = forallb (eval v) fs.
Proof. induction fs; simpl; congruence. Qed.

Lemma eval_disj {A} (v : A -> bool) fs : eval v (disj fs) = existsb (eval v) fs.
Proof. induction fs; simpl; congruence. Qed.

Lemma eval_implies {A} (v : A -> bool) f g :
  eval v (implies f g) = true <-> (eval v f = true -> eval v g = true).
Proof. simpl. destruct (eval v f), (eval v g); simpl; intuition. Qed.

Lemma eval_rename {A B} (h : A -> B) v f :
  eval v (rename h f) = eval (fun a => v (h a)) f.
Proof. induction f; simpl; congruence. Qed.

(** The value of a formula depends on its own atoms only. *)
Lemma eval_on_atoms {A} (v w : A -> bool) f :
  (forall a, In a (atoms_of f) -> v a = w a) -> eval v f = eval w f.
Proof.
  induction f; simpl; intro H; auto.
  - f_equal. auto.
  - rewrite IHf1, IHf2; auto using in_or_app.
  - rewrite IHf1, IHf2; auto using in_or_app.
Qed.

Lemma eval_ext {A} (v w : A -> bool) f :
  (forall a, v a = w a) -> eval v f = eval w f.
Proof. intro H. apply eval_on_atoms. auto. Qed.

(** * Atoms and contexts *)

(** The facts of a situation: triggers and conditions. *)
Inductive fact :=
| Occurs (trigger : name)
| Holds (condition : name).

(** The atoms of an interpretation: facts and obligations. *)
Inductive atom :=
| Fact (f : fact)
| Done (obligation : name).

(** A context χ is total: it says of every trigger whether it occurs and of
    every condition whether it holds. *)
Definition context := fact -> bool.

(** A Boolean combination of conditions and triggers.  A trigger is true if it
    occurs in the same situation. *)
Definition condition := formula fact.

(** χ ⊨ C *)
Definition satisfies (chi : context) (c : condition) : bool := eval chi c.

(** * Literals of obligations *)

(** To be done, or not to be done. *)
Inductive literal :=
| Do (obligation : name)
| Avoid (obligation : name).

Definition about (l : literal) : name :=
  match l with Do o | Avoid o => o end.

Definition opposite (l : literal) : literal :=
  match l with Do o => Avoid o | Avoid o => Do o end.

Definition literal_eqb (l m : literal) : bool :=
  match l, m with
  | Do o, Do p | Avoid o, Avoid p => Pos.eqb o p
  | _, _ => false
  end.

Lemma literal_eqb_eq l m : literal_eqb l m = true <-> l = m.
Proof.
  destruct l, m; simpl; rewrite ?Pos.eqb_eq; split; congruence.
Qed.

Lemma literal_eq_dec (l m : literal) : {l = m} + {l <> m}.
Proof. decide equality; apply Pos.eq_dec. Defined.

Lemma opposite_involutive l : opposite (opposite l) = l.
Proof. destruct l; reflexivity. Qed.

Lemma opposite_different l : opposite l <> l.
Proof. destruct l; discriminate. Qed.

Definition listed (l : literal) (ls : list literal) : bool :=
  existsb (literal_eqb l) ls.

Lemma listed_In l ls : listed l ls = true <-> In l ls.
Proof.
  unfold listed. rewrite existsb_exists. split.
  - intros [m [H E]]. apply literal_eqb_eq in E. congruence.
  - intro H. exists l. rewrite literal_eqb_eq. auto.
Qed.

(** Whether a list holds a literal and its opposite. *)
Definition contradictory (ls : list literal) : bool :=
  existsb (fun l => listed (opposite l) ls) ls.

Lemma contradictory_spec ls :
  contradictory ls = true <-> exists l, In l ls /\ In (opposite l) ls.
Proof.
  unfold contradictory. rewrite existsb_exists.
  split; intros [l H]; exists l; rewrite listed_In in *; auto.
Qed.

Definition formula_of (l : literal) : formula atom :=
  match l with
  | Do o => Atom (Done o)
  | Avoid o => Not (Atom (Done o))
  end.

Definition true_in (v : atom -> bool) (l : literal) : bool := eval v (formula_of l).

Lemma true_in_opposite v l : true_in v (opposite l) = negb (true_in v l).
Proof. destruct l; simpl; unfold true_in; simpl; rewrite ?negb_involutive; reflexivity. Qed.

(** * Rules *)

Record hedge := Hedge {
  hedge_condition : condition;
  hedge_obliges : list literal }.

(** [WHEN trigger AND guard THEN default UNLESS … IN WHICH CASE …].  The paper
    has no guard; [Truth true] is a rule without one.  A hedge without
    [IN WHICH CASE] obliges the empty list.  Labels are the names that people
    give to rules. *)
Record rule := Rule {
  label : name;
  trigger : name;
  rule_guard : condition;
  default : list literal;
  hedges : list hedge }.

Definition ruleset := list rule.

(** What each clause obliges: clause 0 is the default, the others the hedges. *)
Definition clauses (R : rule) : list (list literal) :=
  default R :: map hedge_obliges (hedges R).

Definition clause (R : rule) (i : nat) : list literal := nth i (clauses R) [].

Lemma clauses_length R : length (clauses R) = S (length (hedges R)).
Proof. simpl. rewrite map_length. reflexivity. Qed.

Definition positive_literal (l : literal) : bool :=
  match l with Do _ => true | Avoid _ => false end.

(** The paper's rules: no [NOT] among obligations. *)
Definition positive_rule (R : rule) : Prop :=
  forall i l, In l (clause R i) -> positive_literal l = true.

(** What a list of literals tells to do. *)
Definition to_do (ls : list literal) : list name :=
  flat_map (fun l => match l with Do o => [o] | Avoid _ => [] end) ls.

Lemma in_to_do o ls : In o (to_do ls) <-> In (Do o) ls.
Proof.
  unfold to_do. rewrite in_flat_map. split.
  - intros [[p|p] [H I]]; simpl in I; [destruct I as [->|[]]; assumption | destruct I].
  - intro H. exists (Do o). simpl. auto.
Qed.

(** The two readings of a chain of hedges ([docs/semantics.md]). *)
Inductive reading := Cascade | Priority.

(** * Constraints *)

Inductive constraint :=
| Exclusive (obligations : list name)
| Never (what : formula atom)
| Assume (what : formula fact).
