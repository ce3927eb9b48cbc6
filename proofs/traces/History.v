(** Histories: what a trace that may go on breaks already ([broken_so_far] in
    [sleec_runtime/evaluation/traces.py]).

    The last instant of a history is now, when more may still occur; later instants are
    open.  Each law is looked at by itself. *)

From Coq Require Import List Bool PArith ZArith.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace.
Import ListNotations.
Local Open Scope Z_scope.

(** * Demands *)

(** The ways to satisfy a demand: what has to occur and what must not, all together. *)
Fixpoint ways (d : demand) : list (list occurrence) :=
  match d with
  | Atomic o => [[o]]
  | Every parts => fold_right (fun p rest => flat_map (fun w => map (app w) rest) (ways p)) [[]] parts
  | Either parts => flat_map ways parts
  end.

Definition forbids (since : Z) (e : name) (at_ : Z) (o : occurrence) : bool :=
  negb (positive_literal (what o)) && Pos.eqb (about (what o)) e && covers o since at_.

(** The times at which an event may become possible: when its window opens, or after the
    end of a prohibition. *)
Definition candidates (now since : Z) (way : list occurrence) (o : occurrence) : list Z :=
  Z.max now (since + first o)
    :: flat_map (fun o' => match final o' with Some last => [since + last + 1] | None => [] end) way.

(** There is a time from [now] on for an event that a way asks for. *)
Definition room (now since : Z) (way : list occurrence) (o : occurrence) : bool :=
  existsb (fun at_ => (now <=? at_) && covers o since at_
                      && negb (existsb (forbids since (about (what o)) at_) way))
          (candidates now since way o).

Definition way_open (h : trace) (now since : Z) (way : list occurrence) : bool :=
  forallb (fun o => if positive_literal (what o)
                    then occurs h since o || room now since way o
                    else negb (occurs h since o)) way.

(** What has occurred so far, and what may from [now] on, can satisfy a demand. *)
Definition demand_open (h : trace) (now since : Z) (d : demand) : bool :=
  existsb (way_open h now since) (ways d).

(** * Laws *)

Definition with_events (i : instant) (more : name -> bool) : instant :=
  Instant (time i) (fun e => events i e || more e) (conditions i) (lengths i).

Definition events_in (f : formula fact) : list name :=
  flat_map (fun x => match x with Occurs e => [e] | Holds _ => [] end) (atoms_of f).

(** A formula holds at now, with whatever else occurs then. *)
Definition can_hold (i : instant) (f : formula fact) : bool :=
  existsb (fun more => eval (context_of (with_events i more)) f)
          (valuations (nodup Pos.eq_dec (events_in f))).

Fixpoint lasts_so_far (over p now : instant -> bool) (from : trace) : bool :=
  match from with
  | [] => true
  | [i] => now i
  | i :: later => over i || (p i && lasts_so_far over p now later)
  end.

(** A relation can still be kept at the instant [i] of the history [earlier ++ i :: later]. *)
Definition relation_open (earlier : trace) (i : instant) (later : trace) (rel : relation) : bool :=
  match rel, later with
  | Until e c p stop d, _ =>
      let ending := And (occurring stop) (situation_of d) in
      implb (begins e c i)
            (lasts_so_far (begins stop d) (fun j => in_state j p)
                          (fun j => can_hold j (Or (situation_of p) ending)) (i :: later))
  | HappenBefore _ _, _ | For _ _ _ _, _ | _, _ :: _ => relation_kept earlier i later rel
  | _, [] => can_hold i (invariant rel)
  end.

(** The events that the conditions of a rule name. *)
Fixpoint response_events (R : response) : list name :=
  match R with Response _ _ alternatives => flat_map (fun a => chain_events (snd a)) alternatives end
with chain_events (c : timed_chain) : list name :=
  match c with
  | TimedChain all inner =>
      flat_map response_events all ++ flat_map (fun h => events_in (fst h) ++ chain_events (snd h)) inner
  end.

Definition rule_events (R : timed_rule) : list name :=
  events_in (timed_guard R) ++ chain_events (timed_response R).

Definition rule_open (r : reading) (u : untimed) (h : trace) (now : Z) (i : instant) (R : timed_rule)
  (more : list demand) : bool :=
  implb (is_triggered i R) (demand_open h now (time i) (Every (rule_demand r u i R :: more))).

(** These events do not occur at the instant of the trigger. *)
Definition absent (i : instant) (es : list name) : list demand :=
  map (fun e => Atomic (Occurrence (Avoid e) 0 (Some 0))) (filter (fun e => negb (events i e)) es).

(** What else occurs now can decide a rule's conditions: each case is looked at. *)
Definition law_open (r : reading) (u : untimed) (earlier : trace) (i : instant) (later : trace) (k : law)
  : bool :=
  match k, later with
  | RuleLaw R, [] =>
      let es := nodup Pos.eq_dec (rule_events R) in
      existsb (fun more => let i' := with_events i more in
                           rule_open r u (earlier ++ [i']) (time i) i' R (absent i' es))
              (valuations es)
  | RuleLaw R, _ => rule_open r u (earlier ++ i :: later) (time (last later i)) i R []
  | RelationLaw rel, _ => relation_open earlier i later rel
  end.

(** For each instant, which laws a history breaks there whatever comes, by their places. *)
Definition broken_so_far (r : reading) (u : untimed) (laws : list law) (h : trace) : list (list bool) :=
  map (fun m => let '(earlier, i, later) := m in
                map (fun k => negb (law_open r u earlier i later k)) laws)
      (moments [] h).
