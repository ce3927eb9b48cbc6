(** Formulas as clauses, by a variable for each gate ([sleec_verify/encoding/cnf.py]).

    Each step states what its literal is worth, that the clauses it adds can always be
    satisfied, and that unit propagation finds the value where the inputs are known. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Clauses.
Import ListNotations.

(** * Variables *)

(** Atoms have even numbers, gates odd ones, and 1 is true. *)
Definition number (a : atom) : positive :=
  match a with
  | Fact (Occurs t) => t~0~0~0
  | Fact (Holds c) => c~1~0~0
  | Done o => o~1~0
  end.

Definition atom_of (x : positive) : option atom :=
  match x with
  | (t~0~0~0)%positive => Some (Fact (Occurs t))
  | (c~1~0~0)%positive => Some (Fact (Holds c))
  | (o~1~0)%positive => Some (Done o)
  | _ => None
  end.

Lemma atom_of_number a : atom_of (number a) = Some a.
Proof. destruct a as [[t|c]|o]; reflexivity. Qed.

(** What an assignment of clauses says of atoms, and a context as an assignment. *)
Definition atoms_in (a : positive -> bool) : atom -> bool := fun x => a (number x).
Definition facts_in (a : positive -> bool) : context := fun f => a (number (Fact f)).

Definition assignment_of (v : atom -> bool) (x : positive) : bool :=
  match atom_of x with
  | Some a => v a
  | None => match x with xH => true | _ => false end
  end.

(** * Gates *)

Record state := State { next : positive; built : cnf }.

Definition start : state := State 1 [[(true, 1%positive)]].

Definition constant (b : bool) : lit := (b, 1%positive).

Definition gate (l m : lit) (s : state) : lit * state :=
  let g := (next s)~1%positive in
  ((true, g),
   State (Pos.succ (next s))
         ([(false, g); l] :: [(false, g); m] :: [(true, g); negate l; negate m] :: built s)).

(** The value of a constant, if the literal is one. *)
Definition constant_of (l : lit) : option bool :=
  match l with
  | (b, xH) => Some b
  | _ => None
  end.

(** A gate, but where one of the two is a constant: there it is worth no more than one of
    them. *)
Definition both (l m : lit) (s : state) : lit * state :=
  match constant_of l, constant_of m with
  | Some true, _ | _, Some false => (m, s)
  | Some false, _ | _, Some true => (l, s)
  | None, None => gate l m s
  end.

Definition either (l m : lit) (s : state) : lit * state :=
  let (g, s') := both (negate l) (negate m) s in (negate g, s').

(** Which variables a state may contain: atoms, 1, and the gates made so far. *)
Definition older (s : state) (x : positive) : Prop :=
  match x with (g~1)%positive => (g < next s)%positive | _ => True end.

Definition sound (s : state) : Prop :=
  In [constant true] (built s) /\
  forall c l, In c (built s) -> In l c -> older s (snd l).

Lemma start_sound : sound start.
Proof.
  split; [left; reflexivity|].
  intros c l [<-|[]] [<-|[]]. exact I.
Qed.

(** [s'] has what [s] has, and adds only what can always be satisfied. *)
Definition extends (s s' : state) : Prop :=
  (next s <= next s')%positive /\ incl (built s) (built s') /\ (sound s -> sound s') /\
  (sound s -> forall a, cnf_true a (built s) = true ->
     exists b, (forall x, older s x -> b x = a x) /\ cnf_true b (built s') = true).

Lemma older_mono s s' x : (next s <= next s')%positive -> older s x -> older s' x.
Proof. destruct x; simpl; auto. intros. lia. Qed.

Lemma extends_refl s : extends s s.
Proof.
  split; [lia|]. split; [apply incl_refl|]. split; [auto|]. intros _ a A. exists a. auto.
Qed.

Lemma extends_trans s t u : extends s t -> extends t u -> extends s u.
Proof.
  intros [N [I [W E]]] [N' [I' [W' E']]]. split; [lia|]. split; [eapply incl_tran; eauto|].
  split; [auto|]. intros S a A. destruct (E S a A) as [b [B TB]].
  destruct (E' (W S) b TB) as [c [C TC]]. exists c. split; [|exact TC].
  intros x O. rewrite C by (eapply older_mono; eauto). auto.
Qed.

(** Where the inputs are known, unit propagation makes a literal known: it derives
    the literal or its negation, as [a] has it. *)
Definition known (f : cnf) (a : positive -> bool) (l : lit) : Prop :=
  derives f (if lit_true a l then l else negate l).

Lemma known_negate f a l : known f a l -> known f a (negate l).
Proof.
  unfold known. rewrite lit_true_negate, negate_involutive.
  destruct (lit_true a l); auto.
Qed.

(** [value a] is what the literal is worth; [needs] are the atoms that decide it. *)
Definition gives (s : state) (out : lit * state) (value : (positive -> bool) -> bool)
    (needs : list positive) : Prop :=
  let (l, s') := out in
  sound s ->
  extends s s' /\
  older s' (snd l) /\
  (forall a, cnf_true a (built s') = true -> lit_true a l = value a) /\
  (forall f a, incl (built s') f -> cnf_true a (built s') = true ->
     (forall x, In x needs -> known f a (true, x)) -> known f a l).

(** A list of literals in place of one. *)
Definition gives_all (s : state) (out : list lit * state)
    (values : (positive -> bool) -> list bool) (needs : list positive) : Prop :=
  let (ls, s') := out in
  sound s ->
  extends s s' /\
  (forall l, In l ls -> older s' (snd l)) /\
  (forall a, cnf_true a (built s') = true -> map (lit_true a) ls = values a) /\
  (forall f a, incl (built s') f -> cnf_true a (built s') = true ->
     (forall x, In x needs -> known f a (true, x)) ->
     forall l, In l ls -> known f a l).

(** ** A gate *)

Lemma gate_extends l m s :
  older s (snd l) -> older s (snd m) -> extends s (snd (gate l m s)).
Proof.
  intros Ol Om. set (g := (next s)~1%positive). split; [|split; [|split]].
  - simpl. lia.
  - intros c C. simpl. auto.
  - intros [T S]. split; [simpl; auto|].
    assert (U : forall x, older s x -> older (snd (gate l m s)) x).
    { intro x. apply older_mono. simpl. lia. }
    intros c k C K. simpl in C.
    destruct C as [<-|[<-|[<-|C]]]; [| | |apply U; eapply S; eauto];
      simpl in K; repeat destruct K as [<-|K]; try destruct K; simpl;
      try lia; apply U; assumption.
  - intros S a A.
    set (b := fun x => if Pos.eqb x g then lit_true a l && lit_true a m else a x).
    assert (U : forall x, older s x -> b x = a x).
    { intros x X. unfold b. destruct (Pos.eqb_spec x g) as [->|]; [|reflexivity].
      simpl in X. lia. }
    assert (L : forall k, older s (snd k) -> lit_true b k = lit_true a k).
    { intros k K. apply lit_true_ext, U, K. }
    assert (G : b g = lit_true a l && lit_true a m).
    { unfold b. rewrite Pos.eqb_refl. reflexivity. }
    exists b. split; [exact U|].
    apply cnf_true_spec. intros c C. simpl in C.
    destruct C as [<-|[<-|[<-|C]]].
    + change (clause_true b [(false, g); l] = true). unfold clause_true. cbn [existsb].
      rewrite (L l Ol), lit_true_pair, G. destruct (lit_true a l), (lit_true a m); reflexivity.
    + change (clause_true b [(false, g); m] = true). unfold clause_true. cbn [existsb].
      rewrite (L m Om), lit_true_pair, G. destruct (lit_true a l), (lit_true a m); reflexivity.
    + change (clause_true b [(true, g); negate l; negate m] = true).
      unfold clause_true. cbn [existsb].
      rewrite !lit_true_negate, (L l Ol), (L m Om), lit_true_pair, G.
      destruct (lit_true a l), (lit_true a m); reflexivity.
    + rewrite cnf_true_spec in A. specialize (A c C).
      apply clause_true_spec in A. destruct A as [k [K T]].
      apply clause_true_spec. exists k. split; [exact K|].
      rewrite L; [exact T|]. destruct S as [_ S]. eapply S; eauto.
Qed.

Lemma gate_value l m s a :
  cnf_true a (built (snd (gate l m s))) = true ->
  lit_true a (fst (gate l m s)) = lit_true a l && lit_true a m.
Proof.
  unfold gate. cbn [fst snd built]. unfold cnf_true, clause_true. cbn [forallb existsb].
  rewrite !lit_true_negate, !lit_true_pair.
  destruct (a (next s)~1%positive), (lit_true a l), (lit_true a m); simpl; congruence.
Qed.

Lemma gate_known l m s f a :
  incl (built (snd (gate l m s))) f -> cnf_true a (built (snd (gate l m s))) = true ->
  known f a l -> known f a m -> known f a (fst (gate l m s)).
Proof.
  intros I A L M. unfold known. rewrite gate_value by exact A. unfold known in L, M.
  set (g := (next s)~1%positive).
  assert (N : forall k, In [(false, g); k] f -> derives f (negate k) -> derives f (false, g)).
  { intros k K D. apply (unit_clause f _ _ K); [left; reflexivity|].
    intros q [<-|[<-|[]]] Q; [destruct (Q eq_refl)|exact D]. }
  destruct (lit_true a l) eqn:TL; [destruct (lit_true a m) eqn:TM|]; simpl.
  - apply (unit_clause f [(true, g); negate l; negate m] _).
    + apply I. simpl. auto.
    + left. reflexivity.
    + intros q [<-|[<-|[<-|[]]]] Q; [destruct (Q eq_refl)| |];
        rewrite negate_involutive; assumption.
  - apply (N m); [|exact M]. apply I. simpl. auto.
  - apply (N l); [|exact L]. apply I. simpl. auto.
Qed.

(** ** How what is given is put together *)

Lemma extends_sound s t : extends s t -> sound s -> sound t.
Proof. intros [_ [_ [W _]]]. exact W. Qed.

Lemma extends_incl s t : extends s t -> incl (built s) (built t).
Proof. intros [_ [I _]]. exact I. Qed.

Lemma extends_older s t x : extends s t -> older s x -> older t x.
Proof. intros [N _]. apply older_mono, N. Qed.

Lemma extends_true s t a : extends s t -> cnf_true a (built t) = true -> cnf_true a (built s) = true.
Proof. intro E. apply cnf_true_incl, extends_incl, E. Qed.

Lemma incl_extends s t f : extends s t -> incl (built t) f -> incl (built s) f.
Proof. intros E I. eapply incl_tran; [apply extends_incl, E|exact I]. Qed.

(** What holds of a state holds of what extends it. *)
Lemma gives_later s l s1 v n s2 :
  gives s (l, s1) v n -> (sound s1 -> extends s1 s2) -> gives s (l, s2) v n.
Proof.
  intros G X S. destruct (G S) as [E [O [V K]]].
  specialize (X (extends_sound _ _ E S)).
  split; [eapply extends_trans; eauto|]. split; [eapply extends_older; eauto|]. split.
  - intros a A. apply V. eapply extends_true; eauto.
  - intros f a I A. apply K; [eapply incl_extends; eauto|eapply extends_true; eauto].
Qed.

Lemma gives_all_later s ls s1 v n s2 :
  gives_all s (ls, s1) v n -> (sound s1 -> extends s1 s2) -> gives_all s (ls, s2) v n.
Proof.
  intros G X S. destruct (G S) as [E [O [V K]]].
  specialize (X (extends_sound _ _ E S)).
  split; [eapply extends_trans; eauto|]. split; [intros l L; eapply extends_older; eauto|]. split.
  - intros a A. apply V. eapply extends_true; eauto.
  - intros f a I A. apply K; [eapply incl_extends; eauto|eapply extends_true; eauto].
Qed.

(** What was made of a later state was made of an earlier one. *)
Lemma gives_earlier s0 s out v n :
  (sound s0 -> extends s0 s) -> gives s out v n -> gives s0 out v n.
Proof.
  destruct out as [l s1]. intros X G S. specialize (X S).
  destruct (G (extends_sound _ _ X S)) as [E R]. split; [eapply extends_trans; eauto|exact R].
Qed.

Lemma gives_all_earlier s0 s out v n :
  (sound s0 -> extends s0 s) -> gives_all s out v n -> gives_all s0 out v n.
Proof.
  destruct out as [l s1]. intros X G S. specialize (X S).
  destruct (G (extends_sound _ _ X S)) as [E R]. split; [eapply extends_trans; eauto|exact R].
Qed.

Lemma gives_needs s out v n n' : incl n n' -> gives s out v n -> gives s out v n'.
Proof.
  destruct out. intros I G S. destruct (G S) as [E [O [V K]]]. auto 10.
Qed.

Lemma gives_all_needs s out v n n' : incl n n' -> gives_all s out v n -> gives_all s out v n'.
Proof.
  destruct out. intros I G S. destruct (G S) as [E [O [V K]]]. auto 10.
Qed.

Lemma gives_value s out v w n : (forall a, v a = w a) -> gives s out v n -> gives s out w n.
Proof.
  destruct out. intros Q G S. destruct (G S) as [E [O [V K]]].
  split; [exact E|]. split; [exact O|]. split; [|exact K].
  intros a A. rewrite <- Q. auto.
Qed.

Lemma gives_all_value s out v w n :
  (forall a, v a = w a) -> gives_all s out v n -> gives_all s out w n.
Proof.
  destruct out. intros Q G S. destruct (G S) as [E [O [V K]]].
  split; [exact E|]. split; [exact O|]. split; [|exact K].
  intros a A. rewrite <- Q. auto.
Qed.

(** The values need only be the same where the clauses hold. *)
Lemma gives_value_on s l s1 v w n :
  (sound s -> forall a, cnf_true a (built s1) = true -> v a = w a) ->
  gives s (l, s1) v n -> gives s (l, s1) w n.
Proof.
  intros Q G S. destruct (G S) as [E [O [V K]]].
  split; [exact E|]. split; [exact O|]. split; [|exact K].
  intros a A. rewrite <- Q by assumption. auto.
Qed.

Lemma gives_all_value_on s ls s1 v w n :
  (sound s -> forall a, cnf_true a (built s1) = true -> v a = w a) ->
  gives_all s (ls, s1) v n -> gives_all s (ls, s1) w n.
Proof.
  intros Q G S. destruct (G S) as [E [O [V K]]].
  split; [exact E|]. split; [exact O|]. split; [|exact K].
  intros a A. rewrite <- Q by assumption. auto.
Qed.

Lemma gives_extends s l s1 v n : gives s (l, s1) v n -> sound s -> extends s s1.
Proof. intros G S. apply (G S). Qed.

Lemma gives_all_extends s l s1 v n : gives_all s (l, s1) v n -> sound s -> extends s s1.
Proof. intros G S. apply (G S). Qed.

Lemma gate_gives s l m s1 v w n :
  gives s (l, s1) v n -> gives s (m, s1) w n -> gives s (gate l m s1) (fun a => v a && w a) n.
Proof.
  intros G H. pose proof (gate_extends l m s1) as BE.
  pose proof (gate_value l m s1) as BV. pose proof (gate_known l m s1) as BK.
  destruct (gate l m s1) as [g s2] eqn:B. cbn [fst snd] in *. intro S.
  destruct (G S) as [E [Ol [Vl Kl]]]. destruct (H S) as [_ [Om [Vm Km]]].
  specialize (BE Ol Om).
  split; [eapply extends_trans; eauto|]. split; [|split].
  - unfold gate in B. injection B as <- <-. simpl. lia.
  - intros a A. rewrite BV by exact A.
    rewrite Vl, Vm by (eapply extends_true; eauto). reflexivity.
  - intros f a I A N.
    assert (I1 : incl (built s1) f) by (eapply incl_extends; eauto).
    assert (A1 : cnf_true a (built s1) = true) by (eapply extends_true; eauto).
    apply BK; auto.
Qed.

Lemma constant_of_spec l b s a :
  constant_of l = Some b -> sound s -> cnf_true a (built s) = true -> lit_true a l = b.
Proof.
  intros C S A. rewrite cnf_true_spec in A. specialize (A _ (proj1 S)).
  destruct l as [c [x|x|]]; try discriminate C. injection C as ->.
  simpl in A. unfold lit_true in *. simpl in *. destruct b, (a 1%positive); auto; discriminate.
Qed.

Lemma both_gives s l m s1 v w n :
  gives s (l, s1) v n -> gives s (m, s1) w n -> gives s (both l m s1) (fun a => v a && w a) n.
Proof.
  intros G H.
  assert (L : forall b, constant_of l = Some b -> gives s (if b then m else l, s1) (fun a => v a && w a) n).
  { intros b C. destruct b; eapply gives_value_on; try exact G; try exact H; cbn beta; intros S a A;
      destruct (G S) as [E [_ [V _]]];
      rewrite <- (V a A), (constant_of_spec _ _ _ a C (extends_sound _ _ E S) A); reflexivity. }
  assert (M : forall b, constant_of m = Some b -> gives s (if b then l else m, s1) (fun a => v a && w a) n).
  { intros b C. destruct b; eapply gives_value_on; try exact G; try exact H; cbn beta; intros S a A;
      destruct (H S) as [E [_ [W _]]];
      rewrite <- (W a A), (constant_of_spec _ _ _ a C (extends_sound _ _ E S) A);
      rewrite ?andb_true_r, ?andb_false_r; reflexivity. }
  unfold both. destruct (constant_of l) as [[|]|].
  - exact (L true eq_refl).
  - destruct (constant_of m) as [[|]|]; [exact (L false eq_refl)|exact (M false eq_refl)|exact (L false eq_refl)].
  - destruct (constant_of m) as [[|]|]; [exact (M true eq_refl)|exact (M false eq_refl)|].
    apply gate_gives; assumption.
Qed.

Lemma negate_gives s l s1 v n :
  gives s (l, s1) v n -> gives s (negate l, s1) (fun a => negb (v a)) n.
Proof.
  intros G S. destruct (G S) as [E [O [V K]]]. split; [exact E|]. split; [exact O|]. split.
  - intros a A. rewrite lit_true_negate, V by exact A. reflexivity.
  - intros f a I A N. apply known_negate. auto.
Qed.

Lemma either_gives s l m s1 v w n :
  gives s (l, s1) v n -> gives s (m, s1) w n -> gives s (either l m s1) (fun a => v a || w a) n.
Proof.
  intros G H. unfold either.
  pose proof (both_gives _ _ _ _ _ _ _ (negate_gives _ _ _ _ _ G) (negate_gives _ _ _ _ _ H)) as B.
  destruct (both (negate l) (negate m) s1) as [g s2].
  apply (gives_value _ _ (fun a => negb (negb (v a) && negb (w a)))).
  - intro a. destruct (v a), (w a); reflexivity.
  - apply negate_gives. exact B.
Qed.

Lemma constant_gives s b n : gives s (constant b, s) (fun _ => b) n.
Proof.
  intro S. split; [apply extends_refl|]. split; [exact I|]. split.
  - intros a A. rewrite cnf_true_spec in A. specialize (A _ (proj1 S)).
    simpl in A. unfold lit_true in *. simpl in *. destruct b, (a 1%positive); auto; discriminate.
  - intros f a If A _. unfold known.
    assert (X : derives f (constant true)) by (apply derives_unit, If, S).
    pose proof (derives_sound _ _ a (derives_unit _ _ (proj1 S)) A) as Y.
    unfold lit_true in *. simpl in *. destruct b, (a 1%positive); try discriminate; exact X.
Qed.

(** * Formulas *)

Section Formulas.

Variable A : Type.
Variable code : A -> positive.

Fixpoint build (f : formula A) (s : state) : lit * state :=
  match f with
  | Truth b => (constant b, s)
  | Atom x => ((true, code x), s)
  | Not g => let (l, s') := build g s in (negate l, s')
  | And g h =>
      let (l, s1) := build g s in
      let (m, s2) := build h s1 in both l m s2
  | Or g h =>
      let (l, s1) := build g s in
      let (m, s2) := build h s1 in either l m s2
  end.

Hypothesis code_even : forall x g, code x <> (g~1)%positive.

Lemma build_gives f s :
  gives s (build f s) (fun a => eval (fun x => a (code x)) f) (map code (atoms_of f)).
Proof.
  revert s. induction f as [b|x|g IHg|g IHg h IHh|g IHg h IHh]; intro s; cbn [build].
  - apply constant_gives.
  - intros S. split; [apply extends_refl|]. split; [|split].
    + unfold older. cbn [snd]. pose proof (code_even x) as C.
      destruct (code x); [exfalso; eapply C; reflexivity|exact I|exact I].
    + intros a _. unfold lit_true. simpl. destruct (a (code x)); reflexivity.
    + intros f a _ _ N. apply N. left. reflexivity.
  - specialize (IHg s). destruct (build g s) as [l s1]. apply negate_gives, IHg.
  - specialize (IHg s). destruct (build g s) as [l s1].
    specialize (IHh s1). destruct (build h s1) as [m s2]. cbn [eval atoms_of].
    rewrite map_app. apply both_gives.
    + eapply gives_later; [|apply (gives_extends _ _ _ _ _ IHh)].
      eapply gives_needs; [|exact IHg]. apply incl_appl, incl_refl.
    + eapply gives_earlier; [apply (gives_extends _ _ _ _ _ IHg)|].
      eapply gives_needs; [|exact IHh]. apply incl_appr, incl_refl.
  - specialize (IHg s). destruct (build g s) as [l s1].
    specialize (IHh s1). destruct (build h s1) as [m s2]. cbn [eval atoms_of].
    rewrite map_app. apply either_gives.
    + eapply gives_later; [|apply (gives_extends _ _ _ _ _ IHh)].
      eapply gives_needs; [|exact IHg]. apply incl_appl, incl_refl.
    + eapply gives_earlier; [apply (gives_extends _ _ _ _ _ IHg)|].
      eapply gives_needs; [|exact IHh]. apply incl_appr, incl_refl.
Qed.

End Formulas.

(** * Lists of literals *)

Lemma nil_gives s n : gives_all s ([], s) (fun _ => []) n.
Proof. 
  intro S. split; [apply extends_refl|]. split; [intros l []|].
  split; [reflexivity|]. intros f a _ _ _ l [].
Qed.

Lemma cons_gives s l ls s1 v w n :
  gives s (l, s1) v n -> gives_all s (ls, s1) w n ->
  gives_all s (l :: ls, s1) (fun a => v a :: w a) n.
Proof.
  intros G H S. destruct (G S) as [E [O [V K]]]. destruct (H S) as [_ [Os [Vs Ks]]].
  split; [exact E|]. split; [|split].
  - intros m [<-|M]; auto.
  - intros a A. simpl. rewrite V, Vs by exact A. reflexivity.
  - intros f a I A N m [<-|M]; eauto.
Qed.

Lemma app_gives s ls ms s1 v w n :
  gives_all s (ls, s1) v n -> gives_all s (ms, s1) w n ->
  gives_all s (ls ++ ms, s1) (fun a => v a ++ w a) n.
Proof.
  intros G H S. destruct (G S) as [E [O [V K]]]. destruct (H S) as [_ [Os [Vs Ks]]].
  split; [exact E|]. split; [|split].
  - intros m M. apply in_app_iff in M. destruct M; auto.
  - intros a A. rewrite map_app, V, Vs by exact A. reflexivity.
  - intros f a I A N m M. apply in_app_iff in M. destruct M; eauto.
Qed.

Lemma head_gives s ls s1 w n :
  gives_all s (ls, s1) w n -> gives s (hd (constant false) ls, s1) (fun a => hd false (w a)) n.
Proof.
  intros H S. destruct (H S) as [E [O [V K]]].
  pose proof (constant_gives s1 false n (extends_sound _ _ E S)) as [_ [Oc [Vc Kc]]].
  split; [exact E|]. split; [|split].
  - destruct ls; [exact Oc|]. apply O. left. reflexivity.
  - intros a A. rewrite <- V by exact A. destruct ls; [apply Vc, A|reflexivity].
  - intros f a I A N. destruct ls; [apply Kc; auto|]. apply (K f a); auto. left. reflexivity.
Qed.

Lemma tail_gives s ls s1 w n :
  gives_all s (ls, s1) w n -> gives_all s (tl ls, s1) (fun a => tl (w a)) n.
Proof.
  intros H S. destruct (H S) as [E [O [V K]]].
  assert (T : forall l, In l (tl ls) -> In l ls) by (destruct ls; simpl; auto).
  split; [exact E|]. split; [auto|]. split; [|eauto].
  intros a A. rewrite <- V by exact A. destruct ls; reflexivity.
Qed.

Section Lists.

Variable A : Type.
Variable code : A -> positive.
Hypothesis code_even : forall x g, code x <> (g~1)%positive.

Fixpoint build_all (fs : list (formula A)) (s : state) : list lit * state :=
  match fs with
  | [] => ([], s)
  | f :: rest =>
      let (l, s1) := build A code f s in
      let (ls, s2) := build_all rest s1 in (l :: ls, s2)
  end.

Lemma build_all_gives fs s :
  gives_all s (build_all fs s) (fun a => map (eval (fun x => a (code x))) fs)
            (flat_map (fun f => map code (atoms_of f)) fs).
Proof.
  revert s. induction fs as [|f fs IH]; intro s; cbn [build_all map flat_map].
  - apply nil_gives.
  - pose proof (build_gives A code code_even f s) as G.
    destruct (build A code f s) as [l s1].
    specialize (IH s1). destruct (build_all fs s1) as [ls s2].
    apply cons_gives.
    + eapply gives_later; [|apply (gives_all_extends _ _ _ _ _ IH)].
      eapply gives_needs; [|exact G]. apply incl_appl, incl_refl.
    + eapply gives_all_earlier; [apply (gives_extends _ _ _ _ _ G)|].
      eapply gives_all_needs; [|exact IH]. apply incl_appr, incl_refl.
Qed.

End Lists.

(** ** Conjunctions and disjunctions of literals *)

Fixpoint any_of (ls : list lit) (s : state) : lit * state :=
  match ls with
  | [] => (constant false, s)
  | l :: rest => let (m, s1) := any_of rest s in either l m s1
  end.

Fixpoint all_of (ls : list lit) (s : state) : lit * state :=
  match ls with
  | [] => (constant true, s)
  | l :: rest => let (m, s1) := all_of rest s in both l m s1
  end.

(** What was given on the way to a state is given there. *)
Lemma gives_here s l s1 v n : gives s (l, s1) v n -> sound s -> gives s1 (l, s1) v n.
Proof. intros G S _. destruct (G S) as [E R]. split; [apply extends_refl|exact R]. Qed.

Lemma gives_all_here s ls s1 v n : gives_all s (ls, s1) v n -> sound s -> gives_all s1 (ls, s1) v n.
Proof. intros G S _. destruct (G S) as [E R]. split; [apply extends_refl|exact R]. Qed.

Lemma any_of_gives s ls w n :
  gives_all s (ls, s) w n -> gives s (any_of ls s) (fun a => existsb id (w a)) n.
Proof.
  revert w. induction ls as [|l ls IH]; intros w G; cbn [any_of].
  - intro S. destruct (G S) as [E [_ [V _]]].
    destruct (constant_gives s false n S) as [_ [Oc [Vc Kc]]].
    split; [exact E|]. split; [exact Oc|]. split; [|exact Kc].
    intros a A. rewrite <- V by exact A. apply Vc, A.
  - pose proof (head_gives _ _ _ _ _ G) as H. cbn [hd] in H.
    specialize (IH _ (tail_gives _ _ _ _ _ G)). cbn [tl] in IH.
    destruct (any_of ls s) as [m s1].
    pose proof (gives_later _ _ _ _ _ _ H (gives_extends _ _ _ _ _ IH)) as L.
    eapply gives_value; [|exact (either_gives _ _ _ _ _ _ _ L IH)].
    intro a. cbn beta. destruct (w a); reflexivity.
Qed.

Lemma all_of_gives s ls w n :
  gives_all s (ls, s) w n -> gives s (all_of ls s) (fun a => forallb id (w a)) n.
Proof.
  revert w. induction ls as [|l ls IH]; intros w G; cbn [all_of].
  - intro S. destruct (G S) as [E [_ [V _]]].
    destruct (constant_gives s true n S) as [_ [Oc [Vc Kc]]].
    split; [exact E|]. split; [exact Oc|]. split; [|exact Kc].
    intros a A. rewrite <- V by exact A. apply Vc, A.
  - pose proof (head_gives _ _ _ _ _ G) as H. cbn [hd] in H.
    specialize (IH _ (tail_gives _ _ _ _ _ G)). cbn [tl] in IH.
    destruct (all_of ls s) as [m s1].
    pose proof (gives_later _ _ _ _ _ _ H (gives_extends _ _ _ _ _ IH)) as L.
    pose proof (both_gives _ _ _ _ _ _ _ L IH) as B.
    destruct (both l m s1) as [g s2].
    (* The head of an empty list would be false; there is none, as [ls] has one. *)
    eapply gives_value_on; [|exact B]. intros S a A.
    assert (A1 : cnf_true a (built s) = true).
    { destruct (B S) as [E _]. eapply extends_true; eauto. }
    destruct (G S) as [_ [_ [W _]]]. rewrite <- W by exact A1. reflexivity.
Qed.
