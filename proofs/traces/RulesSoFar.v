(** [broken_so_far] is exact: a history breaks a law at an instant if and only if every way
    to go on breaks it there.  This file has the ways to go on, and shows it of rules. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace History Continuation.
Import ListNotations.
Local Open Scope Z_scope.

(** * Ways to go on *)

(** The same instant, at which more occurs. *)
Definition grown (i i' : instant) : Prop :=
  time i' = time i /\ conditions i' = conditions i /\ lengths i' = lengths i
  /\ forall e, events i e = true -> events i' e = true.

(** More occurs at the last instant of a history, and there are later ones. *)
Definition grows (h e : trace) : Prop :=
  exists past now now' later, h = past ++ [now] /\ e = past ++ now' :: later /\ grown now now'.

Lemma grown_refl i : grown i i.
Proof. repeat split; auto. Qed.

Lemma with_events_grown i more : grown i (with_events i more).
Proof. repeat split. intros e E. simpl. rewrite E. reflexivity. Qed.

Lemma grows_refl i later : grows (i :: later) (i :: later).
Proof.
  destruct (@exists_last _ (i :: later)) as [past [now E]]; [discriminate|].
  exists past, now, now, []. rewrite E. auto using grown_refl.
Qed.

(** The first instant of a history, and of what it grows into. *)
Lemma grows_first i later i' later' :
  grows (i :: later) (i' :: later') -> grown i i' /\ (later <> [] -> i' = i).
Proof.
  intros [[|x past] [now [now' [rest [E [F G]]]]]]; simpl in E, F.
  - injection E as -> ->. injection F as -> ->. split; [exact G|congruence].
  - injection E as <- _. injection F as <- _. auto using grown_refl.
Qed.

Lemma ordered_grown past now now' :
  ordered (past ++ [now]) -> grown now now' -> ordered (past ++ [now']).
Proof.
  intros O [T _]. apply ordered_app in O. destruct O as [P [_ L]]. apply ordered_app.
  split; [exact P|]. split; [repeat constructor|].
  intros i j I [<-|[]]. rewrite T. apply L; simpl; auto.
Qed.

(** * Demands *)

Lemma go_on past now since d :
  ordered (past ++ [now]) ->
  (exists c, from (time now) c /\ satisfied ((past ++ [now]) ++ c) since d = true) <->
  (exists now' later, grown now now' /\ ordered (past ++ now' :: later)
                      /\ satisfied (past ++ now' :: later) since d = true).
Proof.
  intro O. split.
  - intros [c [[Oc Fc] S]]. destruct c as [|j c].
    + exists now, []. rewrite app_nil_r in S. auto using grown_refl.
    + inversion Fc as [|y l L F]; subst. destruct (Z.eq_dec (time j) (time now)) as [E|N].
      * exists (with_events now (events j)), c. split; [apply with_events_grown|]. split.
        -- pose proof (ordered_grown _ _ _ O (with_events_grown now (events j))) as G.
           apply ordered_app in G. apply ordered_app. split; [tauto|]. split.
           ++ inversion Oc as [|y l S' B]; subst. constructor; [exact S'|].
              rewrite Forall_forall in *. intros k K. specialize (B k K).
              unfold before in *. simpl. lia.
           ++ intros i k I [<-|K]; [apply G; simpl; auto|].
              apply ordered_app in O. destruct O as [_ [_ L']].
              pose proof (L' i now I (or_introl eq_refl)).
              rewrite Forall_forall in F. specialize (F k K). lia.
        -- rewrite <- S. apply satisfied_ext. intro o. rewrite !occurs_app. unfold occurs. simpl.
           rewrite E. destruct (existsb _ past); [reflexivity|]. simpl. rewrite orb_false_r.
           destruct (existsb _ c); rewrite ?orb_true_r, ?orb_false_r; [reflexivity|].
           destruct (covers o since (time now)); rewrite ?andb_true_r, ?andb_false_r; reflexivity.
      * exists now, (j :: c). split; [apply grown_refl|].
        rewrite <- app_assoc in S. split; [|exact S]. apply ordered_app in O.
        apply ordered_app. split; [tauto|]. split.
        -- constructor; [exact Oc|]. inversion Oc as [|y l S' B]; subst. constructor;
             [unfold before; lia|]. rewrite Forall_forall in *. intros k K. specialize (B k K).
           unfold before in *. lia.
        -- intros i k I [<-|K]; [apply O; simpl; auto|].
           destruct O as [_ [_ L']]. pose proof (L' i now I (or_introl eq_refl)).
           destruct K as [<-|K]; [lia|]. rewrite Forall_forall in F. specialize (F k K). lia.
  - intros [now' [later [[T [_ [_ E]]] [O' S]]]]. exists (now' :: later). split.
    + apply ordered_app in O'. apply from_after; [tauto|lia].
    + rewrite <- S. apply satisfied_ext. intro o. rewrite !occurs_app. unfold occurs. simpl.
      rewrite T. destruct (existsb _ past); [reflexivity|]. simpl.
      destruct (events now (about (what o))) eqn:X; [rewrite (E _ X)|]; simpl; [|reflexivity].
      destruct (covers o since (time now)); reflexivity.
Qed.

(** Whatever else occurs at the instant, the rule demands the same. *)
Definition unaffected (r : reading) (u : untimed) (i : instant) (R : timed_rule) : Prop :=
  forall i', grown i i' ->
    eval (context_of i') (timed_guard R) = eval (context_of i) (timed_guard R)
    /\ rule_demand r u i' R = rule_demand r u i R.

Lemma rule_open_exact r u earlier i later R :
  ordered (earlier ++ i :: later) -> later <> [] \/ unaffected r u i R ->
  law_open r u earlier i later (RuleLaw R) = true <->
  exists i' later', grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')
                    /\ rule_kept r u (earlier ++ i' :: later') i' R = true.
Proof.
  intros O U.
  assert (Same : forall i' later', grows (i :: later) (i' :: later') ->
            time i' = time i /\ (is_triggered i R = true -> is_triggered i' R = true)
            /\ rule_demand r u i' R = rule_demand r u i R).
  { intros i' later' G. apply grows_first in G. destruct G as [G L].
    split; [apply G|]. destruct U as [N|U]; [rewrite (L N); auto|].
    destruct (U i' G) as [V D]. split; [|exact D]. unfold is_triggered. rewrite V.
    rewrite !andb_true_iff. destruct G as [_ [_ [_ E]]]. intuition. }
  destruct (@exists_last _ (i :: later)) as [past [now E]]; [discriminate|].
  assert (W : earlier ++ i :: later = (earlier ++ past) ++ [now]) by (rewrite E; apply app_assoc).
  assert (N : last later i = now).
  { transitivity (last (i :: later) i); [destruct later; reflexivity|].
    rewrite E. apply last_last. }
  cbn [law_open]. rewrite N, W. rewrite W in O. split.
  - intro H. destruct (is_triggered i R) eqn:T.
    + simpl in H. apply demand_open_spec in H. apply go_on in H; [|exact O].
      destruct H as [now' [rest [G [O' S]]]]. rewrite <- app_assoc in O', S.
      assert (X : exists i' later', past ++ now' :: rest = i' :: later')
        by (destruct past; simpl; eauto).
      destruct X as [i' [later' X]]. rewrite X in O', S. exists i', later'.
      assert (Gr : grows (i :: later) (i' :: later')) by (exists past, now, now', rest; auto).
      destruct (Same _ _ Gr) as [Ti [_ D]]. split; [exact Gr|]. split; [exact O'|].
      unfold rule_kept. rewrite Ti, D, S. apply implb_true_r.
    + exists i, later. split; [apply grows_refl|]. rewrite W. split; [exact O|].
      unfold rule_kept. rewrite T. reflexivity.
  - intros [i' [later' [Gr [O' K]]]]. destruct (Same _ _ Gr) as [Ti [Tr D]].
    unfold rule_kept in K. destruct (is_triggered i R); [|reflexivity]. rewrite Tr in K by reflexivity.
    simpl in *. rewrite Ti, D in K. apply demand_open_spec, go_on; [exact O|].
    destruct Gr as [past' [m [now' [rest [E' [F G]]]]]]. rewrite E in E'.
    apply app_inj_tail in E'. destruct E' as [<- <-]. rewrite F, app_assoc in K, O'. eauto.
Qed.

(** ** Rules whose conditions speak of no events *)

Definition states_only (f : formula fact) : bool :=
  forallb (fun x => match x with Occurs _ => false | Holds _ => true end) (atoms_of f).

Fixpoint response_states (R : response) : bool :=
  match R with Response _ _ alternatives => forallb (fun a => chain_states (snd a)) alternatives end
with chain_states (c : timed_chain) : bool :=
  match c with
  | TimedChain all inner =>
      forallb response_states all
      && forallb (fun h => states_only (fst h) && chain_states (snd h)) inner
  end.

Definition rule_states (R : timed_rule) : bool :=
  states_only (timed_guard R) && chain_states (timed_response R).

Lemma states_only_grown i i' f :
  grown i i' -> states_only f = true -> eval (context_of i') f = eval (context_of i) f.
Proof.
  intros [_ [C _]] S. apply eval_on_atoms. unfold states_only in S. rewrite forallb_forall in S.
  intros [e|c] I; [discriminate (S _ I)|]. simpl. rewrite C. reflexivity.
Qed.

Lemma response_states_grown r u i i' (G : grown i i') :
  forall R, response_states R = true ->
  forall after, demand_of r u i' after R = demand_of r u i after R
with chain_states_grown r u i i' (G : grown i i') :
  forall c, chain_states c = true ->
  forall after, chain_demand r u i' after c = chain_demand r u i after c.
Proof.
  - intros [l w alternatives] S after. cbn [response_states demand_of] in *.
    assert (B : forall b, seconds i' b = seconds i b).
    { intros [s|m]; [reflexivity|]. simpl. destruct G as [_ [_ [L _]]]. rewrite L. reflexivity. }
    assert (E : occurrence_of u i' after l w = occurrence_of u i after l w).
    { destruct w as [[a [b|]]|]; simpl; rewrite ?B; reflexivity. }
    rewrite E. destruct alternatives as [|a rest]; [reflexivity|]. f_equal. f_equal.
    generalize dependent (a :: rest). clear a rest. intros alternatives S.
    induction alternatives as [|a rest IH]; [reflexivity|].
    cbn [map forallb] in *. apply andb_true_iff in S. destruct S as [A S].
    rewrite (chain_states_grown r u i i' G (snd a) A), (IH S). reflexivity.
  - intros [all inner] S after. cbn [chain_states chain_demand] in *.
    apply andb_true_iff in S. destruct S as [A H]. f_equal; [|f_equal].
    + f_equal. clear - H G. induction inner as [|h inner IH]; [reflexivity|]. cbn [map forallb] in *.
      rewrite !andb_true_iff in H. destruct H as [[F _] H].
      rewrite (states_only_grown i i' _ G F), (IH H). reflexivity.
    + f_equal. induction all as [|x all IH]; [reflexivity|]. cbn [map forallb] in *.
      apply andb_true_iff in A. destruct A as [X A].
      rewrite (response_states_grown r u i i' G x X), (IH A). reflexivity.
    + induction inner as [|h inner IH]; [reflexivity|]. cbn [map forallb] in *.
      rewrite !andb_true_iff in H. destruct H as [[_ F] H].
      rewrite (chain_states_grown r u i i' G (snd h) F), (IH H). reflexivity.
Qed.

Lemma rule_states_unaffected r u i R : rule_states R = true -> unaffected r u i R.
Proof.
  intros S i' G. apply andb_true_iff in S. destruct S as [A B]. split.
  - apply states_only_grown; assumption.
  - apply chain_states_grown; assumption.
Qed.
