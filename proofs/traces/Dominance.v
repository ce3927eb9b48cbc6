(** Dominance ([is_dominant] in [sleec_verify/traces/pending_demands.py], [_settled] and [_dominated]
    in [sleec_verify/traces/histories.py]).

    Many triggerings of one response can be pending at now.  If its window opens with the
    trigger, the earliest deadline implies all later ones, and the latest prohibition implies
    all earlier ones: one of them says what all of them ask of what is to come. *)

From Coq Require Import List Bool PArith ZArith Lia.
From Sleec Require Import Model Evaluation.
From Traces Require Import Trace History Continuation.
Import ListNotations.
Local Open Scope Z_scope.

(** * Two triggerings of one response *)

Lemma covers_spec o since z :
  covers o since z = true <->
  since + first o <= z /\ forall last, final o = Some last -> z <= since + last.
Proof.
  unfold covers. rewrite andb_true_iff, Z.leb_le. destruct (final o) as [e|].
  - rewrite Z.leb_le. split; [intros [A B]; split; [exact A|congruence]|].
    intros [A B]. split; [exact A|apply B; reflexivity].
  - split; [intros [A _]; split; [exact A|discriminate]|tauto].
Qed.

Lemma occurs_spec tr since o :
  occurs tr since o = true <->
  exists i, In i tr /\ events i (about (what o)) = true /\ covers o since (time i) = true.
Proof.
  unfold occurs. rewrite existsb_exists.
  split; intros [i [I H]]; exists i; rewrite andb_true_iff in *; tauto.
Qed.

(** What the window of [a] covers from now on, that of [b] covers too, if it opens before now
    and does not close earlier.  A window that opens one second after its trigger is open at
    now, because the trigger came before. *)
Lemma covers_later o a b now z :
  first o <= 1 -> a <= b < now -> now <= z -> covers o a z = true -> covers o b z = true.
Proof.
  rewrite !covers_spec. intros F B N [_ L]. split; [lia|]. intros last E. specialize (L _ E). lia.
Qed.

Lemma occurs_later c o a b now :
  first o <= 1 -> a <= b < now -> from now c -> occurs c a o = true -> occurs c b o = true.
Proof.
  intros F B [_ N] H. apply occurs_spec in H. destruct H as [i [I [E C]]]. apply occurs_spec.
  rewrite Forall_forall in N. exists i. eauto 6 using covers_later.
Qed.

(** The response [o], pending since [earlier], implies the one pending since [later]. *)
Theorem earliest_deadline h now c o earlier later :
  positive_literal (what o) = true -> first o <= 1 -> earlier <= later < now -> from now c ->
  occurs h earlier o = false ->
  met (h ++ c) earlier o = true -> met (h ++ c) later o = true.
Proof.
  unfold met. intros -> F B N U. rewrite !occurs_app, U. simpl. intro H.
  rewrite (occurs_later c o earlier later now F B N H). apply orb_true_r.
Qed.

(** A prohibition since [later] implies one since [earlier] that is not broken yet. *)
Theorem latest_prohibition h now c o earlier later :
  positive_literal (what o) = false -> first o <= 1 -> earlier <= later < now -> from now c ->
  occurs h earlier o = false ->
  met (h ++ c) later o = true -> met (h ++ c) earlier o = true.
Proof.
  unfold met. intros -> F B N U. rewrite !occurs_app, U, !negb_true_iff, orb_false_iff.
  intros [_ H]. apply not_true_is_false. intro X. simpl in X.
  rewrite (occurs_later c o earlier later now F B N X) in H. discriminate.
Qed.

(** * One slot is exact *)

Lemma extreme (xs : list Z) (sign : bool) :
  xs <> [] -> exists s, In s xs /\ forall x, In x xs -> if sign then s <= x else x <= s.
Proof.
  induction xs as [|a xs IH]; [congruence|]. intros _. destruct xs as [|b xs].
  - exists a. split; [simpl; auto|]. intros x [<-|[]]. destruct sign; lia.
  - destruct IH as [s [I M]]; [discriminate|].
    destruct (Z_le_gt_dec a s), sign; try (exists s; split; [simpl; auto; fail|];
      intros x [<-|X]; [lia|exact (M x X)]);
      (exists a; split; [simpl; auto|]; intros x [<-|X]; [lia|]; specialize (M x X); simpl in M; lia).
