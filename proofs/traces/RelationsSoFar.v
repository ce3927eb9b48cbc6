(** [broken_so_far] is exact for relations, and so for all laws. *)

From Coq Require Import List Bool PArith ZArith Lia.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace History Continuation Growth RulesSoFar.
Import ListNotations.
Local Open Scope Z_scope.

Lemma can_hold_spec i f :
  can_hold i f = true <-> exists i', grown i i' /\ eval (context_of i') f = true.
Proof.
  unfold can_hold. rewrite existsb_exists. split.
  - intros [w [_ H]]. exists (with_events i w). split; [apply with_events_grown|exact H].
  - intros [i' [[_ [C [_ E]]] H]].
    destruct (valuations_complete (nodup Pos.eq_dec (events_in f)) (events i')) as [w [W V]].
    exists w. split; [exact W|]. rewrite <- H. apply eval_on_atoms. intros [e|c] I; simpl.
    + rewrite V.
      * destruct (events i e) eqn:X; [rewrite (E _ X)|]; reflexivity.
      * apply nodup_In, in_flat_map. exists (Occurs e). simpl. auto.
    + rewrite C. reflexivity.
Qed.

Lemma begins_grown e c i i' : grown i i' -> begins e c i = true -> begins e c i' = true.
Proof.
  intros [_ [C [_ E]]]. unfold begins. rewrite !andb_true_iff. intros [X Y]. split; [apply E, X|].
  unfold in_state in *. rewrite C. exact Y.
Qed.

Lemma lasts_prefix over p past now now' later :
  over now = over now' -> p now = p now' ->
  lasts over p (past ++ now' :: later) = true -> lasts over p (past ++ [now]) = true.
Proof.
  intros O P. induction past as [|i past IH]; simpl.
  - rewrite O, P. destruct (over now'), (p now'); simpl; auto.
  - destruct (over i), (p i); simpl; auto.
Qed.

(** [can] says what [now] says of the last instant: it may end there, or last. *)
Lemma lasts_so_far_spec over p can past now :
  (can now = true <-> exists now', grown now now' /\ over now' || p now' = true) ->
  lasts_so_far over p can (past ++ [now]) = true <->
  exists now' later, grown now now' /\ lasts over p (past ++ now' :: later) = true.
Proof.
  intro S. induction past as [|i past IH]; cbn [app lasts].
  - cbn [lasts_so_far]. rewrite S. split.
    + intros [now' [G H]]. exists now', []. split; [exact G|]. simpl. rewrite andb_true_r. exact H.
    + intros [now' [later [G H]]]. exists now'. split; [exact G|].
      destruct (over now'), (p now'); simpl in *; auto.
  - assert (X : lasts_so_far over p can (i :: past ++ [now])
                = over i || (p i && lasts_so_far over p can (past ++ [now])))
      by (destruct past; reflexivity).
    rewrite X. destruct (over i); simpl.
    + split; [intros _|auto]. exists now, []. auto using grown_refl.
    + destruct (p i); simpl; [exact IH|]. split; [discriminate|]. intros [? [? [_ ?]]]. discriminate.
Qed.

Lemma relation_open_exact earlier i later rel :
  ordered (earlier ++ i :: later) ->
  relation_open earlier i later rel = true <->
  exists i' later', grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')
                    /\ relation_kept earlier i' later' rel = true.
Proof.
  intro O.
  destruct (@exists_last _ (i :: later)) as [past [now E]]; [discriminate|].
  assert (Stay : relation_kept earlier i later rel = true ->
            exists i' later', grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')
                              /\ relation_kept earlier i' later' rel = true).
  { intro K. exists i, later. auto using grows_refl. }
  assert (Whole : forall now' rest, grown now now' -> ordered (earlier ++ past ++ now' :: rest) ->
            exists i' later', i' :: later' = past ++ now' :: rest
              /\ grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')).
  { intros now' rest G Or. destruct past as [|x past]; simpl in *; do 2 eexists;
      (split; [reflexivity|]); (split; [|exact Or]);
      [exists [], now, now', rest|exists (x :: past), now, now', rest]; auto. }
  assert (Split : forall i' later', grows (i :: later) (i' :: later') -> exists now' rest,
            grown now now' /\ i' :: later' = past ++ now' :: rest).
  { intros i' later' [past' [m [now' [rest [E' [F G]]]]]]. rewrite E in E'.
    apply app_inj_tail in E'. destruct E' as [<- <-]. eauto. }
  assert (Simple : (match rel with HappenBefore _ _ | Until _ _ _ _ _ | For _ _ _ _ => False
                              | _ => True end) ->
            relation_open earlier i later rel = true <->
            exists i' later', grows (i :: later) (i' :: later')
              /\ ordered (earlier ++ i' :: later') /\ eval (context_of i') (invariant rel) = true).
  { intro K. destruct later as [|j later].
    - transitivity (can_hold i (invariant rel) = true); [destruct rel; (reflexivity || destruct K)|].
      rewrite can_hold_spec. split.
      + intros [i' [G H]]. exists i', []. split; [exists [], i, i', []; auto|].
        split; [eapply ordered_grown; eassumption|exact H].
      + intros [i' [later' [G [_ H]]]]. apply grows_first in G. exists i'. tauto.
    - transitivity (eval (context_of i) (invariant rel) = true);
        [destruct rel; (reflexivity || destruct K)|]. split.
      + intro H. exists i, (j :: later). auto using grows_refl.
      + intros [i' [later' [G [_ H]]]]. apply grows_first in G. destruct G as [_ G].
        rewrite <- G by discriminate. exact H. }
  destruct rel as [a b|a b|a b|a b|p q|p q|p q|p|e p|e p|e p|e c p stop d|e c p length|k];
    try (apply Simple; exact I); clear Simple.
  - (* HappenBefore *)
    assert (X : relation_open earlier i later (HappenBefore a b)
                = relation_kept earlier i later (HappenBefore a b)) by reflexivity.
    rewrite X. split; [exact Stay|]. intros [i' [later' [G [_ K]]]]. cbn [relation_kept] in *.
    apply grows_first in G. destruct G as [[_ [_ [_ G]]] _].
    destruct (events i b) eqn:B; [rewrite (G _ B) in K; exact K|reflexivity].
  - (* Until *)
    cbn [relation_open]. destruct (begins e c i) eqn:B.
    + cbn [implb]. rewrite E at 1. rewrite lasts_so_far_spec.
      * split.
        -- intros [now' [rest [G K]]].
           assert (Or : ordered (earlier ++ past ++ [now'])).
           { rewrite app_assoc. eapply ordered_grown; [|exact G]. rewrite <- app_assoc, <- E. exact O. }
           destruct (Whole now' [] G Or) as [i' [later' [F [Gr Or']]]]. exists i', later'.
           split; [exact Gr|]. split; [exact Or'|]. cbn [relation_kept]. rewrite F.
           rewrite (lasts_prefix _ _ past now' now' rest eq_refl eq_refl K). apply implb_true_r.
        -- intros [i' [later' [Gr [_ K]]]]. destruct (Split _ _ Gr) as [now' [rest [G F]]].
           exists now', rest. split; [exact G|]. cbn [relation_kept] in K.
           rewrite (begins_grown _ _ _ _ (proj1 (grows_first _ _ _ _ Gr)) B), F in K. exact K.
      * rewrite can_hold_spec. split; intros [now' [G H]]; exists now'; (split; [exact G|]);
          revert H; cbn [eval]; rewrite !eval_situation_of; unfold begins;
          rewrite orb_comm; auto.
    + cbn [implb]. split; [|reflexivity]. intros _. apply Stay. cbn [relation_kept].
      rewrite B. reflexivity.
  - (* For *)
    assert (X : relation_open earlier i later (For e c p length)
                = relation_kept earlier i later (For e c p length)) by reflexivity.
    rewrite X. split; [exact Stay|]. intros [i' [later' [Gr [_ K]]]]. cbn [relation_kept] in *.
    destruct (begins e c i) eqn:B; [|reflexivity]. pose proof (grows_first _ _ _ _ Gr) as [Gi _].
    rewrite (begins_grown _ _ _ _ Gi B) in K. simpl in K |- *.
    destruct (Split _ _ Gr) as [now' [rest [G F]]].
    change (lasts (fun j => time i + seconds i length <=? time j)
                  (fun j => in_state j p) (i :: later) = true).
    change (lasts (fun j => time i' + seconds i' length <=? time j)
                  (fun j => in_state j p) (i' :: later') = true) in K.
    assert (L : time i' + seconds i' length = time i + seconds i length).
    { destruct Gi as [T [_ [Le _]]]. rewrite T. destruct length; simpl; rewrite ?Le; reflexivity. }
    rewrite L in K. rewrite F in K. rewrite E. eapply lasts_prefix; [| |exact K].
    + destruct G as [T _]. rewrite T. reflexivity.
    + destruct G as [_ [C _]]. unfold in_state. rewrite C. reflexivity.
Qed.

(** * All laws *)

(** A law can still be kept at an instant of a history if and only if some continuation
    keeps it there. *)
Theorem law_open_exact r u earlier i later k :
  ordered (earlier ++ i :: later) ->
  law_open r u earlier i later k = true <->
  exists i' later', grows (i :: later) (i' :: later') /\ ordered (earlier ++ i' :: later')
                    /\ law_kept r u earlier i' later' k = true.
Proof.
  intro O. destruct k as [R|rel]; [apply rule_open_exact, O|].
  transitivity (relation_open earlier i later rel = true); [destruct later; reflexivity|].
  apply relation_open_exact, O.
Qed.

(** Exactly what [broken_so_far] reports is violated in every continuation. *)
Theorem broken_so_far_exact r u laws h :
  ordered h ->
  forall n earlier i later, nth_error (moments [] h) n = Some (earlier, i, later) ->
  forall m k, nth_error laws m = Some k ->
  (exists bs, nth_error (broken_so_far r u laws h) n = Some bs /\ nth_error bs m = Some true) <->
  forall i' later', grows (i :: later) (i' :: later') -> ordered (earlier ++ i' :: later') ->
    law_kept r u earlier i' later' k = false.
Proof.
  intros O n earlier i later M m k K.
  assert (E : h = earlier ++ i :: later).
  { apply nth_error_In, in_moments in M. destruct M as [e [-> ->]]. reflexivity. }
  assert (X := law_open_exact r u earlier i later k). rewrite <- E in X. specialize (X O).
  unfold broken_so_far. rewrite nth_error_map, M. cbn [option_map]. split.
  - intros [bs [B T]] i' later' G O'. injection B as <-. rewrite nth_error_map, K in T.
    injection T as T. apply negb_true_iff in T. apply not_true_is_false. intro Y.
    rewrite (proj2 X) in T; [discriminate|eauto].
  - intro H. eexists. split; [reflexivity|]. rewrite nth_error_map, K. cbn [option_map].
    do 2 f_equal. apply negb_true_iff, not_true_is_false. intro Y. apply X in Y.
    destruct Y as [i' [later' [G [O' Y]]]]. rewrite (H _ _ G O') in Y. discriminate.
Qed.
