(** Traces, and demands: formulas of metric temporal logic over one instant
    ([sleec_verify/traces/demands.py]). *)

From Coq Require Import List Bool PArith ZArith.
From Sleec Require Import Model.
Import ListNotations.
Local Open Scope Z_scope.

(** * Traces *)

(** What occurs at one time, what holds then, and what the measures are worth that say
    how long a window is. *)
Record instant := Instant {
  time : Z;
  events : name -> bool;
  conditions : name -> bool;
  lengths : name -> Z }.

(** The earliest instant comes first ([ordered] in [Continuation.v]). *)
Definition trace := list instant.

Definition context_of (i : instant) : context := fun f =>
  match f with
  | Occurs e => events i e
  | Holds c => conditions i c
  end.

(** To be obliged is to occur. *)
Definition event_of (a : atom) : fact :=
  match a with
  | Fact f => f
  | Done o => Occurs o
  end.

(** * Demands *)

(** The event occurs ([Do]), or does not occur ([Avoid]), at some time in a window.  The
    bounds are seconds after the trigger; without [final] the window has no end. *)
Record occurrence := Occurrence { what : literal; first : Z; final : option Z }.

Inductive demand :=
| Atomic (o : occurrence)
| Every (parts : list demand)
| Either (parts : list demand).

(** Whether the window of a trigger at [since] covers a time. *)
Definition covers (o : occurrence) (since at_ : Z) : bool :=
  (since + first o <=? at_)
  && match final o with
     | None => true
     | Some last => at_ <=? since + last
     end.

Definition occurs (tr : trace) (since : Z) (o : occurrence) : bool :=
  existsb (fun i => events i (about (what o)) && covers o since (time i)) tr.

Definition met (tr : trace) (since : Z) (o : occurrence) : bool :=
  if positive_literal (what o) then occurs tr since o else negb (occurs tr since o).

Fixpoint satisfied (tr : trace) (since : Z) (d : demand) : bool :=
  match d with
  | Atomic o => met tr since o
  | Every parts => forallb (satisfied tr since) parts
  | Either parts => existsb (satisfied tr since) parts
  end.
