(** Rules as clauses ([sleec_verify/encoding/cnf.py]): guards and Equation 1, in size linear in
    the rules. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings Clauses.
From Sleec Require Export Gates.
Import ListNotations.

(** * A chain of hedges *)

(** ¬C1, C1 ∧ ¬C2, …, each under [p] and with one more variable for the prefix. *)
Fixpoint build_guards (p : lit) (es : list lit) (s : state) : list lit * state :=
  match es with
  | [] => ([p], s)
  | e :: rest =>
      let (g, s1) := both p (negate e) s in
      let (q, s2) := both p e s1 in
      let (gs, s3) := build_guards q rest s2 in (g :: gs, s3)
  end.

Fixpoint guard_values (p : bool) (bs : list bool) : list bool :=
  match bs with
  | [] => [p]
  | b :: rest => (p && negb b) :: guard_values (p && b) rest
  end.

Lemma guard_values_spec p bs :
  guard_values p bs = map (fun i => p && (longest_prefix bs =? i)) (seq 0 (S (length bs))).
Proof.
  revert p. induction bs as [|b bs IH]; intro p.
  - simpl. rewrite andb_true_r. reflexivity.
  - cbn [guard_values length]. rewrite IH.
    change (seq 0 (S (S (length bs)))) with (0 :: seq 1 (S (length bs))).
    rewrite <- seq_shift. cbn [map]. rewrite map_map. f_equal.
    + destruct b; simpl; rewrite ?andb_false_r, ?andb_true_r; reflexivity.
    + apply map_ext. intro i. destruct b; simpl; rewrite ?andb_true_r, ?andb_false_r; reflexivity.
Qed.

Lemma build_guards_gives s p es v w n :
  gives s (p, s) v n -> gives_all s (es, s) w n ->
  gives_all s (build_guards p es s) (fun a => guard_values (v a) (w a)) n.
Proof.
  revert s p v w. induction es as [|e es IH]; intros s p v w P G; cbn [build_guards].
  - intro S. destruct (P S) as [E [O [V K]]]. destruct (G S) as [_ [_ [W _]]].
    split; [exact E|]. split; [intros l [<-|[]]; exact O|]. split.
    + intros a A. rewrite <- W, <- V by exact A. reflexivity.
    + intros f a If A N l [<-|[]]. eauto.
  - pose proof (head_gives _ _ _ _ _ G) as H. cbn [hd] in H.
    pose proof (tail_gives _ _ _ _ _ G) as T. cbn [tl] in T.
    pose proof (both_gives _ _ _ _ _ _ _ P (negate_gives _ _ _ _ _ H)) as B1.
    destruct (both p (negate e) s) as [g s1].
    destruct (both p e s1) as [q s2] eqn:Q.
    destruct (build_guards q es s2) as [gs s3] eqn:R. intro S. revert S.
    enough (C : sound s -> gives_all s (g :: gs, s3)
                 (fun a => (v a && negb (hd false (w a)))
                           :: guard_values (v a && hd false (w a)) (tl (w a))) n).
    { intro S. revert S. eapply gives_all_value_on; [|intro S; exact (C S S)].
      intros S a A. destruct (G S) as [_ [_ [W _]]].
      rewrite <- W; [reflexivity|]. destruct (C S S) as [E _]. eapply extends_true; eauto. }
    intro S.
    pose proof (gives_extends _ _ _ _ _ B1) as X1. pose proof (extends_sound _ _ (X1 S) S) as S1.
    pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ P X1) S) as P1.
    pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ H X1) S) as H1.
    pose proof (gives_all_here _ _ _ _ _ (gives_all_later _ _ _ _ _ _ T X1) S) as T1.
    pose proof (gives_here _ _ _ _ _ B1 S) as G1.
    pose proof (both_gives _ _ _ _ _ _ _ P1 H1) as B2. rewrite Q in B2.
    pose proof (gives_extends _ _ _ _ _ B2) as X2.
    pose proof (gives_here _ _ _ _ _ B2 S1) as Q2.
    pose proof (gives_all_here _ _ _ _ _ (gives_all_later _ _ _ _ _ _ T1 X2) S1) as T2.
    pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ G1 X2) S1) as G2.
    specialize (IH s2 q _ _ Q2 T2). rewrite R in IH.
    eapply gives_all_earlier;
      [|eapply cons_gives;
        [exact (gives_later _ _ _ _ _ _ G2 (gives_all_extends _ _ _ _ _ IH))|exact IH]].
    intros _. eapply extends_trans; eauto.
Qed.

