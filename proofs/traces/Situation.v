(** Conflicts of rules with time ([docs/traces.md], [sleec_verify/traces/conflicts.py]). *)

From Coq Require Import List Bool PArith ZArith.
From Sleec Require Import Model Evaluation.
From Traces Require Import Trace History Continuation Growth.
Import ListNotations.
Local Open Scope Z_scope.

(** A ruleset with time.  Only the environment causes mere inputs. *)
Record timed_ruleset := TimedRuleset {
  ruleset_reading : reading;
  ruleset_untimed : untimed;
  timed_rules : list timed_rule;
  relations : list relation;
  mere_input : name -> bool }.

Definition laws_of (G : timed_ruleset) (S : list timed_rule) : list law :=
  map RuleLaw S ++ map RelationLaw (relations G).

(** A history, and now: its events are the inputs that occur. *)
Record situation := AtNow { past : trace; now : instant }.

(** No law is violated so far, each by itself: what follows from now on can keep it. *)
Definition lawful_so_far (G : timed_ruleset) (s : situation) : Prop :=
  forall earlier i later k, past s = earlier ++ i :: later -> In k (laws_of G (timed_rules G)) ->
    exists c, from (time (now s)) c
              /\ law_kept (ruleset_reading G) (ruleset_untimed G) earlier i (later ++ c) k = true.

(** The inputs of now with any acts, and any continuation. *)
Definition responds (G : timed_ruleset) (s : situation) (e : trace) : Prop :=
  exists now' later, e = past s ++ now' :: later /\ ordered e /\ grown (now s) now'
    /\ forall x, events now' x = true -> events (now s) x = true \/ mere_input G x = false.

(** The relations hold, and every demand of the rules [S] is met. *)
Definition complies (G : timed_ruleset) (S : list timed_rule) (e : trace) : Prop :=
  lawful (ruleset_reading G) (ruleset_untimed G) (laws_of G S) e.

Definition can_comply (G : timed_ruleset) (S : list timed_rule) (s : situation) : Prop :=
  exists e, responds G s e /\ complies G S e.

(** Inputs trigger rules, or only the environment causes them. *)
Definition is_input (G : timed_ruleset) (x : name) : Prop :=
  mere_input G x = true \/ exists R, In R (timed_rules G) /\ timed_trigger R = x.

(** An event triggers a rule, or its conditions name it. *)
Definition concerns (R : timed_rule) (x : name) : Prop :=
  x = timed_trigger R \/ In x (rule_events R).

(** A situation for the rules [S]. *)
Record situation_for (G : timed_ruleset) (S : list timed_rule) (s : situation) : Prop := {
  in_order : ordered (past s ++ [now s]);
  is_lawful : lawful_so_far G s;
  inputs_concern : forall x, events (now s) x = true ->
    is_input G x /\ exists R, In R S /\ concerns R x;
  one_decides : exists R, In R S /\ is_triggered (now s) R = true;
  inputs_allowed : forall i R, In i (past s) -> In R S ->
    exists e, grows (past s ++ [now s]) e /\ ordered e
              /\ rule_kept (ruleset_reading G) (ruleset_untimed G) e i R = true;
  relations_satisfiable : can_comply G [] s }.

(** No response complies with [S], and one complies with each set that lacks a rule of [S]. *)
Definition in_conflict (G : timed_ruleset) (S : list timed_rule) (s : situation) : Prop :=
  incl S (timed_rules G) /\ situation_for G S s /\ ~ can_comply G S s
  /\ forall one R other, S = one ++ R :: other -> can_comply G (one ++ other) s.

(** Fewer rules are easier to comply with: it is enough to leave out one rule at a time. *)
Theorem can_comply_fewer G S T s : incl T S -> can_comply G S s -> can_comply G T s.
Proof.
  intros I [e [Re C]]. exists e. split; [exact Re|]. intros earlier i later k E K. apply (C _ _ _ _ E).
  unfold laws_of in *. apply in_app_iff in K. apply in_app_iff. destruct K as [K|K]; [|auto].
  apply in_map_iff in K. destruct K as [R [<- K]]. left. apply in_map, I, K.
Qed.
