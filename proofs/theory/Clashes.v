(** Which literals cannot all be due ([sleec_verify/clashes.py]).

    A constraint over several literals makes "is there a conflicting context" a
    question of the form ∃∀.  What is due are units; so it is enough to know every
    set of literals that the constraints rule out, with the situations in which they
    do.  They are found by resolution on one obligation after the other. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment.
Import ListNotations.

(** These literals cannot all be due where all the labels are true. *)
Record clash := Clash { literals : list literal; labels : list (formula fact) }.

Definition here (chi : context) (c : clash) : bool := forallb (eval chi) (labels c).

Definition within (ls : list literal) (c : clash) : bool :=
  forallb (fun l => listed l ls) (literals c).

(** The interpretation makes true what must not be. *)
Definition strikes (v : atom -> bool) (c : clash) : bool :=
  here (context_in v) c && forallb (true_in v) (literals c).

(** * Constraints as clashes *)

Fixpoint pairs (os : list name) : list (name * name) :=
  match os with
  | [] => []
  | o :: rest => map (pair o) (filter (fun p => negb (Pos.eqb o p)) rest) ++ pairs rest
  end.

(** What must not come true. *)
Definition forbidden (k : constraint) : formula atom :=
  match k with
  | Exclusive os =>
      disj (map (fun p => And (Atom (Done (fst p))) (Atom (Done (snd p)))) (pairs os))
  | Never f => f
  | Assume _ => Truth false
  end.

Definition assumed (k : constraint) : formula fact :=
  match k with Assume f => f | _ => Truth true end.

Definition respects (Ks : list constraint) (v : atom -> bool) : Prop :=
  forall k, In k Ks -> eval v (forbidden k) = false.

(** Contexts that break an [Assume] do not count. *)
Definition possible (Ks : list constraint) (chi : context) : bool :=
  forallb (fun k => eval chi (assumed k)) Ks.

Lemma possible_ext Ks chi psi :
  (forall f, chi f = psi f) -> possible Ks chi = possible Ks psi.
Proof.
  intro H. unfold possible. induction Ks as [|k Ks IH]; [reflexivity|]. cbn [forallb].
  rewrite IH, (eval_ext chi psi _ H). reflexivity.
Qed.

Lemma in_pairs o p os : In (o, p) (pairs os) -> In o os /\ In p os /\ o <> p.
Proof.
  induction os as [|q os IH]; simpl; [tauto|]. intro H. apply in_app_iff in H. destruct H as [H|H].
  - apply in_map_iff in H. destruct H as [x [E F]]. injection E as -> ->.
    apply filter_In in F. destruct F as [I N]. apply negb_true_iff, Pos.eqb_neq in N. auto.
  - tauto.
Qed.

Lemma pairs_complete o p os :
  In o os -> In p os -> o <> p -> In (o, p) (pairs os) \/ In (p, o) (pairs os).
Proof.
  induction os as [|q os IH]; simpl; [tauto|]. intros I J N. rewrite !in_app_iff.
  assert (X : forall x, In x os -> q <> x ->
              In (q, x) (map (pair q) (filter (fun y => negb (Pos.eqb q y)) os))).
  { intros x Y Z. apply in_map, filter_In. split; [exact Y|].
    apply negb_true_iff, Pos.eqb_neq, Z. }
  destruct I as [->|I], J as [->|J]; [congruence| | |]; auto 6.
  destruct (IH I J N); auto.
Qed.

(** [EXCLUSIVE] means what it says: never two of these together. *)
Theorem exclusive_meaning v os :
  eval v (forbidden (Exclusive os)) = false <->
  forall o p, In o os -> In p os -> o <> p -> v (Done o) && v (Done p) = false.
Proof.
  unfold forbidden. rewrite eval_disj, existsb_map, <- not_true_iff_false, existsb_exists. split.
  - intros H o p I J N. apply not_true_is_false. intro T. apply H.
    destruct (pairs_complete o p os I J N) as [P|P].
    + exists (o, p). auto.
    + exists (p, o). simpl. rewrite andb_comm. auto.
  - intros H [[o p] [P T]]. apply in_pairs in P. destruct P as [I [J N]].
    simpl in T. rewrite (H o p I J N) in T. discriminate.
Qed.

(** ** Formulas as lists of clashes: their cases *)

(** The parts that speak of situations only are kept whole. *)
Fixpoint situation_only (f : formula atom) : option (formula fact) :=
  match f with
  | Truth b => Some (Truth b)
  | Atom (Fact x) => Some (Atom x)
  | Atom (Done _) => None
  | Not g => option_map Not (situation_only g)
  | And g h =>
      match situation_only g, situation_only h with
      | Some g', Some h' => Some (And g' h')
      | _, _ => None
      end
  | Or g h =>
      match situation_only g, situation_only h with
      | Some g', Some h' => Some (Or g' h')
      | _, _ => None
      end
  end.

Lemma situation_only_eval v f g :
  situation_only f = Some g -> eval v f = eval (context_in v) g.
Proof.
  revert g. induction f as [b|[x|o]|f IH|f IHf h IHh|f IHf h IHh]; intros g E; simpl in E.
  - injection E as <-. reflexivity.
  - injection E as <-. reflexivity.
  - discriminate.
  - destruct (situation_only f); [|discriminate]. injection E as <-. simpl.
    rewrite (IH _ eq_refl). reflexivity.
  - destruct (situation_only f), (situation_only h); try discriminate. injection E as <-.
    simpl. rewrite (IHf _ eq_refl), (IHh _ eq_refl). reflexivity.
  - destruct (situation_only f), (situation_only h); try discriminate. injection E as <-.
    simpl. rewrite (IHf _ eq_refl), (IHh _ eq_refl). reflexivity.
Qed.

Definition formula_eq_dec (f g : formula fact) : {f = g} + {f <> g}.
Proof. repeat decide equality. Defined.

Definition union {A} (dec : forall x y : A, {x = y} + {x <> y}) (xs ys : list A) : list A :=
  xs ++ filter (fun y => if in_dec dec y xs then false else true) ys.

Lemma in_union {A} dec (x : A) xs ys : In x (union dec xs ys) <-> In x xs \/ In x ys.
Proof.
  unfold union. rewrite in_app_iff, filter_In. split; [tauto|].
  intros [I|I]; [auto|]. destruct (in_dec dec x xs) as [Y|N]; [auto|].
  right. split; [exact I|]. destruct (in_dec dec x xs); [contradiction|reflexivity].
Qed.

Lemma forallb_union {A} dec (f : A -> bool) xs ys :
  forallb f (union dec xs ys) = forallb f xs && forallb f ys.
Proof.
  apply Bool.eq_true_iff_eq. rewrite andb_true_iff, !forallb_forall.
  setoid_rewrite in_union. intuition.
Qed.

Definition merge (c d : clash) : clash :=
  Clash (union literal_eq_dec (literals c) (literals d))
        (union formula_eq_dec (labels c) (labels d)).

Definition product (cs ds : list clash) : list clash :=
  flat_map (fun c => map (merge c) ds) cs.

(** The cases in which [f] has this value. *)
Fixpoint cases (value : bool) (f : formula atom) : list clash :=
  match situation_only f with
  | Some g => [Clash [] [if value then g else Not g]]
  | None =>
      match f with
      | Atom (Done o) => [Clash [if value then Do o else Avoid o] []]
      | Not g => cases (negb value) g
      | And g h =>
          if value then product (cases true g) (cases true h) else cases false g ++ cases false h
      | Or g h =>
          if value then cases true g ++ cases true h else product (cases false g) (cases false h)
      | _ => []
      end
  end.

Lemma strikes_merge v c d : strikes v (merge c d) = strikes v c && strikes v d.
Proof.
  unfold strikes, here, merge. cbn [literals labels]. rewrite !forallb_union.
  destruct (forallb _ (labels c)), (forallb _ (labels d)), (forallb _ (literals c)); auto with bool.
Qed.

Lemma strikes_product v cs ds :
  existsb (strikes v) (product cs ds) = existsb (strikes v) cs && existsb (strikes v) ds.
Proof.
  unfold product. induction cs as [|c cs IH]; [reflexivity|].
  cbn [flat_map existsb]. rewrite existsb_app, existsb_map, IH, andb_orb_distrib_l. f_equal.
  clear. induction ds as [|d ds IH]; simpl; [rewrite andb_false_r; reflexivity|].
  rewrite IH, strikes_merge, andb_orb_distrib_r. reflexivity.
Qed.

Lemma cases_spec v f value :
  existsb (strikes v) (cases value f) = Bool.eqb (eval v f) value.
Proof.
  assert (S : forall f g (value : bool), situation_only f = Some g ->
              existsb (strikes v) [Clash [] [if value then g else Not g]]
              = Bool.eqb (eval v f) value).
  { clear. intros f g value E. rewrite (situation_only_eval v f g E).
    unfold strikes, here. simpl. rewrite !andb_true_r, orb_false_r.
    destruct value; simpl; destruct (eval (context_in v) g); reflexivity. }
  revert value. induction f as [b|[x|o]|f IH|f IHf h IHh|f IHf h IHh]; intro value;
    cbn [cases];
    match goal with |- context [situation_only ?x] => destruct (situation_only x) as [g|] eqn:E end;
    try (apply S; exact E); try discriminate E.
  - unfold strikes, here. simpl.
    destruct value; unfold true_in; simpl; destruct (v (Done o)); reflexivity.
  - rewrite IH. simpl. destruct (eval v f), value; reflexivity.
  - destruct value; rewrite ?strikes_product, ?existsb_app, IHf, IHh; simpl;
      destruct (eval v f), (eval v h); reflexivity.
  - destruct value; rewrite ?strikes_product, ?existsb_app, IHf, IHh; simpl;
      destruct (eval v f), (eval v h); reflexivity.
Qed.

Definition constraint_clashes (Ks : list constraint) : list clash :=
  flat_map (fun k => cases true (forbidden k)) Ks.

Lemma constraint_clashes_spec Ks v :
  respects Ks v <-> forall c, In c (constraint_clashes Ks) -> strikes v c = false.
Proof.
  unfold respects, constraint_clashes. split.
  - intros H c I. apply in_flat_map in I. destruct I as [k [K I]].
    apply not_true_is_false. intro T.
    assert (X : existsb (strikes v) (cases true (forbidden k)) = true).
    { apply existsb_exists. eauto. }
    rewrite cases_spec, (H k K) in X. discriminate.
  - intros H k K. apply not_true_is_false. intro T.
    assert (X : existsb (strikes v) (cases true (forbidden k)) = true).
    { rewrite cases_spec, T. reflexivity. }
    apply existsb_exists in X. destruct X as [c [I X]].
    rewrite H in X; [discriminate|]. apply in_flat_map. eauto.
Qed.

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

Definition eliminate_one (obliged : list literal) (o : name) (cs : list clash) : list clash :=
  minimal (filter (fun c => negb (idle obliged o c)) cs ++ resolvents o cs).

Fixpoint eliminate (obliged : list literal) (os : list name) (cs : list clash) : list clash :=
  match os with
  | [] => cs
  | o :: rest => eliminate obliged rest (eliminate_one obliged o cs)
  end.

Definition names_of (cs : list clash) : list name :=
  nodup Pos.eq_dec (flat_map (fun c => map about (literals c)) cs).

(** ** Nothing new is ruled out *)

Lemma eliminate_one_sound obliged o cs v :
  (forall c, In c cs -> strikes v c = false) ->
  forall c, In c (eliminate_one obliged o cs) -> strikes v c = false.
Proof.
  intros H c I. apply minimal_incl in I. apply in_app_iff in I. destruct I as [I|I].
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
    destruct (minimal_covers (filter (fun c => negb (idle obliged o c)) cs ++ resolvents o cs) c)
      as [d [J SD]].
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
  destruct (minimal_covers (filter (fun c => negb (idle obliged o c)) cs ++ resolvents o cs) e)
    as [g [Q SG]]; [apply in_app_iff; right; exact IE|].
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