Qed.

(** However often a response has been triggered: if none of the triggerings is met or broken,
    one of them, the same for every continuation, is met if and only if all are. *)
Theorem one_slot_exact h now o sinces :
  first o <= 1 -> sinces <> [] ->
  (forall a, In a sinces -> a < now /\ occurs h a o = false) ->
  exists s, In s sinces /\ forall c, from now c ->
    met (h ++ c) s o = true <-> (forall a, In a sinces -> met (h ++ c) a o = true).
Proof.
  intros F N P. destruct (extreme sinces (positive_literal (what o)) N) as [s [I M]].
  exists s. split; [exact I|]. intros c C. split; [|auto]. intros H a A.
  specialize (M a A). destruct (P a A) as [La Ua]. destruct (P s I) as [Ls Us].
  destruct (positive_literal (what o)) eqn:S.
  - eapply earliest_deadline; eauto.
  - eapply latest_prohibition; eauto.
Qed.

(** * Slots for all that is pending *)

(** A demand, and the time of its trigger. *)
Definition pending := (Z * demand)%type.

Definition fulfilled (tr : trace) (p : pending) : bool := satisfied tr (fst p) (snd p).

(** The history meets a demand, whatever follows. *)
Fixpoint settled (h : trace) (now since : Z) (d : demand) : bool :=
  match d with
  | Atomic o =>
      if positive_literal (what o) then occurs h since o
      else match final o with
           | Some last => negb (occurs h since o) && (since + last <? now)
           | None => false
           end
  | Every parts => forallb (settled h now since) parts
  | Either parts => existsb (settled h now since) parts
  end.

Lemma settled_satisfied h now c since d :
  from now c -> settled h now since d = true -> satisfied (h ++ c) since d = true.
Proof.
  intros [_ N] H. induction d as [o|ds IH|ds IH] using demand_ind_deep; cbn [settled satisfied] in *.
  - unfold met. rewrite occurs_app. destruct (positive_literal (what o)); [rewrite H; reflexivity|].
    destruct (final o) as [e|] eqn:E; [|discriminate].
    rewrite andb_true_iff, negb_true_iff, Z.ltb_lt in H. destruct H as [U L]. rewrite U.
    apply negb_true_iff, not_true_is_false. intro X. apply occurs_spec in X.
    destruct X as [i [I [_ C]]]. apply covers_spec in C. destruct C as [_ C]. specialize (C _ E).
    rewrite Forall_forall in N. specialize (N i I). lia.
  - rewrite forallb_forall in *. rewrite Forall_forall in IH. auto.
  - rewrite existsb_exists in *. rewrite Forall_forall in IH. destruct H as [d [I H]]. eauto.
Qed.

(** A slot that says all that a pending demand leaves. *)
Definition dominates (h : trace) (now : Z) (slot p : pending) : Prop :=
  exists o, snd slot = Atomic o /\ snd p = Atomic o /\ first o <= 1
    /\ fst slot < now /\ fst p < now
    /\ if positive_literal (what o)
       then fst slot <= fst p /\ occurs h (fst slot) o = false
       else fst p <= fst slot /\ occurs h (fst p) o = false.

Lemma dominates_fulfilled h now c slot p :
  from now c -> dominates h now slot p ->
  fulfilled (h ++ c) slot = true -> fulfilled (h ++ c) p = true.
Proof.
  intros C [o [S [P [F [Ls [Lp D]]]]]]. unfold fulfilled. rewrite S, P. cbn [satisfied].
  destruct (positive_literal (what o)) eqn:X; destruct D as [L U].
  - eapply earliest_deadline; eauto.
  - eapply latest_prohibition; eauto.
Qed.

(** The demands that a demand is the conjunction of. *)
Fixpoint conjuncts (d : demand) : list demand :=
  match d with
  | Every parts => flat_map conjuncts parts
  | _ => [d]
  end.

