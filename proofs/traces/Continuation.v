(** A history violates a law exactly if every continuation violates it: [History.v] is right. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints.
From Traces Require Import Trace History.
Import ListNotations.
Local Open Scope Z_scope.

(** * Order *)

Definition before (i j : instant) : Prop := time i < time j.

(** The earliest instant first, each time once. *)
Definition ordered (tr : trace) : Prop := StronglySorted before tr.

(** What may follow from [now] on. *)
Definition from (now : Z) (c : trace) : Prop := ordered c /\ Forall (fun i => now <= time i) c.

Lemma ordered_app a b :
  ordered (a ++ b) <-> ordered a /\ ordered b /\ forall i j, In i a -> In j b -> time i < time j.
Proof.
  unfold ordered. induction a as [|x a IH]; simpl.
  - split; [|tauto]. intro H. split; [constructor|]. split; [exact H|]. intros i j [].
  - split.
    + intro H. inversion H as [|y l S F]; subst. apply IH in S. destruct S as [A [B C]].
      rewrite Forall_app in F. destruct F as [Fa Fb]. rewrite Forall_forall in Fb.
      split; [constructor; assumption|]. split; [exact B|].
      intros i j [<-|I] J; [apply Fb, J|auto].
    + intros [A [B C]]. inversion A as [|y l S F]; subst. constructor.
      * apply IH. auto.
      * rewrite Forall_app. split; [exact F|]. apply Forall_forall. intros j J. apply C; auto.
Qed.

Lemma same_time tr i j : ordered tr -> In i tr -> In j tr -> time i = time j -> i = j.
Proof.
  unfold ordered. induction tr as [|x tr IH]; [intros _ []|].
  intros O I J T. inversion O as [|y l S F]; subst. rewrite Forall_forall in F. unfold before in F.
  destruct I as [<-|I], J as [<-|J]; auto.
  - specialize (F j J). lia.
  - specialize (F i I). lia.
Qed.

Lemma from_after now i later : ordered (i :: later) -> now <= time i -> from now (i :: later).
Proof.
  intros O L. split; [exact O|]. inversion O as [|y l S F]; subst. constructor; [exact L|].
  rewrite Forall_forall in *. intros j J. specialize (F j J). unfold before in F. lia.
Qed.

(** * Demands *)

Lemma demand_ind_deep (P : demand -> Prop) :
  (forall o, P (Atomic o)) ->
  (forall ds, Forall P ds -> P (Every ds)) ->
  (forall ds, Forall P ds -> P (Either ds)) -> forall d, P d.
Proof.
  intros A E S. fix IH 1. intros [o|ds|ds]; [apply A|apply E|apply S];
    induction ds; constructor; auto.
Qed.

Lemma occurs_app a b since o : occurs (a ++ b) since o = occurs a since o || occurs b since o.
Proof. apply existsb_app. Qed.

Lemma satisfied_ext tr tr' since d :
  (forall o, occurs tr since o = occurs tr' since o) -> satisfied tr since d = satisfied tr' since d.
Proof.
  intro H. induction d as [o|ds IH|ds IH] using demand_ind_deep; cbn [satisfied].
  - unfold met. rewrite H. reflexivity.
  - induction IH; cbn [forallb]; congruence.
  - induction IH; cbn [existsb]; congruence.
Qed.

Lemma ways_spec tr since d :
  satisfied tr since d = existsb (forallb (met tr since)) (ways d).
Proof.
  induction d as [o|ds IH|ds IH] using demand_ind_deep; cbn [satisfied ways].
  - simpl. rewrite andb_true_r, orb_false_r. reflexivity.
  - induction IH as [|d ds H _ IH]; [reflexivity|]. cbn [forallb fold_right]. rewrite H, IH. clear.
    set (rest := fold_right _ _ _). clearbody rest.
    induction (ways d) as [|w ws IHw]; [reflexivity|]. cbn [existsb flat_map].
    rewrite existsb_app, andb_orb_distrib_l, IHw. f_equal. clear.
    induction rest as [|v rest IHr]; simpl; [apply andb_false_r|].
    rewrite forallb_app, andb_orb_distrib_r, IHr. reflexivity.
  - induction IH as [|d ds H _ IH]; [reflexivity|]. cbn [existsb flat_map].
    rewrite existsb_app, H, IH. reflexivity.
Qed.

(** ** Room for an event *)

Lemma greatest_below (xs : list Z) x z :
  In x xs -> x <= z -> exists m, In m xs /\ m <= z /\ forall y, In y xs -> y <= z -> y <= m.
Proof.
  revert x. induction xs as [|a xs IH]; intros x I L; [destruct I|].
  assert (D : (exists y, In y xs /\ y <= z) \/ forall y, In y xs -> ~ y <= z).
  { clear. induction xs as [|b xs IH]; [right; intros y []|].
    destruct (Z_le_gt_dec b z); [left; exists b; simpl; auto|].
    destruct IH as [[y [I L]]|N]; [left; exists y; simpl; auto|].
    right. intros y [<-|I]; [lia|auto]. }
  destruct D as [[y [I' L']]|N].
  - destruct (IH y I' L') as [m [Im [Lm M]]].
    destruct (Z_le_gt_dec a z), (Z_le_gt_dec a m); try (exists m; simpl; repeat split; auto;
      intros w [<-|W] Lw; auto; lia).
    exists a. simpl. repeat split; auto. intros w [<-|W] Lw; [lia|]. specialize (M w W Lw). lia.
  - destruct I as [<-|I]; [|destruct (N x I L)].
    exists a. simpl. repeat split; auto. intros w [<-|W] Lw; [lia|destruct (N w W Lw)].
Qed.

Lemma room_spec now since way o :
  room now since way o = true <->
  exists z, now <= z /\ covers o since z = true
            /\ existsb (forbids since (about (what o)) z) way = false.
Proof.
  unfold room. rewrite existsb_exists. split.
  - intros [z [_ H]]. rewrite !andb_true_iff, negb_true_iff, Z.leb_le in H. exists z. tauto.
  - intros [z [N [C F]]].
    assert (L : Z.max now (since + first o) <= z).
    { unfold covers in C. apply andb_true_iff in C. destruct C as [C _].
      apply Z.leb_le in C. lia. }
    destruct (greatest_below (candidates now since way o) _ z (or_introl eq_refl) L)
      as [m [I [M G]]].
    pose proof (G _ (or_introl eq_refl) L) as Lm.
    exists m. split; [exact I|]. rewrite !andb_true_iff, negb_true_iff, Z.leb_le. repeat split.
    + lia.
    + unfold covers in *. apply andb_true_iff in C. destruct C as [C1 C2].
      apply andb_true_iff. split; [apply Z.leb_le; lia|].
      destruct (final o); [|reflexivity]. apply Z.leb_le in C2. apply Z.leb_le. lia.
    + apply not_true_is_false. intro X. apply existsb_exists in X. destruct X as [p [Ip X]].
      unfold forbids in X. apply andb_true_iff in X. destruct X as [X Cp].
      assert (Nz : covers p since z = false).
      { apply not_true_is_false. intro Y. apply not_true_iff_false in F. apply F.
        apply existsb_exists. exists p. unfold forbids. rewrite X, Y. auto. }
      unfold covers in Cp, Nz. apply andb_true_iff in Cp. destruct Cp as [P1 P2].
      apply Z.leb_le in P1. rewrite (proj2 (Z.leb_le _ _)) in Nz by lia.
      destruct (final p) as [e|] eqn:E; [|discriminate]. apply Z.leb_gt in Nz. apply Z.leb_le in P2.
      assert (In (since + e + 1) (candidates now since way o)).
      { right. apply in_flat_map. exists p. rewrite E. simpl. auto. }
      specialize (G _ H). lia.
Qed.

(** ** Going on *)

(** At every second from [now] on, all that the way does not forbid. *)
Definition all_allowed (now since : Z) (way : list occurrence) (n : nat) : instant :=
  let at_ := now + Z.of_nat n in
  Instant at_ (fun e => negb (existsb (forbids since e at_) way)) (fun _ => false) (fun _ => 0).

Lemma all_allowed_from now since way len :
  from now (map (all_allowed now since way) (seq 0 len)).
Proof.
  split.
  - unfold ordered. generalize 0%nat. induction len as [|len IH]; intro k; simpl; constructor; auto.
    apply Forall_forall. intros j J. apply in_map_iff in J. destruct J as [n [<- J]].
    apply in_seq in J. unfold before. simpl. lia.
  - apply Forall_forall. intros j J. apply in_map_iff in J. destruct J as [n [<- J]]. simpl. lia.
Qed.

Lemma way_open_spec h now since way :
  way_open h now since way = true <->
  exists c, from now c /\ forallb (met (h ++ c) since) way = true.
Proof.
  unfold way_open. rewrite forallb_forall. split.
  - intro H.
    assert (B : exists len, forall o, In o way -> positive_literal (what o) = true ->
              occurs h since o = false ->
              occurs (map (all_allowed now since way) (seq 0 len)) since o = true).
    { assert (G : forall os, incl os way -> exists len, forall len', (len <= len')%nat ->
                forall o, In o os -> positive_literal (what o) = true -> occurs h since o = false ->
                occurs (map (all_allowed now since way) (seq 0 len')) since o = true).
      { induction os as [|o os IH]; intro S; [exists 0%nat; intros len' _ o []|].
        destruct IH as [len L]; [intros x X; apply S; simpl; auto|].
        assert (O : exists l', forall len', (l' <= len')%nat ->
                  positive_literal (what o) = true -> occurs h since o = false ->
                  occurs (map (all_allowed now since way) (seq 0 len')) since o = true).
        { specialize (H o (S o (or_introl eq_refl))).
          destruct (positive_literal (what o)) eqn:P; [|exists 0%nat; discriminate].
          destruct (occurs h since o) eqn:Q; [exists 0%nat; discriminate|].
          simpl in H. apply room_spec in H. destruct H as [z [N [C F]]].
          exists (Datatypes.S (Z.to_nat (z - now))). intros len' L' _ _.
          apply existsb_exists. exists (all_allowed now since way (Z.to_nat (z - now))). split.
          - apply in_map, in_seq. lia.
          - simpl. rewrite Z2Nat.id by lia. replace (now + (z - now)) with z by lia.
            rewrite F, C. reflexivity. }
        destruct O as [l' O]. exists (Nat.max len l'). intros len' M x [<-|X]; [apply O; lia|].
        apply L; [lia|exact X]. }
      destruct (G way (incl_refl _)) as [len L]. exists len. apply L. auto. }
    destruct B as [len B]. exists (map (all_allowed now since way) (seq 0 len)).
    split; [apply all_allowed_from|]. apply forallb_forall. intros o I. unfold met.
    rewrite occurs_app. specialize (H o I). destruct (positive_literal (what o)) eqn:P.
    + destruct (occurs h since o) eqn:Q; [reflexivity|]. apply B; assumption.
    + apply negb_true_iff in H. rewrite H. apply negb_true_iff, not_true_is_false. intro X.
      apply existsb_exists in X. destruct X as [j [J X]]. apply in_map_iff in J.
      destruct J as [n [<- _]]. apply andb_true_iff in X. destruct X as [E C]. simpl in E, C.
      apply negb_true_iff, not_true_iff_false in E. apply E. apply existsb_exists. exists o.
      split; [exact I|]. unfold forbids. rewrite P, C, Pos.eqb_refl. reflexivity.
  - intros [c [[_ Fc] M]] o I. rewrite forallb_forall in M. pose proof (M o I) as Mo.
    unfold met in Mo. rewrite occurs_app in Mo. rewrite Forall_forall in Fc.
    destruct (positive_literal (what o)) eqn:P.
    + destruct (occurs h since o); [reflexivity|]. simpl in *. apply room_spec.
      apply existsb_exists in Mo. destruct Mo as [j [J Mo]]. apply andb_true_iff in Mo.
      destruct Mo as [E C]. exists (time j). split; [apply Fc, J|]. split; [exact C|].
      apply not_true_is_false. intro X. apply existsb_exists in X. destruct X as [p [Ip X]].
      unfold forbids in X. rewrite !andb_true_iff, negb_true_iff in X. destruct X as [[Np Ep] Cp].
      apply Pos.eqb_eq in Ep. specialize (M p Ip). unfold met in M. rewrite Np, occurs_app in M.
      apply negb_true_iff, orb_false_iff in M. destruct M as [_ M].
      apply not_true_iff_false in M. apply M. apply existsb_exists. exists j.
      rewrite Ep, E, Cp. auto.
    + apply negb_true_iff, orb_false_iff in Mo. rewrite (proj1 Mo). reflexivity.
Qed.

Theorem demand_open_spec h now since d :
  demand_open h now since d = true <->
  exists c, from now c /\ satisfied (h ++ c) since d = true.
Proof.
  unfold demand_open. rewrite existsb_exists. split.
  - intros [w [I H]]. apply way_open_spec in H. destruct H as [c [F H]]. exists c.
    split; [exact F|]. rewrite ways_spec. apply existsb_exists. eauto.
  - intros [c [F H]]. rewrite ways_spec in H. apply existsb_exists in H. destruct H as [w [I H]].
    exists w. split; [exact I|]. apply way_open_spec. eauto.
Qed.