(** Ci ∨ C(i+1) ∨ … ∨ Cn, from the last to the first. *)
Fixpoint build_suffixes (cs : list lit) (s : state) : list lit * state :=
  match cs with
  | [] => ([], s)
  | c :: rest =>
      let (os, s1) := build_suffixes rest s in
      let (o, s2) := either c (hd (constant false) os) s1 in (o :: os, s2)
  end.

Lemma suffixes_true_head bs : hd false (suffixes_true bs) = existsb id bs.
Proof. destruct bs; reflexivity. Qed.

Lemma build_suffixes_gives s cs w n :
  gives_all s (cs, s) w n ->
  gives_all s (build_suffixes cs s) (fun a => suffixes_true (w a)) n.
Proof.
  revert w. induction cs as [|c cs IH]; intros w G; cbn [build_suffixes].
  - eapply gives_all_value_on; [|exact G]. intros S a A.
    destruct (G S) as [_ [_ [W _]]]. rewrite <- W by exact A. reflexivity.
  - pose proof (head_gives _ _ _ _ _ G) as H. cbn [hd] in H.
    specialize (IH _ (tail_gives _ _ _ _ _ G)). cbn [tl] in IH.
    destruct (build_suffixes cs s) as [os s1].
    destruct (either c (hd (constant false) os) s1) as [o s2] eqn:Q. intro S. revert S.
    enough (C : sound s -> gives_all s (o :: os, s2)
                 (fun a => (hd false (w a) || existsb id (tl (w a)))
                           :: suffixes_true (tl (w a))) n).
    { intro S. revert S. eapply gives_all_value_on; [|intro S; exact (C S S)].
      intros S a A. destruct (G S) as [_ [_ [W _]]].
      rewrite <- W; [reflexivity|]. destruct (C S S) as [E _]. eapply extends_true; eauto. }
    intro S.
    pose proof (gives_all_extends _ _ _ _ _ IH) as X1.
    pose proof (extends_sound _ _ (X1 S) S) as S1.
    pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ H X1) S) as H1.
    pose proof (gives_all_here _ _ _ _ _ IH S) as I1.
    pose proof (either_gives _ _ _ _ _ _ _ H1 (head_gives _ _ _ _ _ I1)) as B.
    rewrite Q in B.
    eapply gives_all_earlier; [exact X1|]. apply cons_gives.
    + eapply gives_value; [|exact B]. intro a. cbn beta. rewrite suffixes_true_head. reflexivity.
    + exact (gives_all_later _ _ _ _ _ _ I1 (gives_extends _ _ _ _ _ B)).
Qed.

(** * Rules *)

Definition fact_number (f : fact) : positive := number (Fact f).

Lemma fact_number_even f g : fact_number f <> (g~1)%positive.
Proof. destruct f; discriminate. Qed.

Definition build_fact := build fact fact_number.
Definition build_facts := build_all fact fact_number.

(** For each clause of the rule a literal that is its guard. *)
Definition build_rule (r : reading) (R : rule) (s : state) : list lit * state :=
  let (p, s1) := build_fact (c0 R) s in
  let (cs, s2) := build_facts (conditions R) s1 in
  match r with
  | Cascade => build_guards p cs s2
  | Priority => let (es, s3) := build_suffixes cs s2 in build_guards p es s3
  end.

(** The facts that decide a rule. *)
Definition facts_of_rule (R : rule) : list fact :=
  atoms_of (c0 R) ++ flat_map atoms_of (conditions R).

Definition rule_values (r : reading) (R : rule) (a : positive -> bool) : list bool :=
  map (fun i => triggered (facts_in a) R && (active r (facts_in a) R =? i)) (clause_numbers R).

Lemma map_flat_map {A B C} (f : B -> C) (g : A -> list B) l :
  map f (flat_map g l) = flat_map (fun x => map f (g x)) l.
Proof. induction l; simpl; rewrite ?map_app; congruence. Qed.

Lemma build_rule_gives r R s :
  gives_all s (build_rule r R s) (rule_values r R) (map fact_number (facts_of_rule R)).
