(** The conflict check as clauses, linear in the rules ([sleec_verify/checks/conflict.py];
    issue 5, theorem 6): what a certificate of conflict-freeness refutes. *)

From Coq Require Import List Bool PArith Arith Lia FMapPositive.
From Sleec Require Import Model Evaluation Equation Entailment Clauses Cnf Clashes Conflict.
Import ListNotations.

(** * The clauses *)

(** For each literal one that says whether it is due. *)
Fixpoint build_dues (gs : list (list literal * lit)) (ls : list literal) (s : state)
  : list lit * state :=
  match ls with
  | [] => ([], s)
  | l :: rest =>
      let (d, s1) := any_of (map snd (filter (fun p => listed l (fst p)) gs)) s in
      let (ds, s2) := build_dues gs rest s1 in (d :: ds, s2)
  end.

Fixpoint lookup (l : literal) (ls : list literal) (ds : list lit) : lit :=
  match ls, ds with
  | m :: ls', d :: ds' => if literal_eqb l m then d else lookup l ls' ds'
  | _, _ => constant false
  end.

Fixpoint build_clashes (ls : list literal) (ds : list lit) (cs : list clash) (s : state)
  : list lit * state :=
  match cs with
  | [] => ([], s)
  | c :: rest =>
      let (fs, s1) := build_facts (labels c) s in
      let (x, s2) := all_of (fs ++ map (fun l => lookup l ls ds) (literals c)) s1 in
      let (xs, s3) := build_clashes ls ds rest s2 in (x :: xs, s3)
  end.

(** A literal for each clash of [cs], one for each assumption, and the gates of both. *)
Definition conflict_gates (r : reading) (G : ruleset) (Ks : list constraint) (cs : list clash)
  : list lit * list lit * state :=
  let ls := nodup literal_eq_dec (flat_map literals cs) in
  let (gs, s1) := guarded r G start in
  let (ds, s2) := build_dues gs ls s1 in
  let (xs, s3) := build_clashes ls ds cs s2 in
  let (ys, s4) := build_facts (map assumed Ks) s3 in
  (xs, ys, s4).

(** "One of these clashes is due, in a context that can be." *)
Definition clash_clauses (r : reading) (G : ruleset) (Ks : list constraint) (cs : list clash) : cnf :=
  match conflict_gates r G Ks cs with
  | (xs, ys, s) => xs :: map (fun y => [y]) ys ++ built s
  end.

(** The rules that oblige something about one of these names; the others have no part in
    a clash among them. *)
Definition concerned (os : list name) (G : ruleset) : ruleset :=
  let known := set_of os in
  filter (fun R => existsb (existsb (fun l =>
            match PositiveMap.find (about l) known with Some _ => true | None => false end))
          (clauses R)) G.

Definition conflict_clauses (r : reading) (G : ruleset) (Ks : list constraint) : cnf :=
  let cs := all_clashes G Ks in
  clash_clauses r (concerned (map about (flat_map literals cs)) G) Ks cs.

(** ** What the gates are worth *)

Lemma pick_gives s xs ys s1 w n :
  incl xs ys -> gives_all s (ys, s1) w n ->
  gives_all s (xs, s1) (fun a => map (lit_true a) xs) n.
Proof.
  intros I G S. destruct (G S) as [E [O [_ K]]].
  split; [exact E|]. split; [auto|]. split; [reflexivity|]. eauto.
Qed.

Definition chosen (gs : list (list literal * lit)) (l : literal) : list lit :=
  map snd (filter (fun p => listed l (fst p)) gs).

Lemma chosen_incl gs l : incl (chosen gs l) (map snd gs).
Proof.
  intros x I. apply in_map_iff in I. destruct I as [p [<- I]].
  apply filter_In in I. apply in_map, I.
Qed.

Lemma existsb_id {A} (f : A -> bool) l : existsb id (map f l) = existsb f l.
Proof. exact (existsb_map id f l). Qed.

Lemma forallb_id {A} (f : A -> bool) l : forallb id (map f l) = forallb f l.
Proof. exact (forallb_map id f l). Qed.

Lemma build_dues_gives gs ls s w n :
  gives_all s (map snd gs, s) w n ->
  gives_all s (build_dues gs ls s)
            (fun a => map (fun l => existsb (lit_true a) (chosen gs l)) ls) n.
