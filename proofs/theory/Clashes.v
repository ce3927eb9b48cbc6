(** Which literals cannot all be due ([sleec_verify/query/inconsistent_sets.py]).

    A constraint over several literals makes "is there a conflicting context" a
    question of the form ∃∀.  What is due are units; so it is enough to know every
    set of literals that the constraints rule out, with the situations in which they
    do.  They are found by resolution on one obligation after the other. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment.
From Sleec Require Export Constraints.
Import ListNotations.

(** * Subsumption *)

Definition subsumes (c d : clash) : bool :=
  forallb (fun l => listed l (literals d)) (literals c)
  && forallb (fun f => if in_dec formula_eq_dec f (labels d) then true else false) (labels c).

Lemma subsumes_spec c d :
  subsumes c d = true <-> incl (literals c) (literals d) /\ incl (labels c) (labels d).
Proof.
  unfold subsumes. rewrite andb_true_iff, !forallb_forall. split.
  - intros [A B]. split.
    + intros l I. apply listed_In, A, I.
    + intros f I. specialize (B f I). destruct (in_dec _ _ _); [assumption|discriminate].
  - intros [A B]. split.
    + intros l I. apply listed_In, A, I.
    + intros f I. destruct (in_dec _ _ _) as [|N]; [reflexivity|]. destruct (N (B f I)).
Qed.

Definition insert (c : clash) (cs : list clash) : list clash :=
  if existsb (fun d => subsumes d c) cs then cs
  else c :: filter (fun d => negb (subsumes c d)) cs.

(** Those that no other subsumes. *)
Definition minimal (cs : list clash) : list clash := fold_right insert [] cs.

Lemma minimal_incl cs : incl (minimal cs) cs.
Proof.
  induction cs as [|c cs IH]; [apply incl_refl|]. cbn [minimal fold_right].
  fold (minimal cs). unfold insert. destruct (existsb _ _).
  - apply incl_tl, IH.
  - intros d [<-|I]; [left; reflexivity|]. apply filter_In in I. right. apply IH, I.
Qed.

Lemma minimal_covers cs c :
  In c cs -> exists d, In d (minimal cs) /\ subsumes d c = true.
Proof.
  assert (R : forall c, subsumes c c = true).
  { clear. intro c. apply subsumes_spec. split; apply incl_refl. }
  assert (T : forall c d e, subsumes c d = true -> subsumes d e = true -> subsumes c e = true).
  { clear. intros c d e A B. apply subsumes_spec in A. apply subsumes_spec in B.
    apply subsumes_spec. split; eapply incl_tran; [apply A|apply B|apply A|apply B]. }
  revert c. induction cs as [|b cs IH]; intros c [].
  - subst c. cbn [minimal fold_right]. fold (minimal cs). unfold insert.
    destruct (existsb _ _) eqn:E.
    + apply existsb_exists in E. exact E.
    + exists b. split; [left; reflexivity|apply R].
  - destruct (IH c H) as [d [I S]]. cbn [minimal fold_right]. fold (minimal cs). unfold insert.
    destruct (existsb _ _).
    + exists d. auto.
    + destruct (subsumes b d) eqn:B.
      * exists b. split; [left; reflexivity|]. eapply T; eauto.
      * exists d. split; [|exact S]. right. apply filter_In. rewrite B. auto.
Qed.

(** * Resolution *)

(** [c] says that [Do o] clashes, [d] that [Avoid o] does; together the rest. *)
Definition resolvent (o : name) (c d : clash) : clash :=
  Clash (union literal_eq_dec (remove literal_eq_dec (Do o) (literals c))
                              (remove literal_eq_dec (Avoid o) (literals d)))
        (union formula_eq_dec (labels c) (labels d)).

Definition resolvents (o : name) (cs : list clash) : list clash :=
  filter (fun c => negb (contradictory (literals c)))
    (flat_map (fun c => map (resolvent o c) (filter (fun d => listed (Avoid o) (literals d)) cs))
              (filter (fun c => listed (Do o) (literals c)) cs)).

(** A literal of [o] that nothing obliges is never due: its clashes can go, once
    they have been resolved. *)
Definition idle (obliged : list literal) (o : name) (c : clash) : bool :=
  existsb (fun l => Pos.eqb (about l) o && negb (listed l obliged)) (literals c).

Definition resolved (obliged : list literal) (o : name) (cs : list clash) : list clash :=
  filter (fun c => negb (idle obliged o c)) cs ++ resolvents o cs.

(** Where nothing is resolved there is nothing new to be subsumed: with hundreds of
    constraints that look would take most of the time. *)
Definition eliminate_one (obliged : list literal) (o : name) (cs : list clash) : list clash :=
  match resolvents o cs with
  | [] => resolved obliged o cs
  | _ => minimal (resolved obliged o cs)
  end.

Fixpoint eliminate (obliged : list literal) (os : list name) (cs : list clash) : list clash :=
  match os with
  | [] => cs
  | o :: rest => eliminate obliged rest (eliminate_one obliged o cs)
  end.

Definition names_of (cs : list clash) : list name :=
  nodup Pos.eq_dec (flat_map (fun c => map about (literals c)) cs).

Lemma eliminate_one_incl obliged o cs :
  incl (eliminate_one obliged o cs) (resolved obliged o cs).
Proof.
  unfold eliminate_one. destruct (resolvents o cs); [apply incl_refl|apply minimal_incl].
Qed.

Lemma eliminate_one_covers obliged o cs c :
  In c (resolved obliged o cs) ->
  exists d, In d (eliminate_one obliged o cs) /\ subsumes d c = true.
Proof.
  intro I. unfold eliminate_one. destruct (resolvents o cs).
  - exists c. split; [exact I|]. apply subsumes_spec. split; apply incl_refl.
  - apply minimal_covers, I.
Qed.

(** ** Nothing new is ruled out *)

Lemma eliminate_one_sound obliged o cs v :
  (forall c, In c cs -> strikes v c = false) ->
  forall c, In c (eliminate_one obliged o cs) -> strikes v c = false.
Proof.
  intros H c I. apply eliminate_one_incl, in_app_iff in I. destruct I as [I|I].
  - apply filter_In in I. apply H, I.
  - unfold resolvents in I. apply filter_In in I. destruct I as [I _].
    apply in_flat_map in I. destruct I as [a [A I]]. apply in_map_iff in I.
    destruct I as [b [<- B]]. apply filter_In in A. apply filter_In in B.
    apply not_true_is_false. intro T.
    unfold strikes, here, resolvent in T. cbn [literals labels] in T.
    rewrite !forallb_union, !andb_true_iff in T. destruct T as [[LA LB] [TA TB]].
    rewrite forallb_forall in TA, TB.
    destruct (v (Done o)) eqn:O.
    + specialize (H a (proj1 A)). apply not_true_iff_false in H. apply H. unfold strikes, here.
      rewrite LA. simpl. apply forallb_forall. intros l L.
      destruct (literal_eq_dec l (Do o)) as [->|N]; [exact O|].
      apply TA, in_in_remove; assumption.
    + specialize (H b (proj1 B)). apply not_true_iff_false in H. apply H. unfold strikes, here.
      rewrite LB. simpl. apply forallb_forall. intros l L.
      destruct (literal_eq_dec l (Avoid o)) as [->|N].
      * unfold true_in. simpl. rewrite O. reflexivity.
      * apply TB, in_in_remove; assumption.
Qed.

Lemma eliminate_sound obliged os cs v :
  (forall c, In c cs -> strikes v c = false) ->
  forall c, In c (eliminate obliged os cs) -> strikes v c = false.
Proof.
  revert cs. induction os as [|o os IH]; intros cs H; [exact H|].
  apply IH, eliminate_one_sound, H.
Qed.

(** ** Nothing that matters is lost *)

(** [ls] holds no clash of [cs]. *)
Definition clear_of (chi : context) (ls : list literal) (cs : list clash) : Prop :=
  forall c, In c cs -> here chi c = true -> ~ incl (literals c) ls.

Lemma clear_or_clash chi ls cs :
  clear_of chi ls cs \/ exists c, In c cs /\ here chi c = true /\ incl (literals c) ls.
Proof.
  destruct (existsb (fun c => here chi c && within ls c) cs) eqn:E.
  - right. apply existsb_exists in E. destruct E as [c [I E]]. apply andb_true_iff in E.
    exists c. split; [exact I|]. split; [apply E|]. intros l L.
    destruct E as [_ E]. unfold within in E. rewrite forallb_forall in E. apply listed_In, E, L.
  - left. intros c I H N. apply not_true_iff_false in E. apply E, existsb_exists.
    exists c. split; [exact I|]. rewrite H. simpl. apply forallb_forall.
    intros l L. apply listed_In, N, L.
Qed.

Lemma here_subsumes chi c d : subsumes c d = true -> here chi d = true -> here chi c = true.
Proof.
  intros S H. apply subsumes_spec in S. unfold here in *. rewrite forallb_forall in *.
  intros f I. apply H, S, I.
Qed.

(** Going backwards through the elimination, each obligation can be chosen. *)
Lemma eliminate_complete obliged chi ls os cs :
  NoDup os -> incl ls obliged -> contradictory ls = false ->
  clear_of chi ls (eliminate obliged os cs) ->
  exists ms, incl ls ms /\ contradictory ms = false /\ clear_of chi ms cs /\
             (forall l, In l ms -> In l ls \/ In (about l) os) /\
             (forall o, In o os -> In (Do o) ms \/ In (Avoid o) ms).
Proof.
  intros ND IO C. revert cs. induction os as [|o os IH]; intros cs F.
  { exists ls. repeat split; auto using incl_refl; intros o []. }
  inversion ND as [|? ? NI ND']. subst.
  destruct (IH ND' _ F) as [ms [S [CM [FM [W T]]]]]. clear IH F.
  (* A clash of [cs] that is not idle is covered in the next list. *)
  assert (K : forall c, In c cs -> here chi c = true -> incl (literals c) ms ->
              idle obliged o c = false -> False).
  { intros c I H L D.
    destruct (eliminate_one_covers obliged o cs c) as [d [J SD]].
    { apply in_app_iff. left. apply filter_In. rewrite D. auto. }
    apply (FM d J); [exact (here_subsumes chi d c SD H)|].
    apply subsumes_spec in SD. eapply incl_tran; [apply SD|exact L]. }
  (* What is known of [o] is due, so obliged: no clash below is idle. *)
  assert (ID : forall c, incl (literals c) ms -> idle obliged o c = false).
  { intros c L. apply not_true_is_false. intro D. apply existsb_exists in D.
    destruct D as [l [I D]]. apply andb_true_iff in D. destruct D as [A N].
    apply Pos.eqb_eq in A. apply negb_true_iff, not_true_iff_false in N. apply N, listed_In.
    destruct (W l (L l I)) as [X|X]; [apply IO, X|]. rewrite A in X. destruct (NI X). }
  destruct (in_dec literal_eq_dec (Do o) ms) as [Y|Y].
  { exists ms. split; [exact S|]. split; [exact CM|]. split.
    - intros c I H L. exact (K c I H L (ID c L)).
    - split; [intros l I; destruct (W l I); simpl; auto|].
      intros p [<-|P]; auto. }
  destruct (in_dec literal_eq_dec (Avoid o) ms) as [Z|Z].
  { exists ms. split; [exact S|]. split; [exact CM|]. split.
    - intros c I H L. exact (K c I H L (ID c L)).
    - split; [intros l I; destruct (W l I); simpl; auto|].
      intros p [<-|P]; auto. }
  (* [o] is free: one of the two choices is clear, or the resolvent is not. *)
  assert (Choice : forall l, about l = o -> ~ In (opposite l) ms -> clear_of chi (l :: ms) cs ->
    exists ms', incl ls ms' /\ contradictory ms' = false /\ clear_of chi ms' cs /\
                (forall k, In k ms' -> In k ls \/ In (about k) (o :: os)) /\
                (forall p, In p (o :: os) -> In (Do p) ms' \/ In (Avoid p) ms')).
  { intros l A N CL. exists (l :: ms). split; [apply incl_tl, S|]. split; [|split; [exact CL|split]].
    - apply not_true_is_false. intro D. apply contradictory_spec in D. destruct D as [k [I J]].
      destruct I as [<-|I], J as [J|J].
      + symmetry in J. exact (opposite_different _ J).
      + exact (N J).
      + apply N. rewrite J, opposite_involutive. exact I.
      + apply not_true_iff_false in CM. apply CM, contradictory_spec. eauto.
    - intros k [<-|I]; [right; left; congruence|]. destruct (W k I); simpl; auto.
    - intros p [<-|P].
      + destruct l as [q|q]; simpl in A; subst q; [left|right]; left; reflexivity.
      + destruct (T p P); [left|right]; right; assumption. }
  destruct (clear_or_clash chi (Do o :: ms) cs) as [CL|[c [I [H L]]]];
    [apply (Choice (Do o)); auto|].
  destruct (clear_or_clash chi (Avoid o :: ms) cs) as [CL|[d [J [H' L']]]];
    [apply (Choice (Avoid o)); auto|].
  exfalso.
  assert (DC : In (Do o) (literals c)).
  { destruct (in_dec literal_eq_dec (Do o) (literals c)) as [|N]; [assumption|]. exfalso.
    assert (X : incl (literals c) ms).
    { intros l M. destruct (L l M) as [<-|X]; [contradiction|exact X]. }
    exact (K c I H X (ID c X)). }
  assert (AD : In (Avoid o) (literals d)).
  { destruct (in_dec literal_eq_dec (Avoid o) (literals d)) as [|N]; [assumption|]. exfalso.
    assert (X : incl (literals d) ms).
    { intros l M. destruct (L' l M) as [<-|X]; [contradiction|exact X]. }
    exact (K d J H' X (ID d X)). }
  set (e := resolvent o c d).
  assert (E : incl (literals e) ms).
  { intros l M. unfold e, resolvent in M. cbn [literals] in M. apply in_union in M.
    destruct M as [M|M]; apply in_remove in M; destruct M as [M N].
    - destruct (L l M); [congruence|assumption].
    - destruct (L' l M); [congruence|assumption]. }
  assert (HE : here chi e = true).
  { unfold here, e, resolvent. cbn [labels]. rewrite forallb_union.
    unfold here in H, H'. rewrite H, H'. reflexivity. }
  assert (IE : In e (resolvents o cs)).
  { unfold resolvents. apply filter_In. split.
    - apply in_flat_map. exists c. split; [apply filter_In; split; [exact I|apply listed_In, DC]|].
      apply in_map_iff. exists d. split; [reflexivity|].
      apply filter_In. split; [exact J|apply listed_In, AD].
    - apply negb_true_iff, not_true_is_false. intro D. apply contradictory_spec in D.
      destruct D as [k [D1 D2]]. apply not_true_iff_false in CM. apply CM, contradictory_spec.
      exists k. split; apply E; assumption. }
  destruct (eliminate_one_covers obliged o cs e) as [g [Q SG]];
    [apply in_app_iff; right; exact IE|].
  apply (FM g Q); [exact (here_subsumes chi g e SG HE)|].
  apply subsumes_spec in SG. eapply incl_tran; [apply SG|exact E].
Qed.

(** * What the constraints rule out *)

Definition clashes (Ks : list constraint) (obliged : list literal) : list clash :=
  let cs := constraint_clashes Ks in eliminate obliged (names_of cs) cs.

(** Some interpretation of the context makes these literals true and keeps the
    constraints. *)
Definition jointly_possible (Ks : list constraint) (chi : context) (ls : list literal) : Prop :=
  exists v, agrees chi v /\ (forall l, In l ls -> true_in v l = true) /\ respects Ks v.

(** The minimal inconsistent sets decide it: a ∀ over interpretations becomes a look
    at finitely many sets of literals. *)
Theorem clashes_decide Ks obliged chi ls :
  incl ls obliged -> contradictory ls = false ->
  jointly_possible Ks chi ls <->
  forall c, In c (clashes Ks obliged) -> here chi c && within ls c = false.
Proof.
  intros IO C. split.
  - intros [v [A [T R]]] c I. apply not_true_is_false. intro X.
    apply andb_true_iff in X. destruct X as [H W].
    pose proof (eliminate_sound obliged (names_of (constraint_clashes Ks)) _ v
                  (proj1 (constraint_clashes_spec Ks v) R) c I) as N.
    apply not_true_iff_false in N. apply N. unfold strikes. apply andb_true_iff. split.
    + unfold here in *. rewrite forallb_forall in *. intros f F. rewrite <- (H f F).
      apply eval_ext. exact A.
    + apply forallb_forall. intros l L. apply T, listed_In.
      unfold within in W. rewrite forallb_forall in W. apply W, L.
  - intro N. set (cs := constraint_clashes Ks) in *.
    destruct (eliminate_complete obliged chi ls (names_of cs) cs) as [ms [S [CM [F [_ T]]]]]; auto.
    + apply NoDup_nodup.
    + intros c I H L. specialize (N c I). apply not_true_iff_false in N. apply N.
      rewrite H. simpl. apply forallb_forall. intros l M. apply listed_In, L, M.
    + exists (least_model chi ms). split; [apply interpretation_agrees|]. split.
      * intros l L. apply least_model_true; auto.
      * apply constraint_clashes_spec. intros c I. apply not_true_is_false. intro X.
        apply andb_true_iff in X. destruct X as [H X]. apply (F c I).
        -- unfold here in *. rewrite forallb_forall in *. intros f G. rewrite <- (H f G).
           apply eval_ext. reflexivity.
        -- intros l L. rewrite forallb_forall in X. specialize (X l L).
           assert (O : In (about l) (names_of cs)).
           { apply nodup_In, in_flat_map. exists c. split; [exact I|]. apply in_map, L. }
           destruct l as [o|o]; unfold true_in in X; simpl in X.
           ++ apply listed_In, X.
           ++ destruct (T o O) as [Y|Y]; [|exact Y].
              apply listed_In in Y. rewrite Y in X. discriminate.
Qed.