Proof.
  unfold build_rule, build_fact, build_facts, facts_of_rule.
  pose proof (build_gives fact fact_number fact_number_even (c0 R) s) as P.
  destruct (build fact fact_number (c0 R) s) as [p s1].
  pose proof (build_all_gives fact fact_number fact_number_even (conditions R) s1) as C.
  destruct (build_all fact fact_number (conditions R) s1) as [cs s2].
  set (n := map fact_number (atoms_of (c0 R) ++ flat_map atoms_of (conditions R))).
  assert (NP : incl (map fact_number (atoms_of (c0 R))) n).
  { unfold n. rewrite map_app. apply incl_appl, incl_refl. }
  assert (NC : incl (flat_map (fun f => map fact_number (atoms_of f)) (conditions R)) n).
  { unfold n. rewrite map_app, map_flat_map. apply incl_appr, incl_refl. }
  apply (gives_needs _ _ _ _ _ NP) in P. apply (gives_all_needs _ _ _ _ _ NC) in C.
  assert (V : forall a, eval (fun f => a (fact_number f)) (c0 R) = triggered (facts_in a) R).
  { intro a. apply (eval_c0 (facts_in a)). }
  assert (T : forall a, map (eval (fun f => a (fact_number f))) (conditions R)
                        = truths (facts_in a) R).
  { intro a. apply (eval_conditions (facts_in a)). }
  assert (Z : forall a bs, length bs = length (hedges R) ->
              longest_prefix bs = active r (facts_in a) R ->
              guard_values (triggered (facts_in a) R) bs = rule_values r R a).
  { intros a bs L A. rewrite guard_values_spec, L, A. reflexivity. }
  assert (L : forall a, length (truths (facts_in a) R) = length (hedges R)).
  { intro a. apply map_length. }
  enough (G : sound s ->
    gives_all s (match r with
                 | Cascade => build_guards p cs s2
                 | Priority => let (es, s3) := build_suffixes cs s2 in build_guards p es s3
                 end) (rule_values r R) n).
  { destruct (match r with Cascade => _ | Priority => _ end) as [gs s9]. intro S. exact (G S S). }
  intro S.
  pose proof (gives_extends _ _ _ _ _ P) as X1. pose proof (extends_sound _ _ (X1 S) S) as S1.
  pose proof (gives_here _ _ _ _ _ P S) as P1.
  pose proof (gives_all_extends _ _ _ _ _ C) as X2.
  pose proof (extends_sound _ _ (X2 S1) S1) as S2.
  pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ P1 X2) S1) as P2.
  pose proof (gives_all_here _ _ _ _ _ C S1) as C2.
  assert (X : sound s -> extends s s2) by (intros _; eapply extends_trans; eauto).
  destruct r.
  - apply (gives_all_earlier _ _ _ _ _ X).
    eapply gives_all_value; [|exact (build_guards_gives _ _ _ _ _ _ P2 C2)].
    intro a. cbn beta. rewrite V, T. apply Z; [apply L|reflexivity].
  - pose proof (build_suffixes_gives _ _ _ _ C2) as E.
    destruct (build_suffixes cs s2) as [es s3].
    pose proof (gives_all_extends _ _ _ _ _ E) as X3.
    pose proof (gives_here _ _ _ _ _ (gives_later _ _ _ _ _ _ P2 X3) S2) as P3.
    pose proof (gives_all_here _ _ _ _ _ E S2) as E3.
    apply (gives_all_earlier s s3); [intros _; exact (extends_trans _ _ _ (X S) (X3 S2))|].
    eapply gives_all_value; [|exact (build_guards_gives _ _ _ _ _ _ P3 E3)].
    intro a. cbn beta. rewrite V, T.
    apply Z; [rewrite suffixes_true_length; apply L|apply cascade_of_suffixes].
Qed.

(** The guards of all clauses of all rules, in the order of the text. *)
Fixpoint build_rules (r : reading) (G : ruleset) (s : state) : list lit * state :=
  match G with
  | [] => ([], s)
  | R :: rest =>
      let (gs, s1) := build_rule r R s in
      let (hs, s2) := build_rules r rest s1 in (gs ++ hs, s2)
  end.

Definition all_clauses (G : ruleset) : list (list literal) := flat_map clauses G.
Definition facts_of (G : ruleset) : list fact := flat_map facts_of_rule G.

Lemma build_rules_gives r G s :
  gives_all s (build_rules r G s) (fun a => flat_map (fun R => rule_values r R a) G)
            (map fact_number (facts_of G)).
Proof.
  revert s. induction G as [|R G IH]; intro s; cbn [build_rules flat_map].
  - apply nil_gives.
  - pose proof (build_rule_gives r R s) as P. destruct (build_rule r R s) as [gs s1].
    specialize (IH s1). destruct (build_rules r G s1) as [hs s2].
    unfold facts_of. cbn [flat_map]. rewrite map_app. apply app_gives.
    + eapply gives_all_later; [|apply (gives_all_extends _ _ _ _ _ IH)].
      eapply gives_all_needs; [|exact P]. apply incl_appl, incl_refl.
    + eapply gives_all_earlier; [apply (gives_all_extends _ _ _ _ _ P)|].
      eapply gives_all_needs; [|exact IH]. apply incl_appr, incl_refl.
