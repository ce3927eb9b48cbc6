(** [broken_so_far] is exact for rules: a history violates a rule at an instant if and
    only if every continuation violates it there. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace History Continuation Growth.
Import ListNotations.
Local Open Scope Z_scope.

(** * What decides a rule *)

(** The two instants differ in events only, and not in these. *)
Definition alike (i i' : instant) (es : list name) : Prop :=
  time i' = time i /\ conditions i' = conditions i /\ lengths i' = lengths i
  /\ forall e, In e es -> events i' e = events i e.

Lemma alike_fewer i i' es es' : incl es' es -> alike i i' es -> alike i i' es'.
Proof. intros I [T [C [L E]]]. repeat split; auto. Qed.

Lemma alike_eval i i' f :
  alike i i' (events_in f) -> eval (context_of i') f = eval (context_of i) f.
Proof.
  intros [_ [C [_ E]]]. apply eval_on_atoms. intros [e|c] I; simpl; [|rewrite C; reflexivity].
  apply E, in_flat_map. exists (Occurs e). simpl. auto.
Qed.

Lemma response_alike r u i i' :
  forall R, alike i i' (response_events R) ->
  forall after, demand_of r u i' after R = demand_of r u i after R
with chain_alike r u i i' :
  forall c, alike i i' (chain_events c) ->
  forall after, chain_demand r u i' after c = chain_demand r u i after c.
Proof.
  - intros [l w alternatives] A after. cbn [response_events demand_of] in *.
    assert (B : forall b, seconds i' b = seconds i b).
    { intros [s|m]; [reflexivity|]. simpl. destruct A as [_ [_ [L _]]]. rewrite L. reflexivity. }
    assert (E : occurrence_of u i' after l w = occurrence_of u i after l w).
    { destruct w as [[a [b|]]|]; simpl; rewrite ?B; reflexivity. }
    rewrite E. destruct alternatives as [|a rest]; [reflexivity|]. f_equal. f_equal.
    generalize dependent (a :: rest). clear a rest. intros alternatives A.
    induction alternatives as [|a rest IH]; [reflexivity|]. cbn [map flat_map] in *.
    rewrite (chain_alike r u i i' (snd a)), IH; [reflexivity| |];
      eapply alike_fewer; try exact A; auto using incl_appr, incl_appl, incl_refl.
  - intros [all inner] A after. cbn [chain_events chain_demand] in *.
    pose proof (alike_fewer _ _ _ _ (incl_appl _ (incl_refl _)) A) as Aa.
    pose proof (alike_fewer _ _ _ _ (incl_appr _ (incl_refl _)) A) as Ai. clear A.
    f_equal; [|f_equal].
    + f_equal. clear - Ai. induction inner as [|h inner IH]; [reflexivity|].
      cbn [map flat_map] in *. rewrite (alike_eval i i' (fst h)), IH; [reflexivity| |];
        eapply alike_fewer; try exact Ai; auto using incl_appr, incl_appl, incl_refl.
    + f_equal. clear - Aa response_alike. induction all as [|x all IH]; [reflexivity|].
      cbn [map flat_map] in *. rewrite (response_alike r u i i' x), IH; [reflexivity| |];
        eapply alike_fewer; try exact Aa; auto using incl_appr, incl_appl, incl_refl.
    + clear - Ai chain_alike. induction inner as [|h inner IH]; [reflexivity|].
      cbn [map flat_map] in *. rewrite (chain_alike r u i i' (snd h)), IH; [reflexivity| |];
        eapply alike_fewer; try exact Ai; auto using incl_appr, incl_appl, incl_refl.
Qed.

Lemma rule_alike r u i i' R :
  alike i i' (rule_events R) ->
  eval (context_of i') (timed_guard R) = eval (context_of i) (timed_guard R)
  /\ rule_demand r u i' R = rule_demand r u i R.
Proof.
  intro A. split.
  - apply alike_eval. eapply alike_fewer; [|exact A]. unfold rule_events. auto using incl_appl, incl_refl.
  - apply chain_alike. eapply alike_fewer; [|exact A]. unfold rule_events. auto using incl_appr, incl_refl.
Qed.

(** * Rules *)

(** Of the events of an instant of a trace, none occurs at that time at another one. *)
Lemma absent_spec tr i i' es :
  ordered tr -> In i' tr -> time i' = time i ->
  forallb (satisfied tr (time i)) (absent i es) = true <->
  forall e, In e es -> events i e = false -> events i' e = false.
Proof.
  intros O I T. unfold absent. rewrite forallb_forall.
  assert (S : forall e, satisfied tr (time i) (Atomic (Occurrence (Avoid e) 0 (Some 0)))
                        = negb (events i' e)).
  { intro e. cbn [satisfied]. unfold met. cbn [what positive_literal]. f_equal.
    apply Bool.eq_true_iff_eq. unfold occurs. rewrite existsb_exists. cbn [what about]. split.
    - intros [j [J H]]. apply andb_true_iff in H. destruct H as [E C]. unfold covers in C.
      cbn [first final] in C. rewrite andb_true_iff, !Z.leb_le in C.
      rewrite (same_time tr i' j O I J) by lia. exact E.
    - intro E. exists i'. split; [exact I|]. rewrite E. unfold covers. cbn [first final].
      rewrite andb_true_l, andb_true_iff, !Z.leb_le. lia. }
  split.
  - intros H e Ie X. apply negb_true_iff. rewrite <- S. apply H.
    apply in_map_iff. exists e. split; [reflexivity|]. apply filter_In. rewrite X. auto.
  - intros H d D. apply in_map_iff in D. destruct D as [e [<- D]]. apply filter_In in D.
    rewrite S. apply negb_true_iff, H; [apply D|]. apply negb_true_iff, D.
Qed.

(** Of what else may occur now, only the events that conditions of the rule name matter. *)
Lemma valuations_only names w o : In w (valuations names) -> w o = true -> In o names.
Proof.
  revert w. induction names as [|p names IH]; simpl; intros w I T.
  - destruct I as [<-|[]]. discriminate.
  - apply in_flat_map in I. destruct I as [w' [I [<-|[<-|[]]]]]; [right; eauto|].
    destruct (Pos.eqb_spec o p) as [->|N]; [auto|right; eauto].
Qed.

Lemma rule_now_exact r u earlier i R :
  ordered (earlier ++ [i]) ->
  law_open r u earlier i [] (RuleLaw R) = true <->
  exists i' later', grown i i' /\ ordered (earlier ++ i' :: later')
                    /\ rule_kept r u (earlier ++ i' :: later') i' R = true.
Proof.
  intro O. cbn [law_open]. rewrite existsb_exists. unfold rule_open, rule_kept.
  set (es := nodup Pos.eq_dec (rule_events R)).
  assert (Es : forall e, In e (rule_events R) -> In e es) by (intros e E; apply nodup_In, E).
  split.
  - intros [w [_ H]]. set (n := with_events i w) in *.
    assert (On : ordered (earlier ++ [n])) by (eapply ordered_grown; [exact O|apply with_events_grown]).
    destruct (is_triggered n R) eqn:T.
    + cbn [implb] in H. change (time i) with (time n) in H.
      apply demand_open_spec in H. apply go_on in H; [|exact On].
      destruct H as [i' [later [G [O' S]]]]. exists i', later.
      split; [|split; [exact O'|]].
      * destruct G as [Gt [Gc [Gl Ge]]]. repeat split; auto. intros e X. apply Ge. simpl.
        rewrite X. reflexivity.
      * cbn [satisfied forallb] in S. apply andb_true_iff in S. destruct S as [S A].
        assert (I : In i' (earlier ++ i' :: later)) by apply in_elt.
        rewrite (absent_spec _ n i' es O' I (proj1 G)) in A.
        assert (Al : alike n i' (rule_events R)).
        { destruct G as [Gt [Gc [Gl Ge]]]. repeat split; auto. intros e E.
          destruct (events n e) eqn:X; [apply Ge, X|]. apply A; auto. }
        destruct (rule_alike r u n i' R Al) as [_ D].
        rewrite (proj1 G), D, S. apply implb_true_r.
    + exists n, []. split; [apply with_events_grown|]. split; [exact On|]. rewrite T. reflexivity.
  - intros [i' [later [G [O' K]]]].
    destruct (valuations_complete es (events i')) as [w [W V]]. exists w. split; [exact W|].
    set (n := with_events i w). change (time i) with (time n).
    assert (Gn : grown n i').
    { destruct G as [Gt [Gc [Gl Ge]]]. repeat split; auto. intros e X. simpl in X.
      apply orb_true_iff in X. destruct X as [X|X]; [auto|].
      rewrite <- (V e); [exact X|]. eapply valuations_only; eassumption. }
    assert (Named : forall e, In e es -> events i' e = events n e).
    { intros e E. simpl. rewrite (V e E). destruct (events i e) eqn:X; [|reflexivity].
      apply (proj2 (proj2 (proj2 G))), X. }
    assert (Al : alike n i' (rule_events R)).
    { destruct Gn as [Gt [Gc [Gl _]]]. repeat split; auto. }
    destruct (rule_alike r u n i' R Al) as [Eg D].
    destruct (is_triggered n R) eqn:T; [|reflexivity]. cbn [implb].
    assert (T' : is_triggered i' R = true).
    { unfold is_triggered in *. rewrite Eg. apply andb_true_iff in T. apply andb_true_iff.
      split; [|apply T]. apply (proj2 (proj2 (proj2 Gn))), T. }
    rewrite T' in K. cbn [implb] in K.
    apply demand_open_spec, go_on; [eapply ordered_grown; [exact O|apply with_events_grown]|].
    exists i', later. split; [exact Gn|]. split; [exact O'|].
    cbn [satisfied forallb]. rewrite (proj1 Gn), D in K. rewrite K. cbn [andb].
    apply (absent_spec _ n i' es O' (in_elt _ _ _) (proj1 Gn)). intros e E X.
    rewrite (Named e E). exact X.
Qed.

Lemma rule_past_exact r u earlier i j later R :
  ordered (earlier ++ i :: j :: later) ->
  law_open r u earlier i (j :: later) (RuleLaw R) = true <->
  exists later', grows (i :: j :: later) (i :: later') /\ ordered (earlier ++ i :: later')
                 /\ rule_kept r u (earlier ++ i :: later') i R = true.
Proof.
  intro O. cbn [law_open]. unfold rule_open, rule_kept.
  assert (E : exists past now, j :: later = past ++ [now] /\ last (j :: later) i = now).
  { destruct (@exists_last _ (j :: later)) as [past [now E]]; [discriminate|].
    exists past, now. split; [exact E|]. rewrite E. apply last_last. }
  destruct E as [past [now [E L]]]. rewrite L. rewrite E in *.
  assert (W : forall x, earlier ++ i :: past ++ x = (earlier ++ i :: past) ++ x)
    by (intro x; rewrite <- app_assoc; reflexivity).
  rewrite W. rewrite W in O. destruct (is_triggered i R) eqn:T; cbn [implb].
  - rewrite demand_open_spec, (go_on _ _ _ _ O). split.
    + intros [now' [rest [G [O' S]]]]. exists (past ++ now' :: rest). rewrite W.
      split; [exists (i :: past), now, now', rest; auto|]. split; [exact O'|].
      cbn [satisfied forallb] in S. rewrite andb_true_r in S. exact S.
    + intros [later' [[past' [m [now' [rest [F [F' G]]]]]] [O' K]]].
      change (i :: past ++ [now]) with ((i :: past) ++ [now]) in F.
      apply app_inj_tail in F. destruct F as [<- <-]. injection F' as F'. subst later'.
      rewrite W in O', K. exists now', rest. split; [exact G|]. split; [exact O'|].
      cbn [satisfied forallb]. rewrite andb_true_r. exact K.
  - split; [|reflexivity]. intros _. exists (past ++ [now]). rewrite W.
    split; [apply grows_refl|]. split; [exact O|reflexivity].
Qed.

Lemma rule_open_exact r u earlier i later R :
  ordered (earlier ++ i :: later) ->
  law_open r u earlier i later (RuleLaw R) = true <->
  exists i' later', grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')
                    /\ rule_kept r u (earlier ++ i' :: later') i' R = true.
Proof.
  intro O. destruct later as [|j later].
  - rewrite rule_now_exact by exact O.
    split; intros [i' [later' [G H]]]; exists i', later'; (split; [|exact H]).
    + exists [], i, i', later'. auto.
    + apply grows_first in G. apply G.
  - rewrite rule_past_exact by exact O. split.
    + intros [later' H]. exists i, later'. exact H.
    + intros [i' [later' [G H]]]. pose proof (proj2 (grows_first _ _ _ _ G)) as X.
      rewrite X in * by discriminate. exists later'. auto.
Qed.
