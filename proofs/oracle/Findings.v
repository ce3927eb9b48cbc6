(** What checks find, from the rules on: that a rule or a hedge is dead or redundant, that
    a rule can be triggered in conflicts only, or that assumptions leave no situation.
    Each is a claim about all contexts; its formula is refuted, as in [Certified.v], by
    untrusted steps. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import
  Model Evaluation Equation Readings Nested Clauses Constraints Clashes Conflict Entailment
  Question Checks.
From Checker Require Formula Checker Soundness.
From Oracle Require Import Certified.
Import ListNotations.

(** * Clauses by their numbers

    Clause 0 is the default; the others are numbered in the order of the text, those of a
    chain in parentheses after the clause that holds it. *)

(** How many there are. *)
Fixpoint size (c : chain) : nat :=
  let (_, hs) := c in S (list_sum (map (fun h => size (snd h)) hs)).

(** What each obliges. *)
Fixpoint responses (c : chain) : list (list literal) :=
  let (ls, hs) := c in ls :: flat_map (fun h => responses (snd h)) hs.

(** The number of the clause that decides. *)
Fixpoint deciding (r : reading) (chi : context) (c : chain) : nat :=
  let (_, hs) := c in
  nth (decides r (map (fun h => satisfies chi (fst h)) hs))
      (0 :: (fix go (from : nat) (rest : list (condition * chain)) : list nat :=
               match rest with
               | [] => []
               | h :: more => from + deciding r chi (snd h) :: go (from + size (snd h)) more
               end) 1 hs) 0.

(** The numbers that the members of a chain have if they decide, the first clause of the
    first being [from]. *)
Definition deciding_from (r : reading) (chi : context) :=
  fix go (from : nat) (rest : list (condition * chain)) : list nat :=
    match rest with
    | [] => []
    | h :: more => from + deciding r chi (snd h) :: go (from + size (snd h)) more
    end.

Definition sizes (hs : list (condition * chain)) : nat := list_sum (map (fun h => size (snd h)) hs).

Lemma deciding_from_bounds r chi rest : forall from d,
  (forall h, In h rest -> deciding r chi (snd h) < size (snd h)) -> d < length rest ->
  from <= nth d (deciding_from r chi from rest) 0 < from + sizes rest.
Proof.
  induction rest as [|h rest IH]; intros from d B L; [simpl in L; lia|].
  unfold sizes. cbn [deciding_from map list_sum fold_right length] in *.
  fold (list_sum (map (fun h => size (snd h)) rest)). fold (sizes rest).
  pose proof (B h (or_introl eq_refl)). destruct d as [|d]; cbn [nth]; [lia|].
  specialize (IH (from + size (snd h)) d (fun k I => B k (or_intror I))). lia.
Qed.

(** The place of the member that decides; 0 is what the members may take the place of. *)
Definition member (r : reading) (chi : context) (hs : list (condition * chain)) : nat :=
  decides r (map (fun h => satisfies chi (fst h)) hs).

Lemma member_bound r chi hs : member r chi hs <= length hs.
Proof. eapply Nat.le_trans; [apply decides_bound|]. rewrite map_length. auto. Qed.

Lemma deciding_chain r chi ls hs :
  deciding r chi (Chain ls hs) = nth (member r chi hs) (0 :: deciding_from r chi 1 hs) 0.
Proof. reflexivity. Qed.

Lemma deciding_bound r chi c : deciding r chi c < size c.
Proof.
  induction c as [ls hs IH] using chain_induction. rewrite deciding_chain.
  cbn [size]. fold (sizes hs). pose proof (member_bound r chi hs) as B.
  destruct (member r chi hs) as [|d]; cbn [nth]; [lia|].
  pose proof (deciding_from_bounds r chi hs 1 d IH). lia.
Qed.

Lemma responses_length c : length (responses c) = size c.
Proof.
  induction c as [ls hs IH] using chain_induction. cbn [responses size length]. f_equal.
  induction hs as [|h hs IHh]; [reflexivity|]. cbn [flat_map map list_sum fold_right].
  rewrite app_length, (IH h (or_introl eq_refl)). f_equal.
  apply IHh. intros k I. apply IH. right. exact I.
Qed.

(** It is that clause which speaks. *)
Theorem deciding_due r chi c : nth (deciding r chi c) (responses c) [] = chain_due r chi c.
Proof.
  induction c as [ls hs IH] using chain_induction. rewrite deciding_chain.
  cbn [responses chain_due]. fold (member r chi hs). pose proof (member_bound r chi hs) as B.
  destruct (member r chi hs) as [|d]; [reflexivity|]. cbn [nth].
  enough (E : forall rest before d, (forall h, In h rest -> In h hs) -> d < length rest ->
    nth (nth d (deciding_from r chi (length before) rest) 0)
        (before ++ flat_map (fun h => responses (snd h)) rest) []
    = nth d (map (fun h => chain_due r chi (snd h)) rest) [])
    by exact (E hs [ls] d (fun h I => I) B).
  clear B d. induction rest as [|h rest IHr]; intros before d S L; [simpl in L; lia|].
  cbn [deciding_from flat_map map length] in *. destruct d as [|d]; cbn [nth].
  - rewrite app_nth2 by lia.
    replace (length before + deciding r chi (snd h) - length before) with (deciding r chi (snd h)) by lia.
    rewrite app_nth1 by (rewrite responses_length; apply deciding_bound).
    apply IH, S. left. reflexivity.
  - rewrite app_assoc, <- (responses_length (snd h)), <- app_length.
    apply IHr; [intros; apply S; right; assumption|lia].
Qed.

(** Where clause [n] decides, as a condition. *)
Fixpoint clause_guard (r : reading) (g : condition) (c : chain) (n : nat) : condition :=
  let (_, hs) := c in
  match n with
  | 0 => member_guard r g hs 0
  | S k =>
      (fix go (i k : nat) (rest : list (condition * chain)) : condition :=
         match rest with
         | [] => Truth false
         | h :: more =>
             if k <? size (snd h) then clause_guard r (member_guard r g hs i) (snd h) k
             else go (S i) (k - size (snd h)) more
         end) 1 k hs
  end.

Theorem clause_guard_spec r chi c : forall g n,
  satisfies chi (clause_guard r g c n) = satisfies chi g && (deciding r chi c =? n).
Proof.
  induction c as [ls hs IH] using chain_induction. intros g n. rewrite deciding_chain.
  pose proof (member_bound r chi hs) as B.
  destruct n as [|k]; cbn [clause_guard].
  - rewrite member_guard_spec by lia. fold (member r chi hs). f_equal.
    destruct (member r chi hs) as [|d]; [reflexivity|]. cbn [nth].
    pose proof (deciding_from_bounds r chi hs 1 d (fun h _ => deciding_bound r chi (snd h))).
    symmetry. apply Nat.eqb_neq. lia.
  - match goal with |- satisfies chi (?go 1 k hs) = _ =>
      enough (E : forall rest i from k, (forall h, In h rest -> In h hs) ->
                i + length rest = S (length hs) -> 1 <= i ->
                satisfies chi (go i k rest) = satisfies chi g && ((i <=? member r chi hs) &&
                  (nth (member r chi hs - i) (deciding_from r chi from rest) 0 =? from + k)))
    end.
    { rewrite (E hs 1 1 k) by (auto; lia). f_equal.
      destruct (member r chi hs) as [|d]; [reflexivity|]. cbn [nth].
      replace (S d - 1) with d by lia. reflexivity. }
    induction rest as [|h rest IHr]; intros i from j S L P.
    + simpl in L. destruct (Nat.leb_spec i (member r chi hs)); [lia|].
      rewrite andb_false_r. reflexivity.
    + cbn [length deciding_from] in *. pose proof (deciding_bound r chi (snd h)) as D.
      destruct (Nat.ltb_spec j (size (snd h))) as [J|J].
      * rewrite (IH h (S h (or_introl eq_refl))), member_guard_spec by lia.
        fold (member r chi hs). rewrite <- andb_assoc. f_equal.
        destruct (Nat.leb_spec i (member r chi hs)) as [I|I]; cbn [andb].
        -- destruct (Nat.eqb_spec (member r chi hs) i) as [->|N]; cbn [andb].
           ++ rewrite Nat.sub_diag. cbn [nth].
              destruct (Nat.eqb_spec (deciding r chi (snd h)) j); symmetry;
                [apply Nat.eqb_eq|apply Nat.eqb_neq]; lia.
           ++ destruct (member r chi hs - i) as [|d] eqn:Q; [lia|]. cbn [nth].
              pose proof (deciding_from_bounds r chi rest (from + size (snd h)) d
                            (fun k _ => deciding_bound r chi (snd k))).
              symmetry. apply Nat.eqb_neq. lia.
        -- destruct (Nat.eqb_spec (member r chi hs) i); [lia|reflexivity].
      * rewrite (IHr (Datatypes.S i) (from + size (snd h)) (j - size (snd h)))
          by (try lia; intros; apply S; right; assumption).
        f_equal.
        destruct (Nat.leb_spec i (member r chi hs)) as [I|I],
                 (Nat.leb_spec (Datatypes.S i) (member r chi hs)) as [I'|I']; try lia; try reflexivity; cbn [andb].
        -- replace (member r chi hs - i) with (Datatypes.S (member r chi hs - Datatypes.S i)) by lia.
           cbn [nth]. f_equal. lia.
        -- replace (member r chi hs - i) with 0 by lia. cbn [nth].
           symmetry. apply Nat.eqb_neq. lia.
Qed.

(** Without clause [n], and the chain that it holds. *)
Fixpoint without_clause (n : nat) (c : chain) : chain :=
  let (ls, hs) := c in
  match n with
  | 0 => c
  | S k =>
      Chain ls
        ((fix go (k : nat) (rest : list (condition * chain)) : list (condition * chain) :=
            match rest, k with
            | [], _ => []
            | _ :: more, 0 => more
            | h :: more, _ =>
                if k <? size (snd h) then (fst h, without_clause k (snd h)) :: more
                else h :: go (k - size (snd h)) more
            end) k hs)
  end.

Definition without_hedge (n : nat) (R : nested_rule) : nested_rule :=
  NestedRule (nested_label R) (nested_trigger R) (nested_guard R) (without_clause n (response R)).

(** * Rules by their labels *)

Definition labelled (n : name) (R : nested_rule) : bool := Pos.eqb (nested_label R) n.

Definition those (ns : list name) (Rs : list nested_rule) : list nested_rule :=
  filter (fun R => existsb (fun n => labelled n R) ns) Rs.

(** The others than this one. *)
Definition others (n : name) (Rs : list nested_rule) : list nested_rule :=
  filter (fun R => negb (labelled n R)) Rs.

(** The same rules, but for hedge [i] of this one. *)
Definition lacking_hedge (n : name) (i : nat) (Rs : list nested_rule) : list nested_rule :=
  map (fun R => if labelled n R then without_hedge i R else R) Rs.

Definition picked {A} (ns : list nat) (xs : list A) : list A :=
  flat_map (fun n => match nth_error xs n with Some x => [x] | None => [] end) ns.

Lemma picked_incl {A} ns (xs : list A) : incl (picked ns xs) xs.
Proof.
  intros x I. apply in_flat_map in I. destruct I as [n [_ I]].
  destruct (nth_error xs n) eqn:E; [|destruct I]. destruct I as [<-|[]].
  exact (nth_error_In _ _ E).
Qed.

Lemma those_incl ns Rs : incl (those ns Rs) Rs.
Proof. intros R I. apply filter_In in I. apply I. Qed.

Lemma all_due_incl r chi Rs Ss : incl Rs Ss -> incl (all_due r chi Rs) (all_due r chi Ss).
Proof.
  intros S l I. apply in_flat_map in I. destruct I as [R [I H]]. apply in_flat_map.
  exists R. split; [apply S, I|exact H].
Qed.

Definition nested_triggered (chi : context) (R : nested_rule) : bool :=
  chi (Occurs (nested_trigger R)) && satisfies chi (nested_guard R).

(** The trigger, and a condition. *)
Definition while (R : nested_rule) (g : condition) : formula fact :=
  And (Atom (Occurs (nested_trigger R))) g.

Lemma while_spec chi R g :
  eval chi (while R g) = chi (Occurs (nested_trigger R)) && satisfies chi g.
Proof. reflexivity. Qed.

(** * Findings *)

(** What there is to show for one names rules and constraints that suffice to show it.  Which
    these are is for nobody to believe: with others it may not be shown, and is no less
    true if it is. *)
Inductive finding :=
  | DeadRule (rule : name)
  | DeadHedge (rule : name) (hedge : nat)
  | RedundantRule (rule : name) (obliging_too : list name)
  | RedundantHedge (rule : name) (hedge : nat) (obliging_too : list name)
  | VacuousConflict (rule : name) (meeting : list name) (keeping : list nat)
  | NoSituation.

(** What each says. *)
Definition holds (r : reading) (Rs : list nested_rule) (Ks : list constraint) (f : finding) : Prop :=
  match f with
  | DeadRule n =>
      forall R chi, In R Rs -> labelled n R = true -> possible Ks chi = true ->
      nested_triggered chi R = false
  | DeadHedge n i =>
      forall R chi, In R Rs -> labelled n R = true -> possible Ks chi = true ->
      nested_triggered chi R = true -> deciding r chi (response R) <> i
  | RedundantRule n _ =>
      forall chi, possible Ks chi = true ->
      same_literals (all_due r chi Rs) (all_due r chi (others n Rs))
  | RedundantHedge n i _ =>
      forall chi, possible Ks chi = true ->
      same_literals (all_due r chi Rs) (all_due r chi (lacking_hedge n i Rs))
  | VacuousConflict n _ _ =>
      forall R chi, In R Rs -> labelled n R = true -> possible Ks chi = true ->
      nested_triggered chi R = true -> ~ jointly_possible Ks chi (all_due r chi Rs)
  | NoSituation => forall chi, possible Ks chi = false
  end.

(** Due by the one ruleset and not by the other, for some literal of the one. *)
Definition more (r : reading) (G H : ruleset) : list (formula fact) :=
  map (fun l => And (due_formula r G l) (Not (due_formula r H l)))
      (nodup literal_eq_dec (obliged_literals G)).

(** Due by one of two rulesets and not by the other, nor by a third. *)
Definition unlike (r : reading) (G G' H : ruleset) : list (formula fact) :=
  map (fun l => And (different (due_formula r G l) (due_formula r G' l)) (Not (due_formula r H l)))
      (nodup literal_eq_dec (obliged_literals G ++ obliged_literals G')).

(** Where one of these is true in a context that can be, it is not so; where what suffices
    is named, only there. *)
Definition against (r : reading) (Rs : list nested_rule) (Ks : list constraint) (f : finding)
  : list (formula fact) :=
  match f with
  | DeadRule n => map (fun R => while R (nested_guard R)) (those [n] Rs)
  | DeadHedge n i =>
      map (fun R => while R (clause_guard r (nested_guard R) (response R) i)) (those [n] Rs)
  | RedundantRule n ns =>
      let cover := flat r (those ns (others n Rs)) in
      flat_map (fun R => more r (flatten r R) cover) (those [n] Rs)
  | RedundantHedge n i ns =>
      let cover := flat r (those ns (others n Rs)) in
      flat_map (fun R => unlike r (flatten r R) (flatten r (without_hedge i R)) cover) (those [n] Rs)
  | VacuousConflict n ns ks =>
      let among := those ns Rs in
      let kept := picked ks Ks in
      map (fun R =>
             let G := flat r (R :: among) in
             And (while R (nested_guard R)) (Not (disj (map (clash_formula r G) (all_clashes G kept)))))
          (those [n] Rs)
  | NoSituation => [Truth true]
  end.

Lemma those_one n R Rs : In R (those [n] Rs) <-> In R Rs /\ labelled n R = true.
Proof.
  unfold those. rewrite filter_In. cbn [existsb]. rewrite orb_false_r. reflexivity.
Qed.

Lemma due_formula_flat r chi Rs l :
  eval chi (due_formula r (flat r Rs) l) = true <-> In l (all_due r chi Rs).
Proof. rewrite due_formula_spec, listed_In. apply flat_due. Qed.

Lemma due_formula_nested r chi R l :
  eval chi (due_formula r (flatten r R) l) = true <-> In l (nested_due r chi R).
Proof. rewrite due_formula_spec, listed_In. apply flatten_due. Qed.

Lemma more_none r chi R Ss l :
  (forall f, In f (more r (flatten r R) (flat r Ss)) -> eval chi f = false) ->
  In l (nested_due r chi R) -> In l (all_due r chi Ss).
Proof.
  intros N I. apply due_formula_flat.
  assert (O : In l (obliged_literals (flatten r R))) by (apply (due_obliged r _ chi), flatten_due, I).
  specialize (N (And (due_formula r (flatten r R) l) (Not (due_formula r (flat r Ss) l)))).
  cbn [eval] in N. apply due_formula_nested in I. rewrite I in N. apply negb_false_iff, N.
  apply in_map_iff. exists l. split; [reflexivity|]. apply nodup_In, O.
Qed.

Lemma unlike_none r chi R R' Ss l :
  (forall f, In f (unlike r (flatten r R) (flatten r R') (flat r Ss)) -> eval chi f = false) ->
  In l (nested_due r chi R) \/ In l (nested_due r chi R') ->
  In l (all_due r chi Ss) \/ (In l (nested_due r chi R) <-> In l (nested_due r chi R')).
Proof.
  intros N I. destruct (eval chi (due_formula r (flat r Ss) l)) eqn:D;
    [left; apply due_formula_flat, D|right].
  specialize (N (And (different (due_formula r (flatten r R) l) (due_formula r (flatten r R') l))
                     (Not (due_formula r (flat r Ss) l)))).
  unfold different in N. cbn [eval] in N. rewrite D, andb_true_r in N.
  rewrite <- !due_formula_nested.
  assert (O : In l (nodup literal_eq_dec (obliged_literals (flatten r R) ++ obliged_literals (flatten r R')))).
  { apply nodup_In, in_app_iff. destruct I as [I|I]; [left|right];
      apply (due_obliged r _ chi), flatten_due, I. }
  assert (X := N (in_map (fun l => And (different (due_formula r (flatten r R) l) (due_formula r (flatten r R') l))
                     (Not (due_formula r (flat r Ss) l))) _ l O)).
  destruct (eval chi (due_formula r (flatten r R) l)), (eval chi (due_formula r (flatten r R') l));
    simpl in X; try discriminate X; split; intro E; exact E.
Qed.

Lemma in_others n R Rs : In R (others n Rs) <-> In R Rs /\ labelled n R = false.
Proof. unfold others. rewrite filter_In, negb_true_iff. reflexivity. Qed.

Lemma others_lacking n i Rs : incl (others n Rs) (lacking_hedge n i Rs).
Proof.
  intros R I. apply in_others in I. destruct I as [I L]. apply in_map_iff. exists R.
  rewrite L. auto.
Qed.

(** What is against a finding refuted, it holds. *)
Lemma holds_unless_against r Rs Ks f :
  (forall chi phi, possible Ks chi = true -> In phi (against r Rs Ks f) -> eval chi phi = false) ->
  holds r Rs Ks f.
Proof.
  destruct f as [n|n i|n ns|n i ns|n ns ks|]; cbn [against holds]; intro N.
  - intros R chi I L P. rewrite <- (N chi (while R (nested_guard R)) P); [symmetry; apply while_spec|].
    apply in_map_iff. exists R. split; [reflexivity|]. apply those_one. auto.
  - intros R chi I L P T D.
    assert (X : eval chi (while R (clause_guard r (nested_guard R) (response R) i)) = false).
    { apply (N chi _ P). apply in_map_iff. exists R. split; [reflexivity|]. apply those_one. auto. }
    rewrite while_spec, clause_guard_spec, andb_assoc in X. unfold nested_triggered in T.
    rewrite T, D, Nat.eqb_refl in X. discriminate X.
  - intros chi P l. split; [|apply all_due_incl; intros R I; apply in_others in I; apply I].
    intro I. apply in_flat_map in I. destruct I as [R [I H]].
    destruct (labelled n R) eqn:L.
    + apply (all_due_incl r chi _ _ (those_incl ns (others n Rs))).
      apply (more_none r chi R); [|exact H]. intros f F. apply (N chi f P).
      apply in_flat_map. exists R. split; [apply those_one; auto|exact F].
    + apply in_flat_map. exists R. split; [apply in_others; auto|exact H].
  - intros chi P l.
    assert (C : incl (all_due r chi (those ns (others n Rs))) (all_due r chi (others n Rs)))
      by apply all_due_incl, those_incl.
    assert (E : forall R, In R Rs -> labelled n R = true ->
      In l (nested_due r chi R) \/ In l (nested_due r chi (without_hedge i R)) ->
      In l (all_due r chi (others n Rs)) \/
      (In l (nested_due r chi R) <-> In l (nested_due r chi (without_hedge i R)))).
    { intros R I L H. destruct (unlike_none r chi R (without_hedge i R) (those ns (others n Rs)) l) as [X|X];
        [|exact H|left; apply C, X|right; exact X].
      intros f F. apply (N chi f P). apply in_flat_map. exists R. split; [apply those_one; auto|exact F]. }
    split; intro I; apply in_flat_map in I; destruct I as [R [I H]].
    + destruct (labelled n R) eqn:L.
      * destruct (E R I L (or_introl H)) as [X|X]; [exact (all_due_incl r chi _ _ (others_lacking n i Rs) l X)|].
        apply in_flat_map. exists (without_hedge i R). split; [|apply X, H].
        apply in_map_iff. exists R. rewrite L. auto.
      * apply in_flat_map. exists R. split; [|exact H]. apply in_map_iff. exists R. rewrite L. auto.
    + apply in_map_iff in I. destruct I as [R' [<- I]]. destruct (labelled n R') eqn:L.
      * destruct (E R' I L (or_intror H)) as [X|X].
        -- revert X. apply all_due_incl. intros S J. apply in_others in J. apply J.
        -- apply in_flat_map. exists R'. split; [exact I|apply X, H].
      * apply in_flat_map. exists R'. auto.
  - intros R chi I L P T [v [A [D K]]].
    set (G := flat r (R :: those ns Rs)) in *.
    assert (X : eval chi (And (while R (nested_guard R))
                  (Not (disj (map (clash_formula r G) (all_clashes G (picked ks Ks)))))) = false).
    { apply (N chi _ P). apply in_map_iff. exists R. split; [reflexivity|]. apply those_one. auto. }
    cbn [eval] in X. rewrite while_spec in X. unfold nested_triggered in T. rewrite T in X. cbn [andb] in X.
    apply negb_false_iff in X. rewrite eval_disj, existsb_map, existsb_exists in X.
    destruct X as [c [IC X]]. rewrite clash_formula_value in X.
    assert (W : compatible r G (picked ks Ks) chi).
    { exists v. split; [exact A|]. split.
      - intros l J. apply D. apply (flat_due r chi) in J. revert J. apply all_due_incl.
        intros S [<-|J]; [exact I|exact (those_incl _ _ _ J)].
      - intros k J. apply K. exact (picked_incl _ _ _ J). }
    apply clash_here_spec in W. apply not_true_iff_false in W. apply W.
    unfold clash_here, one_here. apply existsb_exists. eauto.
  - intro chi. apply not_true_is_false. intro P. specialize (N chi (Truth true) P (or_introl eq_refl)).
    discriminate N.
Qed.

(** Whether the rules and hedges that it names exist: everything is true of a missing rule. *)
Definition there (Rs : list nested_rule) (f : finding) : bool :=
  match f with
  | DeadRule n | RedundantRule n _ | VacuousConflict n _ _ => existsb (labelled n) Rs
  | DeadHedge n i | RedundantHedge n i _ =>
      existsb (fun R => labelled n R && (1 <=? i) && (i <? size (response R))) Rs
  | NoSituation => true
  end.

(** One formula for all findings of a check; one that nothing refutes, if there is not what
    they speak of. *)
Definition findings_to_refute (r : reading) (Rs : list nested_rule) (Ks : list constraint)
    (fs : list finding) : Formula.formula :=
  if forallb (there Rs) fs
  then formula_for (dense (questions_clauses Ks (flat_map (against r Rs Ks) fs)))
  else [].

Lemma nothing_refutes steps : accepted [] steps = false.
Proof.
  unfold accepted. destruct (Checker.check [] steps) eqn:E; try reflexivity.
  exfalso. apply Soundness.check_sound in E. apply (E (fun _ => true)). intros c [].
Qed.

Theorem certified_findings r Rs Ks fs steps :
  accepted (findings_to_refute r Rs Ks fs) steps = true ->
  forall f, In f fs -> there Rs f = true /\ holds r Rs Ks f.
Proof.
  unfold findings_to_refute. destruct (forallb (there Rs) fs) eqn:T.
  - intros C f I. split; [rewrite forallb_forall in T; apply T, I|].
    apply accepted_unsatisfiable in C. rewrite questions_answered_no in C.
    apply holds_unless_against. intros chi phi P J. apply (C chi phi P), in_flat_map. eauto.
  - rewrite nothing_refutes. discriminate.
Qed.

(** ** What that says of each check *)

(** Some steps are accepted. *)
Definition refuted (r : reading) (Rs : list nested_rule) (Ks : list constraint)
    (fs : list finding) : Prop :=
  exists steps, accepted (findings_to_refute r Rs Ks fs) steps = true.

Lemma refuted_holds r Rs Ks fs f : refuted r Rs Ks fs -> In f fs -> holds r Rs Ks f.
Proof. intros [steps C] I. exact (proj2 (certified_findings r Rs Ks fs steps C f I)). Qed.

(** The rule is triggered in no context that can be. *)
Corollary certified_dead_rule r Rs Ks fs n :
  refuted r Rs Ks fs -> In (DeadRule n) fs ->
  forall R chi, In R Rs -> nested_label R = n -> possible Ks chi = true ->
  nested_triggered chi R = false.
Proof.
  intros C I R chi J L. apply (refuted_holds _ _ _ _ _ C I R chi J).
  apply Pos.eqb_eq, L.
Qed.

(** The hedge decides in no context that can be. *)
Corollary certified_dead_hedge r Rs Ks fs n i :
  refuted r Rs Ks fs -> In (DeadHedge n i) fs ->
  forall R chi, In R Rs -> nested_label R = n -> possible Ks chi = true ->
  nested_triggered chi R = true -> deciding r chi (response R) <> i.
Proof.
  intros C I R chi J L. apply (refuted_holds _ _ _ _ _ C I R chi J).
  apply Pos.eqb_eq, L.
Qed.

(** Without the rule, every context that can be obliges the same. *)
Corollary certified_redundant_rule r Rs Ks fs n ns :
  refuted r Rs Ks fs -> In (RedundantRule n ns) fs ->
  forall chi, possible Ks chi = true ->
  same_literals (all_due r chi Rs) (all_due r chi (others n Rs)).
Proof. intros C I. exact (refuted_holds _ _ _ _ _ C I). Qed.

(** Without the hedge, too. *)
Corollary certified_redundant_hedge r Rs Ks fs n i ns :
  refuted r Rs Ks fs -> In (RedundantHedge n i ns) fs ->
  forall chi, possible Ks chi = true ->
  same_literals (all_due r chi Rs) (all_due r chi (lacking_hedge n i Rs)).
Proof. intros C I. exact (refuted_holds _ _ _ _ _ C I). Qed.

(** Wherever the rule is triggered, not all that is due can be done with all constraints
    kept. *)
Corollary certified_vacuous_conflict r Rs Ks fs n ns ks :
  refuted r Rs Ks fs -> In (VacuousConflict n ns ks) fs ->
  forall R chi, In R Rs -> nested_label R = n -> possible Ks chi = true ->
  nested_triggered chi R = true -> ~ jointly_possible Ks chi (all_due r chi Rs).
Proof.
  intros C I R chi J L. apply (refuted_holds _ _ _ _ _ C I R chi J).
  apply Pos.eqb_eq, L.
Qed.

(** No context can be. *)
Corollary certified_no_situation r Rs Ks fs :
  refuted r Rs Ks fs -> In NoSituation fs -> forall chi, possible Ks chi = false.
Proof. intros C I. exact (refuted_holds _ _ _ _ _ C I). Qed.

(** * One question after the other *)

(** What a ruleset is asked about: whether some context conflicts, whether some rule
    depends on the reading, whether one of some findings is false. *)
Inductive question :=
  | AnyConflict
  | AnyReading
  | AnyFalse (findings : list finding).

Definition formula_of_question (r : reading) (Rs : list nested_rule) (Ks : list constraint)
    (q : question) : Formula.formula :=
  match q with
  | AnyConflict => to_refute r Rs Ks
  | AnyReading => reading_to_refute Rs Ks
  | AnyFalse fs => findings_to_refute r Rs Ks fs
  end.

(** What is true of the rules if its formula is unsatisfiable. *)
Definition answered_no (r : reading) (Rs : list nested_rule) (Ks : list constraint)
    (q : question) : Prop :=
  match q with
  | AnyConflict => never_conflicts r Rs Ks
  | AnyReading => reads_alike Rs Ks
  | AnyFalse fs => forall f, In f fs -> there Rs f = true /\ holds r Rs Ks f
  end.

(** The formula to refute, and the function that checks the steps.  The
    formula is made once for both. *)
Definition ask (r : reading) (Rs : list nested_rule) (Ks : list constraint) (q : question)
  : Formula.formula * (list Checker.step -> bool) :=
  let f := formula_of_question r Rs Ks q in (f, accepted f).

Theorem ask_sound r Rs Ks q steps :
  snd (ask r Rs Ks q) steps = true -> answered_no r Rs Ks q.
Proof.
  destruct q; cbn [ask snd formula_of_question answered_no]; intro C.
  - exact (certified_never_conflicts r Rs Ks steps C).
  - exact (certified_reads_alike Rs Ks steps C).
  - exact (certified_findings r Rs Ks findings steps C).
Qed.