Qed.

(** * What is due, read off the guards *)

Definition guarded (r : reading) (G : ruleset) (s : state)
  : list (list literal * lit) * state :=
  let (gs, s1) := build_rules r G s in (combine (all_clauses G) gs, s1).

Lemma combine_app {A B} (xs xs' : list A) (ys ys' : list B) :
  length xs = length ys -> combine (xs ++ xs') (ys ++ ys') = combine xs ys ++ combine xs' ys'.
Proof.
  revert ys. induction xs as [|x xs IH]; intros [|y ys] L; simpl in *; try discriminate; auto.
  rewrite IH by congruence. reflexivity.
Qed.

Lemma combine_map_r {A B C} (f : B -> C) (xs : list A) ys :
  combine xs (map f ys) = map (fun p => (fst p, f (snd p))) (combine xs ys).
Proof. revert ys. induction xs; intros [|y ys]; simpl; congruence. Qed.

Lemma clauses_seq R : clauses R = map (clause R) (clause_numbers R).
Proof.
  unfold clause, clause_numbers. rewrite <- clauses_length.
  generalize (clauses R). clear. intro cs. induction cs as [|c cs IH]; [reflexivity|].
  cbn [length seq map nth]. rewrite <- seq_shift, map_map. cbn [nth]. congruence.
Qed.

Lemma in_combine_values r G a O b :
  In (O, b) (combine (all_clauses G) (flat_map (fun R => rule_values r R a) G)) <->
  exists R i, In R G /\ i <= length (hedges R) /\ O = clause R i /\
              b = triggered (facts_in a) R && (active r (facts_in a) R =? i).