Proof.
  revert s. induction ls as [|l ls IH]; intros s G; cbn [build_dues map].
  - apply nil_gives.
  - pose proof (any_of_gives _ _ _ _ (pick_gives _ _ _ _ _ _ (chosen_incl gs l) G)) as D.
    fold (chosen gs l). destruct (any_of (chosen gs l) s) as [d s1].
    specialize (IH s1). destruct (build_dues gs ls s1) as [ds s2].
    intro S. revert S. enough (C : sound s -> gives_all s (d :: ds, s2)
      (fun a => existsb (lit_true a) (chosen gs l)
                :: map (fun l => existsb (lit_true a) (chosen gs l)) ls) n)
      by (intro S; exact (C S S)).
    intro S. pose proof (gives_extends _ _ _ _ _ D) as X.
    specialize (IH (gives_all_here _ _ _ _ _ (gives_all_later _ _ _ _ _ _ G X) S)).
    apply (gives_all_earlier _ _ _ _ _ X). apply cons_gives; [|exact IH].
    eapply gives_value;
      [|exact (gives_later _ _ _ _ _ _ (gives_here _ _ _ _ _ D S) (gives_all_extends _ _ _ _ _ IH))].
    intro a. apply existsb_id.
Qed.

Lemma lookup_gives s ls ds s1 (F : (positive -> bool) -> literal -> bool) n l :
  gives_all s (ds, s1) (fun a => map (F a) ls) n -> In l ls ->
  gives s (lookup l ls ds, s1) (fun a => F a l) n.
Proof.
  revert ds. induction ls as [|m ls IH]; intros ds G I; [destruct I|].
  destruct ds as [|d ds]; cbn [lookup].
  - pose proof (head_gives _ _ _ _ _ G) as H. cbn [hd] in H.
    eapply gives_value_on; [|exact H]. intros S a A.
    destruct (G S) as [_ [_ [V _]]]. specialize (V a A). discriminate V.
  - destruct (literal_eqb l m) eqn:E.
    + apply literal_eqb_eq in E. subst m. exact (head_gives _ _ _ _ _ G).
    + apply IH; [exact (tail_gives _ _ _ _ _ G)|].
      destruct I as [->|I]; [|exact I].
      apply not_true_iff_false in E. destruct E. apply literal_eqb_eq. reflexivity.
Qed.

Lemma map_gives {A} s s1 (f : A -> lit) (F : (positive -> bool) -> A -> bool) xs n :
  (sound s -> extends s s1) -> (forall x, In x xs -> gives s (f x, s1) (fun a => F a x) n) ->
  gives_all s (map f xs, s1) (fun a => map (F a) xs) n.
Proof.
  intros X G. induction xs as [|x xs IH]; cbn [map].
  - intro S. specialize (X S). destruct (nil_gives s1 n (extends_sound _ _ X S)) as [_ R].
    split; [exact X|exact R].
  - apply cons_gives.
    + exact (G x (or_introl eq_refl)).
    + apply IH. intros y I. exact (G y (or_intror I)).
Qed.

Lemma build_clashes_gives ls ds cs s F n :
  sound s -> gives_all s (ds, s) (fun a => map (F a) ls) n ->
  (forall c, In c cs -> incl (literals c) ls) ->
  exists n', gives_all s (build_clashes ls ds cs s)
    (fun a => map (fun c => here (facts_in a) c && forallb (F a) (literals c)) cs) n'.
