(** The checker accepts only refutations: [check_sound]. *)

From Coq Require Import List PArith Bool FMapPositive.
From Checker Require Import Formula Checker.
Import ListNotations.

(** An assignment agrees with what is known if it gives every variable there the same value. *)
Definition agrees (a : assignment) (p : partial) : Prop :=
  forall v b, Map.find v p = Some b -> a v = b.

Definition all_true (a : assignment) (known : clauses) : Prop :=
  forall number c, Map.find number known = Some c -> satisfies a c.

Lemma value_agrees : forall a p l b, agrees a p -> value p l = Some b -> true_in a l = b.
Proof.
  intros a p [v | v] b Ha; simpl.
  - apply Ha.
  - destruct (Map.find v p) as [x |] eqn:E; simpl; intro H; inversion H; subst.
    rewrite (Ha v x E). reflexivity.
Qed.

Lemma is_false_agrees : forall a p l, agrees a p -> is_false p l = true -> true_in a l = false.
Proof.
  unfold is_false. intros a p l Ha. destruct (value p l) as [[|] |] eqn:E; try discriminate.
  intros _. exact (value_agrees a p l false Ha E).
Qed.

Lemma make_true_agrees : forall a p l, agrees a p -> true_in a l = true -> agrees a (make_true p l).
Proof.
  intros a p l Ha Hl v b. destruct l as [w | w]; simpl in *; destruct (Pos.eq_dec v w) as [-> | Hne].
  - rewrite PositiveMap.gss. intro H; inversion H; subst. exact Hl.
  - rewrite PositiveMap.gso by exact Hne. apply Ha.
  - rewrite PositiveMap.gss. intro H; inversion H; subst. apply negb_true_iff. exact Hl.
  - rewrite PositiveMap.gso by exact Hne. apply Ha.
Qed.

Lemma all_false_broken : forall a p c,
  agrees a p -> forallb (is_false p) c = true -> ~ satisfies a c.
Proof.
  intros a p c Ha Hc [l [Hin Ht]]. rewrite forallb_forall in Hc.
  rewrite (is_false_agrees a p l Ha (Hc l Hin)) in Ht. discriminate.
Qed.

Lemma outcome_of_sound : forall a p c, agrees a p -> satisfies a c ->
  match outcome_of p c with
  | Broken => False
  | Unit l => true_in a l = true
  | Open => True
  end.
Proof.
  intros a p c Ha. induction c as [| l rest IH]; simpl; intros [x [Hin Ht]].
  - destruct Hin.
  - destruct (value p l) as [[|] |] eqn:E; try exact I.
    + apply IH. destruct Hin as [-> | Hin].
      * rewrite (value_agrees a p x false Ha E) in Ht. discriminate.
      * exists x. split; assumption.
    + destruct (forallb (is_false p) rest) eqn:F; try exact I.
      destruct Hin as [-> | Hin]; [exact Ht |].
      exfalso. apply (all_false_broken a p rest Ha F). exists x. split; assumption.
Qed.

Lemma no_conflict : forall a known, all_true a known ->
  forall hints p, agrees a p -> leads_to_conflict known p hints = true -> False.
Proof.
  intros a known Hk hints. induction hints as [| hint rest IH]; simpl; intros p Ha; [discriminate |].
  destruct (Map.find hint known) as [c |] eqn:E; [| discriminate].
  pose proof (outcome_of_sound a p c Ha (Hk hint c E)) as Ho.
  destruct (outcome_of p c) as [| l |]; [contradiction | | discriminate].
  apply IH. apply make_true_agrees; assumption.
Qed.

Lemma satisfies_decidable : forall a c, {satisfies a c} + {forall l, In l c -> true_in a l = false}.
Proof.
  intros a c. destruct (existsb (true_in a) c) eqn:E.
  - left. apply existsb_exists in E. exact E.
  - right. intros l Hin. destruct (true_in a l) eqn:T; [| reflexivity].
    assert (existsb (true_in a) c = true) by (apply existsb_exists; exists l; split; assumption).
    congruence.
Qed.

Lemma true_in_negate : forall a l, true_in a (negate l) = negb (true_in a l).
Proof. intros a [v | v]; simpl; [reflexivity | symmetry; apply negb_involutive]. Qed.

Lemma all_false_agrees : forall a c,
  (forall l, In l c -> true_in a l = false) -> agrees a (all_false c).
Proof.
  intros a c. unfold all_false.
  assert (Hempty : agrees a (Map.empty bool)).
  { intros v b. rewrite PositiveMap.gempty. discriminate. }
  revert Hempty. generalize (Map.empty bool) as p.
  induction c as [| l rest IH]; simpl; intros p Hp Hc; [exact Hp |].
  apply IH.
  - apply make_true_agrees; [exact Hp |]. rewrite true_in_negate, (Hc l (or_introl eq_refl)). reflexivity.
  - intros x Hin. apply Hc. right. exact Hin.
Qed.

(** What a step adds follows from the clauses that are known. *)
Lemma step_sound : forall a known c hints,
  all_true a known -> leads_to_conflict known (all_false c) hints = true -> satisfies a c.
Proof.
  intros a known c hints Hk Hc. destruct (satisfies_decidable a c) as [H | H]; [exact H |].
  exfalso. exact (no_conflict a known Hk hints _ (all_false_agrees a c H) Hc).
Qed.

Lemma add_all_true : forall a known number c,
  all_true a known -> satisfies a c -> all_true a (Map.add number c known).
Proof.
  intros a known number c Hk Hc n d. destruct (Pos.eq_dec n number) as [-> | Hne].
  - rewrite PositiveMap.gss. intro H; inversion H; subst. exact Hc.
  - rewrite PositiveMap.gso by exact Hne. apply Hk.
Qed.

Lemma forget_all_true : forall a numbers known, all_true a known -> all_true a (forget known numbers).
Proof.
  unfold forget. intros a numbers. induction numbers as [| number rest IH]; simpl; intros known Hk; [exact Hk |].
  apply IH. intros n c. destruct (Pos.eq_dec n number) as [-> | Hne].
  - rewrite PositiveMap.grs. discriminate.
  - rewrite PositiveMap.gro by exact Hne. apply Hk.
Qed.

Lemma run_sound : forall a steps known, all_true a known -> run known steps <> Verified.
Proof.
  intros a steps. induction steps as [| [number c hints | numbers] rest IH]; simpl; intros known Hk; [discriminate | |].
  - destruct (leads_to_conflict known (all_false c) hints) eqn:E; [| discriminate].
    pose proof (step_sound a known c hints Hk E) as Hc. destruct c as [| l c].
    + destruct Hc as [l [[] _]].
    + apply IH. apply add_all_true; assumption.
  - apply IH. apply forget_all_true. exact Hk.
Qed.

Lemma numbered_all_true : forall a f known next,
  model a f -> all_true a known -> all_true a (numbered known next f).
Proof.
  intros a f. induction f as [| c rest IH]; simpl; intros known next Hf Hk; [exact Hk |].
  apply IH.
  - intros d Hd. apply Hf. right. exact Hd.
  - apply add_all_true; [exact Hk |]. apply Hf. left. reflexivity.
Qed.

(** The checker accepts only if the clauses are unsatisfiable, for any steps. *)
Theorem check_sound : forall f steps, check f steps = Verified -> unsatisfiable f.
Proof.
  intros f steps H a Hf. apply (run_sound a steps (numbered (Map.empty clause) 1 f)); [| exact H].
  apply numbered_all_true; [exact Hf |].
  intros n c. rewrite PositiveMap.gempty. discriminate.
Qed.
