(** Continuations: more events occur at the last instant of a history, and later instants follow. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace History Continuation.
Import ListNotations.
Local Open Scope Z_scope.

(** * Continuations *)

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
