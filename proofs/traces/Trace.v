(** What rules with time, relations and claims ask of traces ([sleec_runtime/evaluation/traces.py],
    [docs/times.md]).

    The trigger and the obligation of one name are one event.  Times are whole seconds.
    A guard, or the condition of a hedge, may name events as well as conditions.
    A comparison of a measure with a value is a condition. *)

From Coq Require Import List Bool PArith ZArith.
From Sleec Require Import Model Evaluation Constraints.
From Traces Require Export Demand.
Import ListNotations.
Local Open Scope Z_scope.

(** * Rules *)

(** A length of time: so many seconds, or as many as a measure says at the trigger. *)
Inductive bound :=
| Seconds (s : Z)
| Measured (m : name).

(** [within [opens, closes]]; without [closes], [eventually]. *)
Record window := Window { opens : bound; closes : option bound }.

(** What may be done in place of a response: after its window, or in the same time. *)
Inductive place := Otherwise | Else.

Inductive response :=
| Response (l : literal) (w : option window) (alternatives : list (place * timed_chain))
with timed_chain :=
| TimedChain (all : list response) (inner : list (formula fact * timed_chain)).

Record timed_rule := TimedRule {
  timed_trigger : name;
  timed_guard : formula fact;
  timed_response : timed_chain }.

(** When a response without a window is due: at the instant of the trigger, or at some
    time from then on. *)
Inductive untimed := At | Eventually.

Definition seconds (i : instant) (b : bound) : Z :=
  match b with
  | Seconds s => s
  | Measured m => lengths i m
  end.