Proof.
  induction G as [|R G IH].
  - simpl. split; [tauto|]. intros [R [i [[] _]]].
  - unfold all_clauses in *. cbn [flat_map].
    rewrite combine_app by (unfold rule_values; rewrite clauses_seq, !map_length; reflexivity).
    rewrite in_app_iff, IH.
    assert (C : forall ns, combine (map (clause R) ns)
                 (map (fun i => triggered (facts_in a) R && (active r (facts_in a) R =? i)) ns)
               = map (fun i => (clause R i, triggered (facts_in a) R
                                            && (active r (facts_in a) R =? i))) ns).
    { induction ns; simpl; congruence. }
    unfold rule_values at 1. rewrite clauses_seq, C, in_map_iff. split.
    + intros [[i [E I]]|[Q [i [I R']]]].
      * injection E as <- <-. apply in_clause_numbers in I. exists R, i. simpl. auto.
      * exists Q, i. simpl. tauto.
    + intros [Q [i [[<-|I] [B [-> ->]]]]].
      * left. exists i. split; [reflexivity|]. apply in_clause_numbers, B.
      * right. exists Q, i. auto.
Qed.

(** A literal is due in a context exactly where it stands by a guard that is true. *)
Lemma guarded_due r G s a l :
  sound s -> cnf_true a (built (snd (guarded r G s))) = true ->
  In l (due r G (facts_in a)) <->
  exists O g, In (O, g) (fst (guarded r G s)) /\ lit_true a g = true /\ In l O.
Proof.
  unfold guarded. pose proof (build_rules_gives r G s) as P.
  destruct (build_rules r G s) as [gs s1]. cbn [fst snd]. intros S A.
  destruct (P S) as [_ [_ [V _]]]. specialize (V a A). rewrite in_due. split.
  - intros [R [I [T L]]].
    assert (X : In (clause R (active r (facts_in a) R), true)
                   (combine (all_clauses G) (map (lit_true a) gs))).
    { rewrite V. apply in_combine_values. exists R, (active r (facts_in a) R).
      rewrite T, Nat.eqb_refl. auto using active_bound. }
    rewrite combine_map_r in X. apply in_map_iff in X. destruct X as [[O g] [E X]].
    injection E as E1 E2. simpl in *. exists O, g.
    split; [exact X|]. split; [exact E2|]. rewrite E1. exact L.
  - intros [O [g [X [T L]]]].
    assert (Y : In (O, true) (combine (all_clauses G) (map (lit_true a) gs))).
    { rewrite combine_map_r. apply in_map_iff. exists (O, g). simpl. rewrite T. auto. }
    rewrite V in Y. apply in_combine_values in Y. destruct Y as [R [i [I [B [-> E]]]]].
    symmetry in E. apply andb_true_iff in E. destruct E as [E1 E2].
    apply Nat.eqb_eq in E2. subst i. eauto.
Qed.

(** * Equation 1 of a ruleset, as clauses *)

Definition lit_of (l : literal) : lit :=
  match l with
  | Do o => (true, number (Done o))
  | Avoid o => (false, number (Done o))
  end.

Lemma lit_of_true a l : lit_true a (lit_of l) = true_in (atoms_in a) l.
Proof. destruct l as [o|o]; unfold true_in, atoms_in; cbn; destruct (a _); reflexivity. Qed.

Lemma lit_of_opposite l : lit_of (opposite l) = negate (lit_of l).
Proof. destruct l; reflexivity. Qed.

Definition implications (gs : list (list literal * lit)) : cnf :=
  flat_map (fun p => map (fun l => [negate (snd p); lit_of l]) (fst p)) gs.

Definition equation_clauses (r : reading) (G : ruleset) : cnf :=
  let (gs, s) := guarded r G start in implications gs ++ built s.

Lemma implications_true a gs :
  cnf_true a (implications gs) = true <->
  forall O g l, In (O, g) gs -> lit_true a g = true -> In l O -> true_in (atoms_in a) l = true.
Proof.
  unfold implications. rewrite cnf_true_spec. split.
  - intros H O g l I T L. assert (C : clause_true a [negate g; lit_of l] = true).
    { apply H, in_flat_map. exists (O, g). split; [exact I|].
      apply in_map_iff. exists l. auto. }
    unfold clause_true in C. cbn [existsb] in C.
    rewrite lit_true_negate, T, lit_of_true, orb_false_r in C. exact C.
  - intros H c C. apply in_flat_map in C. destruct C as [[O g] [I C]].
    apply in_map_iff in C. destruct C as [l [<- L]]. simpl in L.
    unfold clause_true. cbn [existsb fst snd]. rewrite lit_true_negate, lit_of_true.
    destruct (lit_true a g) eqn:T; [|reflexivity]. rewrite (H O g l I T L). reflexivity.
Qed.

Lemma guarded_extends r G s : sound s -> extends s (snd (guarded r G s)).
Proof.
  intro S. unfold guarded. pose proof (build_rules_gives r G s) as P.
  destruct (build_rules r G s) as [gs s1]. apply (P S).
Qed.

Lemma equation_clauses_true r G a :
  cnf_true a (equation_clauses r G) = true <->
  cnf_true a (built (snd (guarded r G start))) = true /\ models r G (atoms_in a).
Proof.
  unfold equation_clauses. pose proof (guarded_due r G start a) as D.
  destruct (guarded r G start) as [gs s]. cbn [fst snd] in *.
  rewrite cnf_true_app, andb_true_iff, implications_true.
  rewrite (models_iff_due r G (facts_in a)) by (intro; reflexivity). split.
  - intros [H B]. split; [exact B|]. intros l I.
    apply (D l start_sound B) in I. destruct I as [O [g [I [T L]]]]. eauto.
  - intros [B H]. split; [|exact B]. intros O g l I T L. apply H.
    apply (D l start_sound B). eauto.
Qed.

(** An interpretation of the atoms, extended to the gates. *)
Lemma assignment_exists r G v :
  exists a, (forall x, atoms_in a x = v x) /\
            cnf_true a (built (snd (guarded r G start))) = true.
Proof.
  destruct (guarded_extends r G start start_sound) as [_ [_ [_ E]]].
  destruct (E start_sound (assignment_of v)) as [a [A T]]; [reflexivity|].
  exists a. split; [|exact T]. intro x. unfold atoms_in. rewrite A.
  - unfold assignment_of. rewrite atom_of_number. reflexivity.
  - destruct x as [[t|c]|o]; exact I.
Qed.

(** The clauses say of the atoms what Equation 1 says, no more and no less. *)
Theorem equation_clauses_conservative r G v :
  models r G v <->
  exists a, (forall x, atoms_in a x = v x) /\ cnf_true a (equation_clauses r G) = true.
Proof.
  assert (X : forall a, (forall x, atoms_in a x = v x) ->
              models r G (atoms_in a) <-> models r G v).
  { intros a A. unfold models. split; intros M R I; rewrite <- (M R I);
      apply eval_ext; intro; rewrite A; reflexivity. }
  split.
  - intro M. destruct (assignment_exists r G v) as [a [A T]].
    exists a. split; [exact A|]. apply equation_clauses_true. rewrite X by exact A. auto.
  - intros [a [A T]]. apply equation_clauses_true in T. apply (X a A), T.
Qed.