Lemma conjuncts_spec tr since d :
  satisfied tr since d = true <-> forall p, In p (conjuncts d) -> satisfied tr since p = true.
Proof.
  induction d as [o|ds IH|ds _] using demand_ind_deep; cbn [conjuncts satisfied].
  - split; [intros H p [<-|[]]; exact H|]. intro H. apply (H (Atomic o)). simpl. auto.
  - rewrite forallb_forall. rewrite Forall_forall in IH. setoid_rewrite in_flat_map. split.
    + intros H p [d [I J]]. apply (IH d I); auto.
    + intros H d I. apply (IH d I). eauto.
  - split; [intros H p [<-|[]]; exact H|]. intro H. apply (H (Either ds)). simpl. auto.
Qed.

(** All that the rules demand at the instants of a history. *)
Definition demanded (r : reading) (u : untimed) (rules : list timed_rule) (h : trace) : list pending :=
  flat_map (fun i =>
    flat_map (fun R => if is_triggered i R
                       then map (pair (time i)) (conjuncts (rule_demand r u i R)) else []) rules) h.

Lemma demanded_spec r u rules h tr :
  (forall i R, In i h -> In R rules -> rule_kept r u tr i R = true) <->
  (forall p, In p (demanded r u rules h) -> fulfilled tr p = true).
Proof.
  unfold demanded, rule_kept. split.
  - intros H p I. apply in_flat_map in I. destruct I as [i [Ii I]].
    apply in_flat_map in I. destruct I as [R [IR I]]. specialize (H i R Ii IR).
    destruct (is_triggered i R); [|destruct I]. simpl in H. apply in_map_iff in I.
    destruct I as [d [<- I]]. rewrite conjuncts_spec in H. exact (H d I).
  - intros H i R Ii IR. destruct (is_triggered i R) eqn:T; [|reflexivity]. simpl.
    apply conjuncts_spec. intros d I. apply (H (time i, d)).
    apply in_flat_map. exists i. split; [exact Ii|]. apply in_flat_map. exists R.
    split; [exact IR|]. rewrite T. apply in_map, I.
Qed.

(** The engine's situations: each demand of a history is settled, a slot, or dominated by one.
    Then every continuation keeps the rules at the instants of the history if and only if it
    fulfils the slots. *)
Theorem slots_exact r u rules h now slots :
  incl slots (demanded r u rules h) ->
  (forall p, In p (demanded r u rules h) ->
     settled h now (fst p) (snd p) = true \/ In p slots
     \/ exists s, In s slots /\ dominates h now s p) ->
  forall c, from now c ->
    (forall i R, In i h -> In R rules -> rule_kept r u (h ++ c) i R = true) <->
    (forall s, In s slots -> fulfilled (h ++ c) s = true).
Proof.
  intros I P c C. rewrite demanded_spec. split; [auto|]. intros H p J.
  destruct (P p J) as [S|[S|[s [S D]]]].
  - apply settled_satisfied with now; assumption.
  - auto.
  - eapply dominates_fulfilled; eauto.
Qed.

(** * What a slot says of the past *)

Fixpoint occurrences (d : demand) : list occurrence :=
  match d with
  | Atomic o => [o]
  | Every parts | Either parts => flat_map occurrences parts
  end.

(** About the past, a slot needs only which of its events occurred in their windows. *)
Theorem flags_suffice h h' c since d :
  (forall o, In o (occurrences d) -> occurs h since o = occurs h' since o) ->
  satisfied (h ++ c) since d = satisfied (h' ++ c) since d.
Proof.
  induction d as [o|ds IH|ds IH] using demand_ind_deep; cbn [occurrences satisfied]; intro H.
  - unfold met. rewrite !occurs_app, (H o) by (simpl; auto). reflexivity.
  - induction IH as [|d ds Hd _ IH]; [reflexivity|]. cbn [forallb flat_map] in *.
    rewrite Hd, IH; auto using in_or_app.
  - induction IH as [|d ds Hd _ IH]; [reflexivity|]. cbn [existsb flat_map] in *.
    rewrite Hd, IH; auto using in_or_app.
Qed.
