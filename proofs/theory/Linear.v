(** Equation 1 written linearly ([sleec_verify/encoding/cnf.py]; issue 5, theorem 3, second
    half): a variable for each prefix of a chain and, by priority, one for each
    suffix. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings.
Import ListNotations.

(** The original names, and the new ones of the rule at a place in the ruleset. *)
Inductive variable :=
| Named (a : atom)
| Prefix (place i : nat)
| Suffix (place i : nat).

Definition equal {A} (f g : formula A) : formula A := Or (And f g) (And (Not f) (Not g)).

Lemma eval_equal {A} (v : A -> bool) f g :
  eval v (equal f g) = true <-> eval v f = eval v g.
Proof. simpl. destruct (eval v f), (eval v g); simpl; intuition. Qed.

Definition named (f : formula fact) : formula variable := rename (fun a => Named (Fact a)) f.

Section Rule.

Variable place : nat.

(** Suffix i ↔ Ci ∨ Suffix (i+1), counted from [i] on. *)
Fixpoint suffix_definitions (i : nat) (cs : list (formula variable)) : list (formula variable) :=
  match cs with
  | [] => [equal (Atom (Suffix place i)) (Truth false)]
  | c :: rest =>
      equal (Atom (Suffix place i)) (Or c (Atom (Suffix place (S i))))
      :: suffix_definitions (S i) rest
  end.

(** Prefix (i+1) ↔ Prefix i ∧ C(i+1) *)
Fixpoint prefix_definitions (i : nat) (cs : list (formula variable)) : list (formula variable) :=
  match cs with
  | [] => []
  | c :: rest =>
      equal (Atom (Prefix place (S i))) (And (Atom (Prefix place i)) c)
      :: prefix_definitions (S i) rest
  end.

(** Prefix i ∧ ¬Prefix (i+1) → Oi, without the last part for the last clause. *)
Definition linear_guard (n i : nat) : formula variable :=
  if i =? n then Atom (Prefix place i)
  else And (Atom (Prefix place i)) (Not (Atom (Prefix place (S i)))).

Definition linear_implication (R : rule) (i : nat) : formula variable :=
  implies (linear_guard (length (hedges R)) i) (rename Named (obliged R i)).

(** The conditions of the cascade that the chain is: its own, or its suffixes. *)
Definition chain (r : reading) (R : rule) : list (formula variable) :=
  match r with
  | Cascade => map named (conditions R)
  | Priority => map (fun i => Atom (Suffix place i)) (seq 1 (length (hedges R)))
  end.

Definition linear (r : reading) (R : rule) : list (formula variable) :=
  match r with Cascade => [] | Priority => suffix_definitions 1 (map named (conditions R)) end
  ++ equal (Atom (Prefix place 0)) (named (c0 R))
  :: prefix_definitions 0 (chain r R)
  ++ map (linear_implication R) (clause_numbers R).

(** ** What the definitions say *)

Definition all_true (v : variable -> bool) (fs : list (formula variable)) : Prop :=
  forall f, In f fs -> eval v f = true.

Lemma all_true_cons v f fs : all_true v (f :: fs) <-> eval v f = true /\ all_true v fs.
Proof. unfold all_true. simpl. split; [auto|]. intros [A B] g [<-|I]; auto. Qed.

Lemma all_true_app v fs gs : all_true v (fs ++ gs) <-> all_true v fs /\ all_true v gs.
Proof.
  unfold all_true. setoid_rewrite in_app_iff.
  split; [auto|]. intros [A B] g [I|I]; auto.
Qed.

Lemma suffix_definitions_spec v i cs :
  all_true v (suffix_definitions i cs) <->
  forall j, j <= length cs -> v (Suffix place (i + j)) = existsb (eval v) (skipn j cs).
Proof.
  revert i. induction cs as [|c cs IH]; intro i.
  - cbn [suffix_definitions]. rewrite all_true_cons, eval_equal. split.
    + intros [E _] j J. simpl in J. replace j with 0 by lia. rewrite Nat.add_0_r. exact E.
    + intro H. split; [specialize (H 0 (le_n _)); rewrite Nat.add_0_r in H; exact H|intros f []].
  - cbn [suffix_definitions]. rewrite all_true_cons, eval_equal, IH.
    cbn [eval length]. split.
    + intros [E D] [|j] J.
      * rewrite Nat.add_0_r. simpl. rewrite E. f_equal.
        specialize (D 0). rewrite Nat.add_0_r in D. apply D. lia.
      * rewrite Nat.add_succ_r. apply D. lia.
    + intro H. split.
      * pose proof (H 0 ltac:(lia)) as X. pose proof (H 1 ltac:(lia)) as Y.
        rewrite Nat.add_0_r in X. rewrite Nat.add_1_r in Y. simpl in X, Y. congruence.
      * intros j J. specialize (H (S j) ltac:(lia)). rewrite Nat.add_succ_r in H. exact H.
Qed.

Lemma prefix_definitions_spec v i cs :
  all_true v (prefix_definitions i cs) <->
  forall j, j <= length cs ->
    v (Prefix place (i + j)) = v (Prefix place i) && forallb (eval v) (firstn j cs).
Proof.
  revert i. induction cs as [|c cs IH]; intro i.
  - split; [|intros _ f []]. intros _ j J. simpl in J. replace j with 0 by lia.
    rewrite Nat.add_0_r, andb_true_r. reflexivity.
  - cbn [prefix_definitions]. rewrite all_true_cons, eval_equal, IH. cbn [eval length]. split.
    + intros [E D] [|j] J.
      * rewrite Nat.add_0_r, andb_true_r. reflexivity.
      * rewrite Nat.add_succ_r. change (S (i + j)) with (S i + j).
        rewrite D by lia. rewrite E. simpl. rewrite andb_assoc. reflexivity.
    + intro H. split.
      * specialize (H 1 ltac:(lia)). rewrite Nat.add_1_r in H. rewrite H. simpl.
        rewrite andb_true_r. reflexivity.
      * intros j J. pose proof (H (S j) ltac:(lia)) as X. pose proof (H 1 ltac:(lia)) as Y.
        rewrite Nat.add_succ_r in X. rewrite Nat.add_1_r in Y.
        change (S i + j) with (S (i + j)). rewrite X, Y. simpl.
        rewrite andb_true_r, andb_assoc. reflexivity.
Qed.

(** ** A rule's linear guards are its guards *)

Definition context_of (v : variable -> bool) : context := fun f => v (Named (Fact f)).

Lemma eval_named v f : eval v (named f) = eval (context_of v) f.
Proof. unfold named. rewrite eval_rename. reflexivity. Qed.

Lemma eval_named_conditions v R :
  map (eval v) (map named (conditions R)) = truths (context_of v) R.
Proof.
  rewrite map_map, <- eval_conditions. apply map_ext. intro. apply eval_named.
Qed.

(** The truths of the cascade that the chain is. *)
Definition cascade_truths (r : reading) (chi : context) (R : rule) : list bool :=
  match r with Cascade => truths chi R | Priority => suffixes_true (truths chi R) end.

Lemma cascade_truths_active r chi R :
  longest_prefix (cascade_truths r chi R) = active r chi R.
Proof. destruct r; [reflexivity|]. apply cascade_of_suffixes. Qed.

Lemma suffixes_true_nth bs : map (fun j => existsb id (skipn j bs)) (seq 0 (length bs))
                             = suffixes_true bs.
Proof.
  induction bs as [|b bs IH]; [reflexivity|].
  cbn [length seq map suffixes_true skipn]. f_equal.
  rewrite <- seq_shift, map_map. exact IH.
Qed.

Lemma chain_length r R : length (chain r R) = length (hedges R).
Proof.
  destruct r; simpl; rewrite ?map_length, ?seq_length; [|reflexivity].
  unfold conditions. rewrite map_length. reflexivity.
Qed.

Definition suffixes_right (r : reading) (v : variable -> bool) (R : rule) : Prop :=
  all_true v match r with
             | Cascade => []
             | Priority => suffix_definitions 1 (map named (conditions R))
             end.

Lemma chain_truths r v R :
  suffixes_right r v R ->
  map (eval v) (chain r R) = cascade_truths r (context_of v) R.
Proof.
  destruct r; intro H; cbn [chain cascade_truths].
  - apply eval_named_conditions.
  - unfold suffixes_right in H. rewrite suffix_definitions_spec in H.
    assert (L : length (map named (conditions R)) = length (hedges R)).
    { rewrite map_length. unfold conditions. apply map_length. }
    rewrite <- suffixes_true_nth.
    replace (length (truths (context_of v) R)) with (length (hedges R))
      by (symmetry; apply map_length).
    rewrite map_map, <- seq_shift, map_map. apply map_ext_in.
    intros j J. apply in_seq in J. cbn [eval]. change (S j) with (1 + j).
    rewrite (H j) by lia. rewrite <- eval_named_conditions.
    generalize (map named (conditions R)). intro m.
    rewrite skipn_map, existsb_map. reflexivity.
Qed.

Lemma linear_guard_spec r v R i :
  suffixes_right r v R ->
  v (Prefix place 0) = triggered (context_of v) R ->
  all_true v (prefix_definitions 0 (chain r R)) ->
  i <= length (hedges R) ->
  eval v (linear_guard (length (hedges R)) i)
  = triggered (context_of v) R && (active r (context_of v) R =? i).
Proof.
  intros SR T P I. rewrite prefix_definitions_spec, chain_length in P.
  rewrite T in P. cbn [Nat.add] in P.
  rewrite <- cascade_truths_active, <- (chain_truths r v R SR).
  set (bs := map (eval v) (chain r R)).
  assert (L : length bs = length (hedges R)).
  { unfold bs. rewrite map_length. apply chain_length. }
  assert (Q : forall j, j <= length (hedges R) ->
              v (Prefix place j) = triggered (context_of v) R && forallb id (firstn j bs)).
  { intros j J. rewrite (P j J). unfold bs. rewrite firstn_map, forallb_map. reflexivity. }
  rewrite <- cascade_guard by lia. unfold linear_guard.
  destruct (Nat.eqb_spec i (length (hedges R))) as [E|N]; cbn [eval].
  - rewrite (Q i I). rewrite skipn_all2 by lia. simpl. rewrite andb_true_r. reflexivity.
  - rewrite (Q i I), (Q (S i)), firstn_succ, forallb_app by lia.
    replace (forallb negb (firstn 1 (skipn i bs)))
      with (negb (forallb id (firstn 1 (skipn i bs)))).
    + destruct (triggered _ R), (forallb id (firstn i bs)), (forallb id (firstn 1 _)); reflexivity.
    + destruct (skipn i bs) as [|b rest] eqn:K.
      * apply (f_equal (@length bool)) in K. rewrite skipn_length in K. simpl in K. lia.
      * simpl. rewrite !andb_true_r. reflexivity.
Qed.

(** ** One rule *)

Lemma linear_split r v R :
  all_true v (linear r R) <->
  suffixes_right r v R /\
  v (Prefix place 0) = triggered (context_of v) R /\
  all_true v (prefix_definitions 0 (chain r R)) /\
  all_true v (map (linear_implication R) (clause_numbers R)).
Proof.
  unfold linear. rewrite all_true_app, all_true_cons, all_true_app, eval_equal, eval_named, eval_c0.
  reflexivity.
Qed.

(** Where the definitions hold, the linear equation says what the quadratic one does. *)
Lemma linear_rule r v R :
  all_true v (linear r R) <->
  suffixes_right r v R /\
  v (Prefix place 0) = triggered (context_of v) R /\
  all_true v (prefix_definitions 0 (chain r R)) /\
  eval (fun a => v (Named a)) (equation r R) = true.
Proof.
  rewrite linear_split.
  enough (E : suffixes_right r v R -> v (Prefix place 0) = triggered (context_of v) R ->
              all_true v (prefix_definitions 0 (chain r R)) ->
              (all_true v (map (linear_implication R) (clause_numbers R)) <->
               eval (fun a => v (Named a)) (equation r R) = true)) by tauto.
  intros S T P. unfold equation. rewrite eval_conj, forallb_map, forallb_forall.
  assert (I : forall i, In i (clause_numbers R) ->
              eval v (linear_implication R i)
              = eval (fun a => v (Named a)) (implication r R i)).
  { intros i I. apply in_clause_numbers in I. unfold linear_implication, implication, implies.
    cbn [eval]. rewrite !eval_rename, (linear_guard_spec r v R i S T P I).
    rewrite <- guard_iff_active by exact I. reflexivity. }
  split.
  - intros H i K. rewrite <- I by exact K. apply H, in_map, K.
  - intros H f F. apply in_map_iff in F. destruct F as [i [<- K]]. rewrite I by exact K. auto.
Qed.

End Rule.

(** * All rules *)

Fixpoint linear_from (r : reading) (place : nat) (G : ruleset) : list (formula variable) :=
  match G with
  | [] => []
  | R :: rest => linear place r R ++ linear_from r (S place) rest
  end.

Definition linear_equations (r : reading) (G : ruleset) : list (formula variable) :=
  linear_from r 0 G.

Lemma in_linear_from v r G k :
  all_true v (linear_from r k G) <->
  forall i R, nth_error G i = Some R -> all_true v (linear (k + i) r R).
Proof.
  revert k. induction G as [|R G IH]; intro k; cbn [linear_from].
  - split; [intros _ [|i] R E; discriminate|intros _ f []].
  - rewrite all_true_app, IH. split.
    + intros [A B] [|i] Q E.
      * injection E as <-. rewrite Nat.add_0_r. exact A.
      * rewrite Nat.add_succ_r. exact (B i Q E).
    + intro H. split.
      * specialize (H 0 R eq_refl). rewrite Nat.add_0_r in H. exact H.
      * intros i Q E. specialize (H (S i) Q E). rewrite Nat.add_succ_r in H. exact H.
Qed.

(** The values that the new names must have. *)
Definition extension (r : reading) (G : ruleset) (v : atom -> bool) (x : variable) : bool :=
  match x with
  | Named a => v a
  | Prefix k i =>
      match nth_error G k with
      | Some R => triggered (context_in v) R
                  && forallb id (firstn i (cascade_truths r (context_in v) R))
      | None => false
      end
  | Suffix k i =>
      match nth_error G k with
      | Some R => existsb id (skipn (i - 1) (truths (context_in v) R))
      | None => false
      end
  end.

Lemma extension_rule r G v k R :
  nth_error G k = Some R -> eval v (equation r R) = true ->
  all_true (extension r G v) (linear k r R).
Proof.
  intros N E. set (w := extension r G v).
  assert (S : suffixes_right k r w R).
  { unfold suffixes_right. destruct r; [intros f []|].
    apply suffix_definitions_spec. intros j J. unfold w, extension. rewrite N.
    replace (1 + j - 1) with j by lia.
    change (truths (context_in v) R) with (truths (context_of w) R).
    rewrite <- eval_named_conditions. generalize (map named (conditions R)). intro m.
    rewrite skipn_map, existsb_map. reflexivity. }
  apply linear_rule. split; [exact S|]. split; [|split].
  - unfold w, extension. rewrite N. simpl. rewrite andb_true_r. reflexivity.
  - apply prefix_definitions_spec. rewrite chain_length. intros j J.
    cbn [Nat.add]. unfold w at 1 2, extension. rewrite N. simpl firstn at 2.
    rewrite andb_true_r. f_equal.
    change (context_in v) with (context_of w). rewrite <- (chain_truths k r w R S).
    rewrite firstn_map, forallb_map. reflexivity.
  - exact E.
Qed.

(** ** Issue 5, theorem 3, second half *)

(** An interpretation of the original names models the quadratic equations exactly
    when it can be extended to one of the linear equations. *)
Theorem linear_conservative r G v :
  models r G v <->
  exists w, (forall a, w (Named a) = v a) /\ all_true w (linear_equations r G).
Proof.
  split.
  - intro M. exists (extension r G v). split; [reflexivity|].
    apply in_linear_from. intros i R E. apply extension_rule; [exact E|].
    apply M. apply nth_error_In in E. exact E.
  - intros [w [A L]] R I. apply In_nth_error in I. destruct I as [i E].
    unfold linear_equations in L. rewrite in_linear_from in L.
    apply (L i R) in E. apply linear_rule in E. destruct E as [_ [_ [_ E]]].
    rewrite <- E. apply eval_ext. intro a. symmetry. apply A.
Qed.

Theorem linear_equisatisfiable r G :
  (exists v, models r G v) <-> exists w, all_true w (linear_equations r G).
Proof.
  split.
  - intros [v M]. apply linear_conservative in M. destruct M as [w [_ L]]. eauto.
  - intros [w L]. exists (fun a => w (Named a)). apply linear_conservative. eauto.
Qed.

(** Both entail the same over the original names, in every context. *)
Theorem linear_entails r G chi phi :
  entails r G chi phi <->
  forall w, (forall f, w (Named (Fact f)) = chi f) -> all_true w (linear_equations r G) ->
            eval w (rename Named phi) = true.
Proof.
  split.
  - intros E w A L. rewrite eval_rename. apply E; [exact A|].
    apply linear_conservative. exists w. auto.
  - intros E v A M. apply linear_conservative in M. destruct M as [w [S L]].
    rewrite <- (eval_ext (fun a => w (Named a)) v) by exact S.
    rewrite <- eval_rename. apply E; [|exact L]. intro f. rewrite S. apply A.
Qed.

(** * Sizes *)

Fixpoint size {A} (f : formula A) : nat :=
  match f with
  | Truth _ | Atom _ => 1
  | Not g => S (size g)
  | And g h | Or g h => S (size g + size h)
  end.

Definition total {A} (fs : list (formula A)) : nat := list_sum (map size fs).

Definition hedge_size (h : hedge) : nat :=
  1 + size (hedge_condition h) + length (hedge_obliges h).

Definition rule_size (R : rule) : nat :=
  1 + size (rule_guard R) + length (default R) + list_sum (map hedge_size (hedges R)).

Lemma size_rename {A B} (h : A -> B) f : size (rename h f) = size f.
Proof. induction f; simpl; congruence. Qed.

Lemma total_app {A} (fs gs : list (formula A)) : total (fs ++ gs) = total fs + total gs.
Proof. unfold total. rewrite map_app, list_sum_app. reflexivity. Qed.

Lemma total_cons {A} (f : formula A) fs : total (f :: fs) = size f + total fs.
Proof. reflexivity. Qed.

Lemma suffix_definitions_size k i cs :
  total (suffix_definitions k i cs) = 9 + 11 * length cs + 2 * total cs.
Proof.
  revert i. induction cs as [|c cs IH]; intro i; [reflexivity|].
  cbn [suffix_definitions length]. rewrite !total_cons, IH.
  unfold equal. cbn [size]. lia.
Qed.

Lemma prefix_definitions_size k i cs :
  total (prefix_definitions k i cs) = 11 * length cs + 2 * total cs.
Proof.
  revert i. induction cs as [|c cs IH]; intro i; [reflexivity|].
  cbn [prefix_definitions length]. rewrite !total_cons, IH.
  unfold equal. cbn [size]. lia.
Qed.

Lemma conditions_size R :
  total (map named (conditions R)) + length (hedges R) <= list_sum (map hedge_size (hedges R)).
Proof.
  unfold conditions. induction (hedges R) as [|h hs IH]; [reflexivity|].
  cbn [map length]. rewrite total_cons. unfold named at 1.
  rewrite !size_rename. cbn [list_sum fold_right] in *. unfold list_sum in *. cbn [fold_right].
  unfold hedge_size at 1. lia.
Qed.

Lemma obliged_size ls : size (conj (map formula_of ls)) <= 1 + 3 * length ls.
Proof. induction ls as [|[o|o] ls IH]; cbn [map conj size formula_of length]; lia. Qed.

Lemma implications_size k R :
  total (map (linear_implication k R) (clause_numbers R))
  <= 7 * S (length (hedges R)) + 3 * list_sum (map (@length literal) (clauses R)).
Proof.
  assert (G : forall n i, total (map (linear_implication k R) (seq i n))
              <= 7 * n + 3 * list_sum (map (@length literal) (firstn n (skipn i (clauses R))))).
  { induction n as [|n IH]; intro i; [apply Nat.le_0_l|].
    cbn [seq map]. rewrite total_cons. specialize (IH (S i)).
    assert (L : size (linear_implication k R i) <= 7 + 3 * length (clause R i)).
    { unfold linear_implication, implies, linear_guard, obliged. cbn [size].
      rewrite size_rename. pose proof (obliged_size (clause R i)).
      destruct (i =? length (hedges R)); cbn [size]; lia. }
    assert (F : firstn (S n) (skipn i (clauses R)) = firstn 1 (skipn i (clauses R))
                ++ firstn n (skipn (S i) (clauses R))).
    { clear. revert i. induction (clauses R) as [|c cs IH]; intros [|i];
        cbn [skipn]; rewrite ?firstn_nil; try reflexivity. apply IH. }
    assert (C : length (clause R i) <= list_sum (map (@length literal) (firstn 1 (skipn i (clauses R))))).
    { unfold clause. clear. revert i. induction (clauses R) as [|c cs IH]; intros [|i]; simpl.
      - lia.
      - lia.
      - rewrite Nat.add_0_r. lia.
      - apply IH. }
    rewrite F, map_app, list_sum_app. lia. }
  specialize (G (S (length (hedges R))) 0). unfold clause_numbers.
  rewrite <- (clauses_length R) in G at 3. cbn [skipn] in G. rewrite firstn_all in G. exact G.
Qed.

(** The linear equation is linear in the size of the rule. *)
Theorem linear_size k r R : total (linear k r R) <= 31 * rule_size R.
Proof.
  unfold linear. rewrite total_app, total_cons, total_app.
  pose proof (implications_size k R) as I. pose proof (conditions_size R) as C.
  assert (O : list_sum (map (@length literal) (clauses R)) + length (hedges R)
              <= length (default R) + list_sum (map hedge_size (hedges R))).
  { unfold clauses. cbn [map]. clear. unfold list_sum. cbn [fold_right].
    induction (hedges R) as [|h hs IH]; cbn [map fold_right length]; [lia|].
    unfold hedge_size at 1. lia. }
  assert (D : size (equal (Atom (Prefix k 0)) (named (c0 R))) = 11 + 2 * size (rule_guard R)).
  { unfold equal, named, c0. cbn [size rename]. rewrite !size_rename. lia. }
  rewrite D, prefix_definitions_size, chain_length.
  assert (L : length (map named (conditions R)) = length (hedges R)).
  { unfold conditions. rewrite !map_length. reflexivity. }
  assert (M : list_sum (map (@length literal) (clauses R)) + length (hedges R)
             + total (map named (conditions R)) <= length (default R)
                                       + list_sum (map hedge_size (hedges R))).
  { unfold clauses, conditions. cbn [map]. clear. unfold list_sum, total. cbn [fold_right].
    induction (hedges R) as [|h hs IH]; cbn [map fold_right length]; [cbn; lia|].
    unfold hedge_size at 1, named at 1. rewrite !size_rename.
    cbn [list_sum fold_right] in *. unfold list_sum in *. cbn [fold_right] in *. lia. }
  destruct r; cbn [chain].
  - unfold total at 1. cbn [map list_sum fold_right]. unfold rule_size. lia.
  - rewrite suffix_definitions_size, L.
    assert (A : forall l, total (map (fun i => Atom (Suffix k i)) l) = length l).
    { induction l; cbn [map length]; rewrite ?total_cons; cbn [size]; [reflexivity|lia]. }
    rewrite A, seq_length. unfold rule_size. lia.
Qed.

(** The one that is printed is quadratic in the number of hedges. *)
Theorem equation_size R :
  let n := length (hedges R) in n * (n + 1) <= 2 * size (equation Cascade R).
Proof.
  intro n. unfold equation.
  assert (C : forall A (fs : list (formula A)), length fs <= size (conj fs)).
  { intros A fs. induction fs as [|f fs IH]; simpl; lia. }
  assert (T : forall A (fs : list (formula A)), total fs <= size (conj fs)).
  { intros A fs. induction fs as [|f fs IH]; [apply Nat.le_0_l|].
    rewrite total_cons. simpl. lia. }
  eapply Nat.le_trans; [|apply Nat.mul_le_mono_l, T].
  assert (G : forall i, i <= n -> i <= size (implication Cascade R i)).
  { intros i I. unfold implication, implies. cbn [size]. rewrite size_rename.
    unfold guard. pose proof (C _ (conjuncts Cascade (c0 R) (conditions R) i)) as L.
    assert (N : length (conditions R) = n) by apply map_length.
    cbn [conjuncts length] in *. rewrite app_length, firstn_length, N in L. lia. }
  assert (S : forall m, m <= S n ->
              m * m <= 2 * total (map (implication Cascade R) (seq 0 m)) + m).
  { induction m as [|m IH]; intro M; [lia|].
    rewrite seq_S, map_app, total_app. cbn [map Nat.add]. rewrite total_cons.
    change (total []) with 0. specialize (IH ltac:(lia)). specialize (G m ltac:(lia)). nia. }
  specialize (S (Datatypes.S n) (le_n _)). unfold clause_numbers. fold n. nia.
Qed.
