(** Dispatch as transition systems ([sleec_runtime/dispatch/snapshot.py], [dispatch.py] and
    [global_activation.py]; issue 5, theorem 7).

    Changes of context, triggers and the execution of what they set off come in any
    order, as threads and messages have it. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Instance Proposition1.
Import ListNotations.

(** Which conditions hold; a change replaces it whole. *)
Definition situation := name -> bool.

(** The context of a dispatch: the triggers that occur together, in a situation. *)
Definition context_of (ts : list name) (now : situation) : context := fun f =>
  match f with
  | Occurs t => if in_dec Pos.eq_dec t ts then true else false
  | Holds c => now c
  end.

(** The code of a rule's method that is bound with a layer (γ corrected). *)
Definition variant (R : rule) (l : layer) : list name :=
  match l with
  | Layer _ i => to_do (clause R i)
  | _ => to_do (clause R 0)
  end.

(** What a dispatch will execute: for each rule that is triggered, the variant of the
    layer that Algorithm 1 gives. *)
Definition plan (r : reading) (G : ruleset) (chi : context) : list name :=
  flat_map (fun R => variant R (returned own R (algorithm_1 r chi R))) (filter (triggered chi) G).

Lemma plan_due r G chi : plan r G chi = to_do (due r G chi).
Proof.
  unfold plan, due. induction G as [|R G IH]; [reflexivity|]. cbn [filter flat_map].
  assert (A : forall ls ms, to_do (ls ++ ms) = to_do ls ++ to_do ms).
  { intros ls ms. unfold to_do. apply flat_map_app. }
  rewrite A. unfold due_of at 1. destruct (triggered chi R); [|exact IH].
  cbn [flat_map]. rewrite IH. f_equal. rewrite returned_active.
  destruct (active r chi R); reflexivity.
Qed.

(** * Snapshot dispatch *)

(** One dispatch: the context it was decided in, what it did, what it has still to do. *)
Record dispatch := Dispatch { decided_in : context; did : list name; rest : list name }.

Record state := State { now : situation; dispatches : list dispatch }.

Inductive event :=
| Change (next : situation)       (** the context changes, whole *)
| Trigger (ts : list name)        (** these triggers occur: a snapshot is taken *)
| Run (d : nat).                  (** dispatch [d] executes its next obligation *)

Definition run_one (d : dispatch) : dispatch :=
  match rest d with
  | [] => d
  | o :: os => Dispatch (decided_in d) (did d ++ [o]) os
  end.

Fixpoint at_place {A} (f : A -> A) (n : nat) (xs : list A) : list A :=
  match n, xs with
  | _, [] => []
  | 0, x :: ys => f x :: ys
  | S k, x :: ys => x :: at_place f k ys
  end.

(** A context in which the rules contradict each other is rejected before anything
    is executed. *)
Definition step (r : reading) (G : ruleset) (s : state) (e : event) : state :=
  match e with
  | Change next => State next (dispatches s)
  | Trigger ts =>
      let chi := context_of ts (now s) in
      if contradictory (due r G chi) then s
      else State (now s) (dispatches s ++ [Dispatch chi [] (plan r G chi)])
  | Run d => State (now s) (at_place run_one d (dispatches s))
  end.

Definition run (r : reading) (G : ruleset) (s : state) (trace : list event) : state :=
  fold_left (step r G) trace s.

Definition initial (h : situation) : state := State h [].

Lemma nth_at_place {A} (f : A -> A) n xs k :
  nth_error (at_place f n xs) k =
  if k =? n then option_map f (nth_error xs k) else nth_error xs k.
Proof.
  revert n k. induction xs as [|x xs IH]; intros [|n] [|k]; simpl; auto.
  destruct (k =? n); reflexivity.
Qed.

(** ** Every dispatch executes what was due when it was triggered, and nothing else *)

(** At each moment of each interleaving: what a dispatch did, with what it has still
    to do, is what is due in the context of its trigger, in order; that context is the
    whole one that held when the trigger occurred; and the rules are consistent there. *)
Theorem snapshot_refines r G h trace d x :
  nth_error (dispatches (run r G (initial h) trace)) d = Some x ->
  did x ++ rest x = to_do (due r G (decided_in x)) /\
  consistent r G (decided_in x) /\
  exists past ts future,
    trace = past ++ Trigger ts :: future /\
    decided_in x = context_of ts (now (run r G (initial h) past)).
Proof.
  revert d x. induction trace as [|e trace IH] using rev_ind; intros d x N.
  { destruct d; discriminate N. }
  assert (Later : forall past ts future t,
    trace = past ++ Trigger ts :: future -> trace ++ [t] = past ++ Trigger ts :: (future ++ [t])).
  { intros past ts future t ->. rewrite <- app_assoc. reflexivity. }
  unfold run in N. rewrite fold_left_app in N. cbn [fold_left] in N.
  fold (run r G (initial h) trace) in N. set (s := run r G (initial h) trace) in *.
  destruct e as [next|ts|k]; cbn [step] in N.
  - destruct (IH d x N) as [A [C [past [ts [future [E X]]]]]].
    split; [exact A|]. split; [exact C|]. exists past, ts, (future ++ [Change next]). auto.
  - destruct (contradictory (due r G (context_of ts (now s)))) eqn:C.
    + destruct (IH d x N) as [A [C' [past [us [future [E X]]]]]].
      split; [exact A|]. split; [exact C'|]. exists past, us, (future ++ [Trigger ts]). auto.
    + cbn [dispatches] in N. destruct (Nat.lt_ge_cases d (length (dispatches s))) as [L|L].
      * rewrite nth_error_app1 in N by exact L.
        destruct (IH d x N) as [A [C' [past [us [future [E X]]]]]].
        split; [exact A|]. split; [exact C'|]. exists past, us, (future ++ [Trigger ts]). auto.
      * rewrite nth_error_app2 in N by exact L.
        destruct (d - length (dispatches s)) as [|[|]]; cbn in N; try discriminate N.
        injection N as <-. cbn [did rest decided_in app]. split; [apply plan_due|].
        split; [exact C|]. exists trace, ts, []. auto.
  - cbn [dispatches] in N. rewrite nth_at_place in N. destruct (d =? k).
    + destruct (nth_error (dispatches s) d) as [y|] eqn:Y; [|discriminate N].
      cbn [option_map] in N. injection N as <-.
      destruct (IH d y Y) as [A [C [past [us [future [E X]]]]]].
      unfold run_one. destruct (rest y) as [|o os] eqn:R; cbn [did rest decided_in].
      * rewrite R. split; [exact A|]. split; [exact C|].
        exists past, us, (future ++ [Run k]). auto.
      * rewrite <- app_assoc. split; [exact A|]. split; [exact C|].
        exists past, us, (future ++ [Run k]). auto.
    + destruct (IH d x N) as [A [C [past [us [future [E X]]]]]].
      split; [exact A|]. split; [exact C|]. exists past, us, (future ++ [Run k]). auto.
Qed.

(** A dispatch that is over did what the instance executes in its context (Definition
    2), which is what the rules entail there (Proposition 1). *)
Corollary snapshot_executes r method G h trace d x o :
  unique_labels G ->
  nth_error (dispatches (run r G (initial h) trace)) d = Some x -> rest x = [] ->
  (In o (did x) <-> executes (gamma r method G) G (decided_in x) o) /\
  (In o (did x) <-> entails_to_do r G (decided_in x) o).
Proof.
  intros U N E. destruct (snapshot_refines r G h trace d x N) as [A [C _]].
  rewrite E, app_nil_r in A. rewrite A, in_to_do.
  rewrite (proposition_1 r method G (decided_in x) o U C).
  rewrite (executed_iff_due r method G (decided_in x) o U). split; reflexivity.
Qed.

(** ** Nothing that is due is forgotten *)

Lemma step_keeps r G s e d x :
  nth_error (dispatches s) d = Some x ->
  exists y, nth_error (dispatches (step r G s e)) d = Some y /\
            decided_in y = decided_in x /\ did y ++ rest y = did x ++ rest x.
Proof.
  intro N. destruct e as [next|ts|k]; cbn [step].
  - exists x. auto.
  - destruct (contradictory _); [exists x; auto|]. exists x. cbn [dispatches].
    rewrite nth_error_app1; [auto|]. apply nth_error_Some. rewrite N. discriminate.
  - cbn [dispatches]. rewrite nth_at_place. destruct (d =? k); [|exists x; auto].
    rewrite N. exists (run_one x). split; [reflexivity|]. unfold run_one.
    destruct (rest x) as [|o os] eqn:R; [rewrite R; auto|]. cbn [decided_in did rest].
    rewrite <- app_assoc. auto.
Qed.

(** A trigger in a consistent context makes a dispatch, decided in that context,
    whatever comes after. *)
Theorem trigger_dispatched r G h past ts future :
  let chi := context_of ts (now (run r G (initial h) past)) in
  consistent r G chi ->
  exists d x, nth_error (dispatches (run r G (initial h) (past ++ Trigger ts :: future))) d = Some x
              /\ decided_in x = chi.
Proof.
  intros chi C. set (s := run r G (initial h) past) in *.
  exists (length (dispatches s)). unfold run. rewrite fold_left_app. cbn [fold_left].
  fold (run r G (initial h) past). fold s.
  assert (B : nth_error (dispatches (step r G s (Trigger ts))) (length (dispatches s))
              = Some (Dispatch chi [] (plan r G chi))).
  { cbn [step]. fold chi. unfold consistent in C. rewrite C. cbn [dispatches].
    rewrite nth_error_app2, Nat.sub_diag by auto. reflexivity. }
  assert (K : forall e s' x, nth_error (dispatches s') (length (dispatches s)) = Some x ->
              decided_in x = chi ->
              exists y, nth_error (dispatches (fold_left (step r G) e s')) (length (dispatches s))
                        = Some y /\ decided_in y = chi).
  { induction e as [|e es IH]; intros s' x N D; [exists x; auto|]. cbn [fold_left].
    destruct (step_keeps r G s' e _ x N) as [y [Y [E _]]]. apply (IH _ y Y). congruence. }
  exact (K future _ _ B eq_refl).
Qed.

(** Run often enough, whatever happens between, a dispatch is over: each [Run] takes
    one obligation off. *)
Theorem run_progresses r G s d x o os :
  nth_error (dispatches s) d = Some x -> rest x = o :: os ->
  nth_error (dispatches (step r G s (Run d))) d
  = Some (Dispatch (decided_in x) (did x ++ [o]) os).
Proof.
  intros N R. cbn [step dispatches]. rewrite nth_at_place, Nat.eqb_refl, N.
  cbn [option_map]. unfold run_one. rewrite R. reflexivity.
Qed.

(** Events that are not its own leave a dispatch as it is. *)
Theorem others_leave_it r G s e d x :
  e <> Run d -> nth_error (dispatches s) d = Some x ->
  nth_error (dispatches (step r G s e)) d = Some x.
Proof.
  intros E N. destruct e as [next|ts|k]; cbn [step].
  - exact N.
  - destruct (contradictory _); [exact N|]. cbn [dispatches].
    rewrite nth_error_app1; [exact N|]. apply nth_error_Some. rewrite N. discriminate.
  - cbn [dispatches]. rewrite nth_at_place.
    destruct (Nat.eqb_spec d k) as [->|]; [congruence|exact N].
Qed.

(** * Two-step global activation *)

(** The paper's implementation on ContextPy3: on a change of context the layer of each
    rule is computed again; the old one is deactivated, and the new one activated, one
    global step after the other.  A trigger runs what is active at that moment: of each
    rule the variant that was activated last, or the base. *)
Inductive swap := Deactivate (l : layer) | Activate (l : layer).

Record global := Global {
  holding : situation;
  active_layers : list layer;                    (** the last one activated first *)
  pending : list swap;                           (** what is still to be swapped *)
  log : list (list name * list name) }.          (** triggers, and what they executed *)

Inductive happening :=
| Changed (next : situation)
| Swap                            (** the next pending step is carried out *)
| Triggered (ts : list name).

(** The layer of a rule, were it triggered. *)
Definition layer_in (r : reading) (h : situation) (R : rule) : layer :=
  returned own R (algorithm_1 r (context_of [] h) R).

Definition is_own (R : rule) (l : layer) : bool :=
  match l with Layer m _ => Pos.eqb m (label R) | _ => false end.

Definition swaps (r : reading) (h next : situation) (R : rule) : list swap :=
  let old := layer_in r h R in
  let new := layer_in r next R in
  if layer_eq_dec old new then []
  else (if is_own R old then [Deactivate old] else [])
       ++ (if is_own R new then [Activate new] else []).

Definition carry_out (ls : list layer) (w : swap) : list layer :=
  match w with
  | Deactivate l => filter (fun m => if layer_eq_dec l m then false else true) ls
  | Activate l => l :: ls
  end.

Definition selected (ls : list layer) (R : rule) : layer :=
  hd (own R) (filter (is_own R) ls).

Definition happens (r : reading) (G : ruleset) (s : global) (e : happening) : global :=
  match e with
  | Changed next =>
      Global next (active_layers s)
             (pending s ++ flat_map (swaps r (holding s) next) G) (log s)
  | Swap =>
      match pending s with
      | [] => s
      | w :: ws => Global (holding s) (carry_out (active_layers s) w) ws (log s)
      end
  | Triggered ts =>
      let chi := context_of ts (holding s) in
      Global (holding s) (active_layers s) (pending s)
             (log s ++ [(ts, flat_map (fun R => variant R (selected (active_layers s) R))
                                      (filter (triggered chi) G))])
  end.

Definition goes_on (r : reading) (G : ruleset) (s : global) (trace : list happening) : global :=
  fold_left (happens r G) trace s.

(** All layers as they should be. *)
Definition settled (r : reading) (G : ruleset) (h : situation) : global :=
  Global h (filter (fun l => match l with Layer _ _ => true | _ => false end)
                   (map (layer_in r h) G)) [] [].

Definition same_names (xs ys : list name) : Prop := forall o, In o xs <-> In o ys.

(** What one asks of it at the very least: what a trigger executes is due in some
    situation that held up to then, be it a stale one. *)
Definition refines_at_some_time (r : reading) (G : ruleset) (h : situation)
    (trace : list happening) : Prop :=
  forall ts os, In (ts, os) (log (goes_on r G (settled r G h) trace)) ->
  exists past future,
    trace = past ++ future /\
    same_names os (to_do (due r G (context_of ts (holding (goes_on r G (settled r G h) past))))).

(** [WHEN CurtainOpenRequest THEN OpenCurtains
     UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
     UNLESS UserDistressed IN WHICH CASE (WarnUser AND OpenCurtains)] *)
Section Curtains.

Local Open Scope positive_scope.

Let open := 1. Let refuse := 2. Let explain := 3. Let warn := 4.
Let undressed := 1. Let distressed := 2. Let request := 1.

Definition dress_assist : rule :=
  Rule 1 request (Truth true) [Do open]
       [Hedge (Atom (Holds undressed)) [Do refuse; Do explain];
        Hedge (Atom (Holds distressed)) [Do warn; Do open]].

Definition only_undressed : situation := fun c => Pos.eqb c undressed.
Definition both_of_them : situation := fun c => Pos.eqb c undressed || Pos.eqb c distressed.

(** The undressed user becomes distressed; hc1 is deactivated; a request comes; hc2 is
    activated. *)
Definition between_two_layers : list happening :=
  [Changed both_of_them; Swap; Triggered [request]; Swap].

Theorem two_step_opens_the_curtains :
  log (goes_on Cascade [dress_assist] (settled Cascade [dress_assist] only_undressed)
               between_two_layers) = [([request], [open])].
Proof. reflexivity. Qed.

(** In none of the situations that held is that due: before, the request is to be
    refused; after, the user is to be warned. *)
Theorem two_step_does_not_refine :
  ~ refines_at_some_time Cascade [dress_assist] only_undressed between_two_layers.
Proof.
  intro F. specialize (F [request] [open]).
  destruct F as [past [future [E S]]]; [left; reflexivity|].
  assert (H : holding (goes_on Cascade [dress_assist]
                (settled Cascade [dress_assist] only_undressed) past) = only_undressed \/
              holding (goes_on Cascade [dress_assist]
                (settled Cascade [dress_assist] only_undressed) past) = both_of_them).
  { destruct past as [|e1 past]; [left; reflexivity|].
    injection E as <- E. right. destruct past as [|e2 past]; [reflexivity|].
    injection E as <- E. destruct past as [|e3 past]; [reflexivity|].
    injection E as <- E. destruct past as [|e4 past]; [reflexivity|].
    injection E as <- E. destruct past; [reflexivity|discriminate E]. }
  destruct H as [H|H]; rewrite H in S.
  - destruct (proj1 (S open) (or_introl eq_refl)) as [X|[X|[]]]; discriminate X.
  - destruct (proj2 (S warn) (or_introl eq_refl)) as [X|[]]; discriminate X.
Qed.

(** Activating the new layer before the old one is deactivated corrects one rule, and not
    two: between them one has changed and the other has not.  Here nothing is
    deactivated at all.
    [WHEN request THEN o1 UNLESS c IN WHICH CASE o2],
    [WHEN request THEN o3 UNLESS c IN WHICH CASE o4]. *)
Definition two_rules : ruleset :=
  [Rule 1 request (Truth true) [Do 1] [Hedge (Atom (Holds 1)) [Do 2]];
   Rule 2 request (Truth true) [Do 3] [Hedge (Atom (Holds 1)) [Do 4]]].

Definition nothing_holds : situation := fun _ => false.

Definition between_two_rules : list happening :=
  [Changed only_undressed; Swap; Triggered [request]; Swap].

Theorem two_rules_are_torn :
  log (goes_on Cascade two_rules (settled Cascade two_rules nothing_holds) between_two_rules)
  = [([request], [2; 3])] /\
  ~ refines_at_some_time Cascade two_rules nothing_holds between_two_rules.
Proof.
  split; [reflexivity|]. intro F. specialize (F [request] [2; 3]).
  destruct F as [past [future [E S]]]; [left; reflexivity|].
  assert (H : holding (goes_on Cascade two_rules
                (settled Cascade two_rules nothing_holds) past) = nothing_holds \/
              holding (goes_on Cascade two_rules
                (settled Cascade two_rules nothing_holds) past) = only_undressed).
  { destruct past as [|e1 past]; [left; reflexivity|].
    injection E as <- E. right. destruct past as [|e2 past]; [reflexivity|].
    injection E as <- E. destruct past as [|e3 past]; [reflexivity|].
    injection E as <- E. destruct past as [|e4 past]; [reflexivity|].
    injection E as <- E. destruct past; [reflexivity|discriminate E]. }
  destruct H as [H|H]; rewrite H in S.
  - destruct (proj2 (S 1) (or_introl eq_refl)) as [X|[X|[]]]; discriminate X.
  - destruct (proj2 (S 4) (or_intror (or_introl eq_refl))) as [X|[X|[]]]; discriminate X.
Qed.

(** Snapshot dispatch, with the same change and the same request, warns the user. *)
Example snapshot_warns :
  map did (dispatches (run Cascade [dress_assist] (initial only_undressed)
    [Change both_of_them; Trigger [request]; Run 0; Run 0])) = [[warn; open]].
Proof. reflexivity. Qed.

End Curtains.