Proof.
  revert s n. induction cs as [|c cs IH]; intros s n S D L; cbn [build_clashes map].
  - exists n. apply nil_gives.
  - unfold build_facts.
    pose proof (build_all_gives fact fact_number fact_number_even (labels c) s) as B.
    destruct (build_all fact fact_number (labels c) s) as [fs s1].
    set (m := flat_map (fun f => map fact_number (atoms_of f)) (labels c)) in B.
    pose proof (gives_all_extends _ _ _ _ _ B S) as X1. pose proof (extends_sound _ _ X1 S) as S1.
    pose proof (gives_all_here _ _ _ _ _ (gives_all_later _ _ _ _ _ _ D (fun _ => X1)) S) as D1.
    assert (A1 : gives s1 (all_of (fs ++ map (fun l => lookup l ls ds) (literals c)) s1)
       (fun a => here (facts_in a) c && forallb (F a) (literals c)) (n ++ m)).
    { eapply gives_value; [|apply all_of_gives; apply app_gives].
      2:{ eapply gives_all_needs; [apply incl_appr, incl_refl|exact (gives_all_here _ _ _ _ _ B S)]. }
      2:{ eapply gives_all_needs; [apply incl_appl, incl_refl|].
          apply (map_gives s1 s1 _ F); [intros _; apply extends_refl|].
          intros l I. apply (lookup_gives s1 ls ds s1 F n l D1).
          apply (L c (or_introl eq_refl)), I. }
      intro a. cbn beta. rewrite forallb_app, !forallb_id. reflexivity. }
    destruct (all_of (fs ++ map (fun l => lookup l ls ds) (literals c)) s1) as [x s2].
    pose proof (gives_extends _ _ _ _ _ A1 S1) as X2. pose proof (extends_sound _ _ X2 S1) as S2.
    pose proof (gives_all_here _ _ _ _ _ (gives_all_later _ _ _ _ _ _ D1 (fun _ => X2)) S1) as D2.
    destruct (IH s2 n S2 D2) as [k IH2]; [intros; apply L; right; assumption|].
    destruct (build_clashes ls ds cs s2) as [xs s3].
    exists ((n ++ m) ++ k).
    apply (gives_all_earlier s s2); [intros _; exact (extends_trans _ _ _ X1 X2)|].
    apply cons_gives.
    + apply (gives_needs _ _ _ (n ++ m)); [apply incl_appl, incl_refl|].
      eapply gives_later; [exact (gives_here _ _ _ _ _ A1 S1)|].
      exact (gives_all_extends _ _ _ _ _ IH2).
    + apply (gives_all_needs _ _ _ k); [apply incl_appr, incl_refl|exact IH2].
Qed.

Lemma conflict_gates_spec r G Ks cs :
  match conflict_gates r G Ks cs with
  | (xs, ys, s) =>
      extends start s /\
      forall a, cnf_true a (built s) = true ->
        existsb (lit_true a) xs = one_here r G (facts_in a) cs /\
        forallb (lit_true a) ys = possible Ks (facts_in a)
  end.