(** A response that is due from [after] seconds after the trigger on. *)
Definition occurrence_of (u : untimed) (i : instant) (after : Z) (l : literal) (w : option window)
  : occurrence :=
  match w with
  | Some w' =>
      Occurrence l (after + seconds i (opens w'))
                 (option_map (fun b => after + seconds i b) (closes w'))
  | None => Occurrence l after (match u with At => Some after | Eventually => None end)
  end.

(** From when on a response in place of another one is due. *)
Definition placed (after : Z) (w : option window) (o : occurrence) (p : place) : Z :=
  match p, w, final o with
  | Otherwise, Some _, Some last => last
  | _, _, _ => after
  end.

(** What a response demands where [i] is the instant of its trigger, whose conditions
    decide the hedges and whose measures give the lengths. *)
Fixpoint demand_of (r : reading) (u : untimed) (i : instant) (after : Z) (R : response) : demand :=
  match R with
  | Response l w alternatives =>
      let o := occurrence_of u i after l w in
      match alternatives with
      | [] => Atomic o
      | _ =>
          Either (Atomic o :: map (fun a => chain_demand r u i (placed after w o (fst a)) (snd a))
                                  alternatives)
      end
  end
with chain_demand (r : reading) (u : untimed) (i : instant) (after : Z) (c : timed_chain) : demand :=
  match c with
  | TimedChain all inner =>
      nth (decides r (map (fun h => eval (context_of i) (fst h)) inner))
          (Every (map (demand_of r u i after) all)
             :: map (fun h => chain_demand r u i after (snd h)) inner)
          (Every [])
  end.

Definition is_triggered (i : instant) (R : timed_rule) : bool :=
  events i (timed_trigger R) && eval (context_of i) (timed_guard R).

Definition rule_demand (r : reading) (u : untimed) (i : instant) (R : timed_rule) : demand :=
  chain_demand r u i 0 (timed_response R).

(** The rule is kept at one instant of a trace. *)
Definition rule_kept (r : reading) (u : untimed) (tr : trace) (i : instant) (R : timed_rule) : bool :=
  implb (is_triggered i R) (satisfied tr (time i) (rule_demand r u i R)).

(** * Relations *)

(** A Boolean combination of conditions; relations mention no events in them. *)
Definition state := formula name.

Definition situation_of (c : state) : formula fact := rename Holds c.

Definition in_state (i : instant) (c : state) : bool := eval (conditions i) c.

Lemma eval_situation_of i c : eval (context_of i) (situation_of c) = in_state i c.
Proof. unfold situation_of, in_state. rewrite eval_rename. reflexivity. Qed.

Inductive relation :=
| Witness (a b : name)
| Equal (a b : name)
| MutuallyExclusive (a b : name)
| HappenBefore (a b : name)
| Imply (p q : state)
| Iff (p q : state)
| NotBoth (p q : state)
| Invariant (p : state)
| Causation (e : name) (p : state)
| Includes (e : name) (p : state)
| Forbid (e : name) (p : state)
| Until (e : name) (c p : state) (stop : name) (d : state)
| For (e : name) (c p : state) (length : bound)
| Stated (k : constraint).

Definition occurring (e : name) : formula fact := Atom (Occurs e).
Definition iff_ {A} (f g : formula A) : formula A := And (implies f g) (implies g f).
Definition not_both {A} (f g : formula A) : formula A := Not (And f g).

(** What a relation says of every instant by itself. *)
Definition invariant (rel : relation) : formula fact :=
  match rel with
  | Witness a b => implies (occurring a) (occurring b)
  | Equal a b => iff_ (occurring a) (occurring b)
  | MutuallyExclusive a b => not_both (occurring a) (occurring b)
  | Imply p q => implies (situation_of p) (situation_of q)
  | Iff p q => iff_ (situation_of p) (situation_of q)
  | NotBoth p q => not_both (situation_of p) (situation_of q)
  | Invariant p => situation_of p
  | Causation e p => implies (situation_of p) (occurring e)
  | Includes e p => implies (occurring e) (situation_of p)
  | Forbid e p => not_both (occurring e) (situation_of p)
  | Stated k => And (assumed k) (Not (rename event_of (forbidden k)))
  | HappenBefore _ _ | Until _ _ _ _ _ | For _ _ _ _ => Truth true
  end.

(** The event begins it, and [p] lasts until it is [over]. *)
Fixpoint lasts (over p : instant -> bool) (from : trace) : bool :=
  match from with
  | [] => true
  | i :: later => over i || (p i && lasts over p later)
  end.

Definition begins (e : name) (c : state) (i : instant) : bool :=
  events i e && in_state i c.

(** A relation is kept at the instant [i] of the trace [earlier ++ i :: later]. *)
Definition relation_kept (earlier : trace) (i : instant) (later : trace) (rel : relation) : bool :=
  match rel with
  | HappenBefore a b => implb (events i b) (existsb (fun j => events j a) earlier)
  | Until e c p stop d =>
      implb (begins e c i)
            (lasts (begins stop d) (fun j => in_state j p) (i :: later))
  | For e c p length =>
      implb (begins e c i)
            (lasts (fun j => time i + seconds i length <=? time j)
                   (fun j => in_state j p) (i :: later))
  | _ => eval (context_of i) (invariant rel)
  end.

(** * Whole traces *)

Inductive law :=
| RuleLaw (R : timed_rule)
| RelationLaw (rel : relation).

Definition law_kept (r : reading) (u : untimed) (earlier : trace) (i : instant) (later : trace) (k : law)
  : bool :=
  match k with
  | RuleLaw R => rule_kept r u (earlier ++ i :: later) i R
  | RelationLaw rel => relation_kept earlier i later rel
  end.

(** Each instant with those before and after it. *)
Fixpoint moments (earlier : trace) (tr : trace) : list (trace * instant * trace) :=
  match tr with
  | [] => []
  | i :: later => (earlier, i, later) :: moments (earlier ++ [i]) later
  end.

Lemma in_moments earlier tr e i l :
  In (e, i, l) (moments earlier tr) <-> exists e', e = earlier ++ e' /\ tr = e' ++ i :: l.
Proof.
  revert earlier. induction tr as [|j tr IH]; intro earlier; simpl.
  - split; [tauto|]. intros [[|x e'] [_ E]]; discriminate.
  - rewrite IH. split.
    + intros [E|[e' [-> ->]]].
      * injection E as <- <- <-. exists []. rewrite app_nil_r. auto.
      * exists (j :: e'). rewrite <- app_assoc. auto.
    + intros [[|x e'] [-> E]]; simpl in E; injection E as <- E.
      * left. rewrite app_nil_r, E. reflexivity.
      * right. exists e'. rewrite <- app_assoc. auto.
Qed.

(** For each instant, which laws a trace breaks there, by their places. *)
Definition broken (r : reading) (u : untimed) (laws : list law) (tr : trace) : list (list bool) :=
  map (fun m => let '(earlier, i, later) := m in
                map (fun k => negb (law_kept r u earlier i later k)) laws)
      (moments [] tr).

(** The trace is one of the laws. *)
Definition lawful (r : reading) (u : untimed) (laws : list law) (tr : trace) : Prop :=
  forall earlier i later k, tr = earlier ++ i :: later -> In k laws ->
    law_kept r u earlier i later k = true.

Theorem broken_nothing r u laws tr :
  lawful r u laws tr <-> forall bs, In bs (broken r u laws tr) -> forall b, In b bs -> b = false.
Proof.
  unfold lawful, broken. split.
  - intros H bs I b J. apply in_map_iff in I. destruct I as [[[e i] l] [<- I]].
    apply in_map_iff in J. destruct J as [k [<- J]]. apply negb_false_iff.
    apply in_moments in I. destruct I as [e' [-> E]]. exact (H _ _ _ _ E J).
  - intros H e i l k E I. apply negb_false_iff. eapply H.
    + apply in_map_iff. exists (e, i, l). split; [reflexivity|]. apply in_moments. exists e. auto.
    + apply in_map_iff. exists k. split; [reflexivity|exact I].
Qed.

(** * Claims *)

(** A concern or purpose: some occurrence with its condition, at which what its responses
    demand is true. *)
Record claim := Claim {
  claimed_event : name;
  claimed_condition : formula fact;
  claimed_responses : list timed_chain }.

(** A claim, and the second one of [meanwhile], occur somewhere in the trace. *)
Definition comes_about (r : reading) (u : untimed) (tr : trace) (claims : list claim) : bool :=
  forallb (fun c =>
    existsb (fun i =>
      events i (claimed_event c)
      && eval (context_of i) (claimed_condition c)
      && forallb (fun a => satisfied tr (time i) (chain_demand r u i 0 a)) (claimed_responses c)) tr)
    claims.
