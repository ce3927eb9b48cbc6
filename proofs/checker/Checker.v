(** A checker of refutations: LRAT without RAT steps. Each step adds a clause that unit propagation along its hints
    shows to follow, or forgets clauses; a refutation adds the empty clause.

    The proofs are in [Soundness.v]. What is here is extracted to OCaml, and also runs inside Coq. *)

From Coq Require Import List PArith Bool FMapPositive.
From Checker Require Import Formula.
Import ListNotations.

Module Map := PositiveMap.

(** Steps name clauses by number. The clauses of the formula have the numbers from 1. *)
Inductive step :=
  | Add (number : positive) (c : clause) (hints : list positive)
  | Forget (numbers : list positive).

Inductive answer :=
  | Verified                          (** the formula is unsatisfiable *)
  | Refused (number : positive)       (** the step that adds this clause does not follow from its hints *)
  | Unfinished.                       (** no step adds the empty clause *)

(** What is known of the variables while hints are followed. *)
Definition partial := Map.t bool.

Definition value (p : partial) (l : literal) : option bool :=
  match l with
  | Pos v => Map.find v p
  | Neg v => option_map negb (Map.find v p)
  end.

Definition make_true (p : partial) (l : literal) : partial :=
  match l with
  | Pos v => Map.add v true p
  | Neg v => Map.add v false p
  end.

Definition is_false (p : partial) (l : literal) : bool :=
  match value p l with Some false => true | _ => false end.

(** What a clause says under what is known. [Open] ones say nothing yet: they are satisfied, or leave a choice. *)
Inductive outcome := Broken | Unit (l : literal) | Open.

Fixpoint outcome_of (p : partial) (c : clause) : outcome :=
  match c with
  | [] => Broken
  | l :: rest =>
      match value p l with
      | Some false => outcome_of p rest
      | Some true => Open
      | None => if forallb (is_false p) rest then Unit l else Open
      end
  end.

Definition clauses := Map.t clause.

(** Whether the hints, each of them a unit under what came before, lead to a clause that is broken. *)
Fixpoint leads_to_conflict (known : clauses) (p : partial) (hints : list positive) : bool :=
  match hints with
  | [] => false
  | hint :: rest =>
      match Map.find hint known with
      | None => false
      | Some c =>
          match outcome_of p c with
          | Broken => true
          | Unit l => leads_to_conflict known (make_true p l) rest
          | Open => false
          end
      end
  end.

(** Every literal of a clause made false: where the search for a contradiction begins. *)
Definition all_false (c : clause) : partial :=
  fold_left (fun p l => make_true p (negate l)) c (Map.empty bool).

Definition forget (known : clauses) (numbers : list positive) : clauses :=
  fold_left (fun known number => Map.remove number known) numbers known.

Fixpoint run (known : clauses) (steps : list step) : answer :=
  match steps with
  | [] => Unfinished
  | Forget numbers :: rest => run (forget known numbers) rest
  | Add number c hints :: rest =>
      if leads_to_conflict known (all_false c) hints then
        match c with
        | [] => Verified
        | _ => run (Map.add number c known) rest
        end
      else Refused number
  end.

Fixpoint numbered (known : clauses) (next : positive) (f : formula) : clauses :=
  match f with
  | [] => known
  | c :: rest => numbered (Map.add next c known) (Pos.succ next) rest
  end.

(** Whether these steps refute the formula. *)
Definition check (f : formula) (steps : list step) : answer :=
  run (numbered (Map.empty clause) 1 f) steps.