Proof.
  unfold conflict_gates. pose proof start_sound as S.
  set (ls := nodup literal_eq_dec (flat_map literals cs)).
  pose proof (fun a l => guarded_due r G start a l S) as GD.
  pose proof (guarded_extends r G start S) as X1.
  assert (GG : gives_all start (map snd (fst (guarded r G start)), snd (guarded r G start))
                (fun a => map (lit_true a) (map snd (fst (guarded r G start))))
                (map fact_number (facts_of G))).
  { unfold guarded. pose proof (build_rules_gives r G start) as P.
    destruct (build_rules r G start) as [gs s]. cbn [fst snd].
    eapply pick_gives; [|exact P]. intros x I. apply in_map_iff in I.
    destruct I as [[O g] [<- I]]. exact (in_combine_r _ _ _ _ I). }
  destruct (guarded r G start) as [gs s1]. cbn [fst snd] in *.
  pose proof (extends_sound _ _ X1 S) as S1.
  pose proof (build_dues_gives gs ls s1 _ _ (gives_all_here _ _ _ _ _ GG S)) as DD.
  destruct (build_dues gs ls s1) as [ds s2].
  pose proof (gives_all_extends _ _ _ _ _ DD S1) as X2. pose proof (extends_sound _ _ X2 S1) as S2.
  assert (D2 : gives_all s2 (ds, s2)
                 (fun a => map (fun l => existsb (lit_true a) (chosen gs l)) ls)
                 (map fact_number (facts_of G))).
  { exact (gives_all_here _ _ _ _ _ DD S1). }
  destruct (build_clashes_gives ls ds cs s2
              (fun a l => existsb (lit_true a) (chosen gs l)) _ S2 D2) as [n C].
  { intros c I l L. apply nodup_In, in_flat_map. exists c. auto. }
  destruct (build_clashes ls ds cs s2) as [xs s3].
  pose proof (gives_all_extends _ _ _ _ _ C S2) as X3. pose proof (extends_sound _ _ X3 S2) as S3.
  unfold build_facts.
  pose proof (build_all_gives fact fact_number fact_number_even (map assumed Ks) s3) as Y.
  destruct (build_all fact fact_number (map assumed Ks) s3) as [ys s4].
  pose proof (gives_all_extends _ _ _ _ _ Y S3) as X4.
  split; [eapply extends_trans; [exact X1|]; eapply extends_trans; [exact X2|];
          eapply extends_trans; [exact X3|exact X4]|].
  intros a A. split.
  - assert (A3 : cnf_true a (built s3) = true) by (eapply extends_true; eauto).
    assert (A2 : cnf_true a (built s2) = true) by (eapply extends_true; eauto).
    assert (A1 : cnf_true a (built s1) = true) by (eapply extends_true; eauto).
    destruct (C S2) as [_ [_ [V _]]]. specialize (V a A3).
    rewrite <- existsb_id, V. unfold one_here. rewrite existsb_id.
    assert (Q : forall l, existsb (lit_true a) (chosen gs l) = listed l (due r G (facts_in a))).
    { intro l. apply Bool.eq_true_iff_eq. rewrite existsb_exists, listed_In.
      rewrite (GD a l A1). unfold chosen. split.
      - intros [g [I T]]. apply in_map_iff in I. destruct I as [[O g'] [<- I]].
        apply filter_In in I. destruct I as [I L]. apply listed_In in L. exists O, g'. auto.
      - intros [O [g [I [T L]]]]. exists g. split; [|exact T]. apply in_map_iff.
        exists (O, g). split; [reflexivity|]. apply filter_In. split; [exact I|].
        apply listed_In, L. }
    assert (W : forall c, here (facts_in a) c
                  && forallb (fun l => existsb (lit_true a) (chosen gs l)) (literals c)
                = here (facts_in a) c && within (due r G (facts_in a)) c).
    { intro c. f_equal. unfold within. induction (literals c) as [|l k IH]; [reflexivity|].
      cbn [forallb]. rewrite IH, Q. reflexivity. }
    clear - W. induction cs as [|c k IH]; [reflexivity|]. cbn [existsb]. rewrite IH, W. reflexivity.
  - destruct (Y S3) as [_ [_ [V _]]]. specialize (V a A).
    rewrite <- forallb_id, V, forallb_id, forallb_map. reflexivity.
Qed.

Lemma clash_clauses_true r G Ks cs a :
  cnf_true a (clash_clauses r G Ks cs) = true ->
  possible Ks (facts_in a) = true /\ one_here r G (facts_in a) cs = true.
Proof.
  unfold clash_clauses. pose proof (conflict_gates_spec r G Ks cs) as C.
  destruct (conflict_gates r G Ks cs) as [[xs ys] s]. destruct C as [_ C]. intro T.
  unfold cnf_true in T. cbn [forallb] in T. rewrite forallb_app, forallb_map in T.
  rewrite !andb_true_iff in T. destruct T as [X [Y B]]. destruct (C a B) as [<- <-].
  split; [|exact X]. apply forallb_forall. intros y I.
  rewrite forallb_forall in Y. specialize (Y y I).
  unfold clause_true in Y. cbn [existsb] in Y. rewrite orb_false_r in Y. exact Y.
Qed.

Lemma one_here_ext r G cs chi psi :
  (forall f, chi f = psi f) -> one_here r G chi cs = one_here r G psi cs.
Proof.
  intro E. unfold one_here. rewrite (due_ext r chi psi G E).
  induction cs as [|c cs IH]; [reflexivity|].
  cbn [existsb]. rewrite IH. f_equal. f_equal.
  unfold here. induction (labels c) as [|f fs IHf]; [reflexivity|]. cbn [forallb].
  rewrite IHf, (eval_ext chi psi f E). reflexivity.
Qed.

Lemma clash_clauses_model r G Ks cs chi :
  possible Ks chi = true -> one_here r G chi cs = true ->
  exists a, (forall f, facts_in a f = chi f) /\ cnf_true a (clash_clauses r G Ks cs) = true.
Proof.
  intros P H. unfold clash_clauses. pose proof (conflict_gates_spec r G Ks cs) as C.
  destruct (conflict_gates r G Ks cs) as [[xs ys] s]. destruct C as [[_ [_ [_ E]]] C].
  destruct (E start_sound (assignment_of (interpretation chi (fun _ => false)))) as [a [A T]];
    [reflexivity|].
  assert (F : forall f, facts_in a f = chi f).
  { intro f. unfold facts_in. rewrite A.
    - unfold assignment_of. rewrite atom_of_number. reflexivity.
    - destruct f; exact I. }
  exists a. split; [exact F|]. destruct (C a T) as [X Y].
  rewrite (one_here_ext r G cs _ chi F), H in X.
  rewrite (possible_ext Ks _ chi F), P in Y.
  unfold cnf_true. cbn [forallb]. rewrite forallb_app, !andb_true_iff.
  split; [exact X|]. split; [|exact T].
  apply forallb_forall. intros c I. apply in_map_iff in I. destruct I as [y [<- I]].
  rewrite forallb_forall in Y. unfold clause_true. cbn [existsb]. rewrite (Y y I). reflexivity.
Qed.

(** ** The theorem that a certificate rests on *)

(** The clauses of some clashes are satisfiable exactly if one of them is due, in a
    context that can be; and the context is read off a model. *)
Theorem clash_clauses_spec r G Ks cs :
  satisfiable (clash_clauses r G Ks cs) <->
  exists chi, possible Ks chi = true /\ one_here r G chi cs = true.
Proof.
  split.
  - intros [a T]. apply clash_clauses_true in T. eauto.
  - intros [chi [P C]]. destruct (clash_clauses_model r G Ks cs chi P C) as [a [_ T]].
    exists a. exact T.
Qed.

Lemma concerned_due r G chi os l :
  In (about l) os -> In l (due r (concerned os G) chi) <-> In l (due r G chi).
Proof.
  intro O. rewrite !in_due. split; intros [R [I H]]; exists R; (split; [|exact H]).
  - apply filter_In in I. apply I.
  - destruct H as [_ L]. apply filter_In. split; [exact I|]. apply existsb_exists.
    exists (clause R (active r chi R)). split.
    + apply nth_In. rewrite clauses_length. pose proof (active_bound r chi R). lia.
    + apply existsb_exists. exists l. split; [exact L|].
      rewrite (proj2 (set_of_find _ _) O). reflexivity.
Qed.

Lemma concerned_here r G chi cs :
  one_here r (concerned (map about (flat_map literals cs)) G) chi cs = one_here r G chi cs.
Proof.
  unfold one_here. apply Bool.eq_true_iff_eq. rewrite !existsb_exists.
  enough (E : forall c, In c cs ->
    within (due r (concerned (map about (flat_map literals cs)) G) chi) c = within (due r G chi) c).
  { split; intros [c [I H]]; exists c; (split; [exact I|]); [rewrite <- E by exact I|rewrite E by exact I];
      exact H. }
  intros c I. unfold within. apply Bool.eq_true_iff_eq. rewrite !forallb_forall.
  assert (D : forall l, In l (literals c) ->
    In l (due r (concerned (map about (flat_map literals cs)) G) chi) <-> In l (due r G chi)).
  { intros l L. apply concerned_due, in_map, in_flat_map. eauto. }
  split; intros H l L; specialize (H l L); rewrite listed_In in *; apply (D l L), H.
Qed.

(** Those of all clashes are satisfiable exactly if a context that can be conflicts. *)
Theorem conflict_clauses_spec r G Ks :
  satisfiable (conflict_clauses r G Ks) <->
  exists chi, possible Ks chi = true /\ conflicts r G Ks chi.
Proof.
  unfold conflict_clauses. rewrite clash_clauses_spec.
  split; intros [chi [P C]]; exists chi; (split; [exact P|]).
  - rewrite concerned_here in C. apply conflicts_iff. exact C.
  - rewrite concerned_here. apply conflicts_iff in C. exact C.
Qed.

(** They are unsatisfiable exactly if no context conflicts. *)
Theorem conflict_free_iff_unsatisfiable r G Ks :
  unsatisfiable (conflict_clauses r G Ks) <-> conflict_free r G Ks.
Proof.
  rewrite unsatisfiable_iff, conflict_clauses_spec. unfold conflict_free. split.
  - intros N chi P. destruct (compatible_or_conflicts r G Ks chi) as [C|C]; [exact C|].
    destruct N. eauto.
  - intros F [chi [P C]]. exact (C (F chi P)).
Qed.

(** The clashes may be asked about apart, in any parts that have them all. *)
Theorem conflict_free_in_parts r G Ks parts :
  (forall c, In c (all_clashes G Ks) <-> In c (concat parts)) ->
  conflict_free r G Ks <-> forall cs, In cs parts -> unsatisfiable (clash_clauses r G Ks cs).
Proof.
  intro A. split.
  - intros F cs I. apply unsatisfiable_iff. rewrite clash_clauses_spec. intros [chi [P H]].
    specialize (F chi P). apply clash_here_spec, not_true_iff_false in F. apply F.
    unfold clash_here, one_here in *. rewrite existsb_exists in *. destruct H as [c [C H]].
    exists c. split; [|exact H]. apply A, in_concat. eauto.
  - intros U chi P. apply clash_here_spec, not_true_is_false. intro H.
    unfold clash_here, one_here in H. apply existsb_exists in H. destruct H as [c [C H]].
    apply A, in_concat in C. destruct C as [cs [I C]].
    specialize (U cs I). apply unsatisfiable_iff in U. apply U, clash_clauses_spec.
    exists chi. split; [exact P|]. unfold one_here. apply existsb_exists. eauto.
Qed.
