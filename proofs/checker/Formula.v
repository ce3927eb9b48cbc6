(** Formulas in conjunctive normal form, and what it means that one is unsatisfiable. This file is the statement that
    the checker is proved against: nothing else needs to be read to know what its answer says. *)

From Coq Require Import List PArith Bool.
Import ListNotations.

(** Variables are numbered from 1, as in DIMACS. *)
Inductive literal := Pos (variable : positive) | Neg (variable : positive).

Definition clause := list literal.
Definition formula := list clause.

Definition negate (l : literal) : literal :=
  match l with Pos v => Neg v | Neg v => Pos v end.

(** An assignment is total: every variable is true or false. *)
Definition assignment := positive -> bool.

Definition true_in (a : assignment) (l : literal) : bool :=
  match l with Pos v => a v | Neg v => negb (a v) end.

(** A clause is a disjunction: the empty one is true nowhere. *)
Definition satisfies (a : assignment) (c : clause) : Prop :=
  exists l, In l c /\ true_in a l = true.

Definition model (a : assignment) (f : formula) : Prop :=
  forall c, In c f -> satisfies a c.

Definition unsatisfiable (f : formula) : Prop :=
  forall a, ~ model a f.
