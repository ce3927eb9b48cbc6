(** From rules to a verdict, with no step between that is not proved: the clauses of
    the theory's conflict check, refuted by steps that the checker follows.

    The origin of the steps is not trusted.  [certified] runs inside Coq, where the
    theorems of [rulesets/] are proved by it, and is extracted. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import
  Model Evaluation Readings Nested Clauses Constraints Clashes Conflict ConflictClauses
  Question Checks.
From Checker Require Formula Checker Soundness.
Import ListNotations.

(** * Rules as texts have them, with chains inside chains *)

Definition flat (r : reading) (Rs : list nested_rule) : ruleset := flat_map (flatten r) Rs.

(** What all of them oblige, by the walk of the text. *)
Definition all_due (r : reading) (chi : context) (Rs : list nested_rule) : list literal :=
  flat_map (nested_due r chi) Rs.

(** In every context that can be, something can be done that keeps all that is due
    and all constraints. *)
Definition never_conflicts (r : reading) (Rs : list nested_rule) (Ks : list constraint) : Prop :=
  forall chi, possible Ks chi = true -> jointly_possible Ks chi (all_due r chi Rs).

Lemma flat_due r chi Rs l : In l (due r (flat r Rs) chi) <-> In l (all_due r chi Rs).
Proof.
  unfold due, flat, all_due. rewrite !in_flat_map. split.
  - intros [S [I H]]. apply in_flat_map in I. destruct I as [R [I J]].
    exists R. split; [exact I|]. apply flatten_due.
    unfold due. apply in_flat_map. eauto.
  - intros [R [I H]]. apply flatten_due in H. unfold due in H.
    apply in_flat_map in H. destruct H as [S [J H]].
    exists S. split; [apply in_flat_map; eauto|exact H].
Qed.

Theorem flat_conflict_free r Rs Ks :
  conflict_free r (flat r Rs) Ks -> never_conflicts r Rs Ks.
Proof.
  intros F chi P. destruct (F chi P) as [v [A [T K]]]. exists v.
  split; [exact A|]. split; [|exact K]. intros l I. apply T, flat_due, I.
Qed.

(** A default with a chain of its own is written as a first hedge under [true]. *)
Theorem default_as_hedge r chi c hs :
  chain_due r chi (Chain [] ((Truth true, c) :: hs)) =
  nth (decides r (map (fun h => satisfies chi (fst h)) hs))
      (chain_due r chi c :: map (fun h => chain_due r chi (snd h)) hs) [].
Proof.
  cbn [chain_due map fst snd]. change (satisfies chi (Truth true)) with true.
  destruct r; cbn [decides longest_prefix last_true].
  - reflexivity.
  - destruct (last_true _); reflexivity.
Qed.

(** * The formula, as the checker has it *)

Definition lit_for (l : lit) : Formula.literal :=
  if fst l then Formula.Pos (snd l) else Formula.Neg (snd l).

Definition formula_for (f : cnf) : Formula.formula := map (map lit_for) f.

Lemma lit_for_true a l : Formula.true_in a (lit_for l) = lit_true a l.
Proof. destruct l as [[|] x]; unfold lit_true; simpl; destruct (a x); reflexivity. Qed.

Lemma formula_for_unsatisfiable f :
  Formula.unsatisfiable (formula_for f) -> unsatisfiable f.
Proof.
  intros U a. apply not_true_is_false. intro T. apply (U a). intros c C.
  apply in_map_iff in C. destruct C as [d [<- D]].
  rewrite cnf_true_spec in T. specialize (T d D). apply clause_true_spec in T.
  destruct T as [l [L T]]. exists (lit_for l). split; [apply in_map, L|].
  rewrite lit_for_true. exact T.
Qed.

(** What is to be refuted. *)
Definition to_refute (r : reading) (Rs : list nested_rule) (Ks : list constraint)
  : Formula.formula := formula_for (dense (conflict_clauses r (flat r Rs) Ks)).

Definition accepted (f : Formula.formula) (steps : list Checker.step) : bool :=
  match Checker.check f steps with Checker.Verified => true | _ => false end.

Lemma accepted_unsatisfiable f steps :
  accepted (formula_for (dense f)) steps = true -> unsatisfiable f.
Proof.
  unfold accepted. intro C.
  apply dense_unsatisfiable, formula_for_unsatisfiable, (Soundness.check_sound _ steps).
  destruct (Checker.check _ steps); [reflexivity|discriminate|discriminate].
Qed.

Definition certified (r : reading) (Rs : list nested_rule) (Ks : list constraint)
    (steps : list Checker.step) : bool := accepted (to_refute r Rs Ks) steps.

(** If any steps are accepted, no context conflicts. *)
Theorem certified_never_conflicts r Rs Ks steps :
  certified r Rs Ks steps = true -> never_conflicts r Rs Ks.
Proof.
  intro C. apply flat_conflict_free, conflict_free_iff_unsatisfiable.
  exact (accepted_unsatisfiable _ steps C).
Qed.

(** * The reading *)

(** No rule depends on it, in any context that can be. *)
Definition reads_alike (Rs : list nested_rule) (Ks : list constraint) : Prop :=
  forall chi R, possible Ks chi = true -> In R Rs ->
  same_literals (nested_due Cascade chi R) (nested_due Priority chi R).

(** A rule without a chain in a chain is one flat rule in both readings. *)
Definition plain (R : nested_rule) : bool :=
  forallb (fun h => match inner (snd h) with [] => true | _ => false end) (inner (response R)).

Definition as_one (R : nested_rule) : rule :=
  Rule (nested_label R) (nested_trigger R) (nested_guard R) (obliges (response R))
       (map (fun h => Hedge (fst h) (own_part (snd h))) (inner (response R))).

Lemma flatten_plain r R : plain R = true -> flatten r R = [as_one R].
Proof.
  unfold plain, as_one, flatten. destruct (response R) as [ls hs]. cbn [inner obliges flatten_chain].
  intro P. f_equal.
  match goal with |- concat (?go _ _) = [] =>
    enough (E : forall rest i,
              forallb (fun h => match inner (snd h) with [] => true | _ => false end) rest = true ->
              concat (go i rest) = []) by exact (E hs _ P)
  end.
  induction rest as [|h rest IH]; intros i Q; [reflexivity|].
  cbn [forallb] in Q. apply andb_true_iff in Q. destruct Q as [H Q].
  cbn [concat]. destruct (inner (snd h)); [exact (IH (S i) Q)|discriminate H].
Qed.

(** Where the readings choose clauses that oblige different things: clause j, and one of
    those that end before it has begun.  If each of these obliges something else, it does
    not matter which it is. *)
Definition parting_at (R : rule) (j : nat) : list (formula fact) :=
  let others := filter (fun k => negb (same_literalsb (clause R k) (clause R j))) (seq 0 (j - 1)) in
  if length others =? j - 1
  then if 2 <=? j then [apart R j] else []
  else map (fun k => differ R k j) others.

Definition parting (R : rule) : list (formula fact) :=
  flat_map (parting_at R) (seq 0 (S (length (hedges R)))).

Lemma parting_none chi R :
  (forall f, In f (parting R) -> eval chi f = false) ->
  same_literals (due_of Cascade chi R) (due_of Priority chi R).
Proof.
  intro N. apply agree_here. intros k j L B.
  destruct (same_literalsb (clause R k) (clause R j)) eqn:E.
  - left. apply same_literalsb_spec, E.
  - right. assert (P : forall f, In f (parting_at R j) -> eval chi f = false).
    { intros f I. apply N. unfold parting. apply in_flat_map. exists j.
      split; [apply in_seq; lia|exact I]. }
    unfold parting_at in P. destruct (_ =? _).
    + apply not_true_is_false. intro D. apply apart_if_differ in D; [|exact L|exact B].
      rewrite P in D; [discriminate|].
      destruct (Nat.leb_spec 2 j); [left; reflexivity|lia].
    + apply P, in_map_iff. exists k. split; [reflexivity|].
      apply filter_In. rewrite E. split; [apply in_seq; lia|reflexivity].
Qed.

(** "The rule obliges something else under the other reading": one of these is true.
    The second way would do for all rules, and is many times as long. *)
Definition parts (R : nested_rule) : list (formula fact) :=
  if plain R then parting (as_one R)
  else [difference Cascade (flatten Cascade R) Priority (flatten Priority R)].

Lemma parts_none chi R :
  (forall f, In f (parts R) -> eval chi f = false) ->
  same_literals (nested_due Cascade chi R) (nested_due Priority chi R).
Proof.
  unfold parts. intros N l. rewrite <- !flatten_due. destruct (plain R) eqn:P.
  - rewrite !flatten_plain by exact P. unfold due. cbn [flat_map]. rewrite !app_nil_r.
    apply parting_none, N.
  - specialize (N _ (or_introl eq_refl)). apply difference_spec in N. apply N.
Qed.

Definition reading_to_refute (Rs : list nested_rule) (Ks : list constraint) : Formula.formula :=
  formula_for (dense (questions_clauses Ks (flat_map parts Rs))).

Definition certified_reading (Rs : list nested_rule) (Ks : list constraint)
    (steps : list Checker.step) : bool := accepted (reading_to_refute Rs Ks) steps.

Theorem certified_reads_alike Rs Ks steps :
  certified_reading Rs Ks steps = true -> reads_alike Rs Ks.
Proof.
  intros C chi R P I. apply accepted_unsatisfiable in C.
  rewrite questions_answered_no in C. apply parts_none. intros f F.
  apply (C chi f P), in_flat_map. eauto.
Qed.
