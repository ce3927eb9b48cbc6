(** Clauses, their satisfaction, and unit propagation: plain data that solvers and
    checkers share.  Nothing here knows of rules. *)

From Coq Require Import List Bool PArith Arith Lia FMapPositive.
Import ListNotations.

(** [(true, x)] is the variable x, [(false, x)] its negation; a clause is a
    disjunction, a formula a conjunction of clauses (DIMACS writes x and -x). *)
Definition lit := (bool * positive)%type.
Definition cnf := list (list lit).

Definition negate (l : lit) : lit := (negb (fst l), snd l).

Definition lit_true (a : positive -> bool) (l : lit) : bool := Bool.eqb (fst l) (a (snd l)).
Definition clause_true (a : positive -> bool) (c : list lit) : bool := existsb (lit_true a) c.
Definition cnf_true (a : positive -> bool) (f : cnf) : bool := forallb (clause_true a) f.

Definition satisfiable (f : cnf) : Prop := exists a, cnf_true a f = true.
Definition unsatisfiable (f : cnf) : Prop := forall a, cnf_true a f = false.

Lemma unsatisfiable_iff f : unsatisfiable f <-> ~ satisfiable f.
Proof.
  split.
  - intros U [a H]. rewrite U in H. discriminate.
  - intros N a. apply not_true_is_false. intro H. apply N. exists a. exact H.
Qed.

Lemma lit_true_negate a l : lit_true a (negate l) = negb (lit_true a l).
Proof. unfold lit_true, negate. simpl. destruct (fst l), (a (snd l)); reflexivity. Qed.

Lemma lit_true_pair a b x : lit_true a (b, x) = Bool.eqb b (a x).
Proof. reflexivity. Qed.

Lemma negate_involutive l : negate (negate l) = l.
Proof. destruct l as [b x]. unfold negate. simpl. rewrite negb_involutive. reflexivity. Qed.

Definition lit_eq_dec (l m : lit) : {l = m} + {l <> m}.
Proof. decide equality; [apply Pos.eq_dec|apply bool_dec]. Defined.

Lemma cnf_true_app a f g : cnf_true a (f ++ g) = cnf_true a f && cnf_true a g.
Proof. apply forallb_app. Qed.

Lemma cnf_true_spec a f :
  cnf_true a f = true <-> forall c, In c f -> clause_true a c = true.
Proof. apply forallb_forall. Qed.

Lemma clause_true_spec a c :
  clause_true a c = true <-> exists l, In l c /\ lit_true a l = true.
Proof. apply existsb_exists. Qed.

Lemma cnf_true_incl a f g : incl f g -> cnf_true a g = true -> cnf_true a f = true.
Proof. intros I H. apply cnf_true_spec. intros c C. eapply cnf_true_spec; eauto. Qed.

(** The value depends on the variables that occur only. *)
Lemma lit_true_ext a b l : a (snd l) = b (snd l) -> lit_true a l = lit_true b l.
Proof. unfold lit_true. intros ->. reflexivity. Qed.

(** * Renumbering the variables *)

Definition renumber (h : positive -> positive) (f : cnf) : cnf :=
  map (map (fun l => (fst l, h (snd l)))) f.

(** If clauses with other numbers are unsatisfiable, so are those that they become,
    whatever [h] is: a checker may number variables densely and needs no proof that
    it did so injectively. *)
Theorem renumber_unsatisfiable h f : unsatisfiable f -> unsatisfiable (renumber h f).
Proof.
  intros U a. apply not_true_is_false. intro H.
  specialize (U (fun x => a (h x))). apply not_true_iff_false in U. apply U.
  apply cnf_true_spec. intros c C.
  rewrite cnf_true_spec in H. specialize (H _ (in_map _ _ _ C)).
  apply clause_true_spec in H. destruct H as [l [L T]].
  apply in_map_iff in L. destruct L as [m [<- M]].
  apply clause_true_spec. exists m. split; [exact M|exact T].
Qed.

(** The variables numbered 1, 2, 3, … as they come, and back. *)
Definition tables := (PositiveMap.t positive * PositiveMap.t positive * positive)%type.

Definition enter (t : tables) (l : lit) : tables :=
  match t with
  | (there, back, fresh) =>
      match PositiveMap.find (snd l) there with
      | Some _ => t
      | None => (PositiveMap.add (snd l) fresh there, PositiveMap.add fresh (snd l) back, Pos.succ fresh)
      end
  end.

Definition look (m : PositiveMap.t positive) (x : positive) : positive :=
  match PositiveMap.find x m with Some y => y | None => x end.

Definition cnf_eq_dec (f g : cnf) : {f = g} + {f <> g} := list_eq_dec (list_eq_dec lit_eq_dec) f g.

(** What solvers and DIMACS want.  That the numbers lead back is looked at, not
    proved: the theorem needs no more. *)
Definition dense (f : cnf) : cnf :=
  match fold_left (fun t c => fold_left enter c t) f (PositiveMap.empty _, PositiveMap.empty _, 1%positive) with
  | (there, back, _) =>
      let g := renumber (look there) f in
      if cnf_eq_dec (renumber (look back) g) f then g else f
  end.

Theorem dense_unsatisfiable f : unsatisfiable (dense f) <-> unsatisfiable f.
Proof.
  unfold dense. destruct (fold_left _ f _) as [[there back] fresh].
  destruct (cnf_eq_dec _ f) as [E|_]; [|reflexivity]. split.
  - intro U. rewrite <- E. apply renumber_unsatisfiable, U.
  - apply renumber_unsatisfiable.
Qed.

(** * Unit propagation *)

(** What it derives: a literal of a clause whose other literals are all refuted. *)
Inductive derives (f : cnf) : lit -> Prop :=
| unit_clause c l :
    In c f -> In l c -> (forall m, In m c -> m <> l -> derives f (negate m)) -> derives f l.

(** It ends in a contradiction if both a literal and its negation are derived. *)
Definition refutes (f : cnf) : Prop := exists l, derives f l /\ derives f (negate l).

Theorem derives_sound f l a : derives f l -> cnf_true a f = true -> lit_true a l = true.
Proof.
  intros D H. induction D as [c l C L _ IH].
  rewrite cnf_true_spec in H. specialize (H c C). apply clause_true_spec in H.
  destruct H as [m [M T]]. destruct (lit_eq_dec m l) as [->|N]; [exact T|].
  specialize (IH m M N). rewrite lit_true_negate, T in IH. discriminate.
Qed.

Corollary refutes_sound f : refutes f -> unsatisfiable f.
Proof.
  intros [l [D E]] a. apply not_true_is_false. intro H.
  pose proof (derives_sound f l a D H) as X. pose proof (derives_sound f _ a E H) as Y.
  rewrite lit_true_negate, X in Y. discriminate.
Qed.

Lemma derives_unit f l : In [l] f -> derives f l.
Proof.
  intro I. apply (unit_clause f [l] l I); [left; reflexivity|].
  intros m [<-|[]] N. congruence.
Qed.

(** ** Computed *)

Definition mem (l : lit) (ls : list lit) : bool := if in_dec lit_eq_dec l ls then true else false.

Lemma mem_In l ls : mem l ls = true <-> In l ls.
Proof. unfold mem. destruct (in_dec lit_eq_dec l ls); split; auto; discriminate. Qed.

(** A literal of the clause that is derived at once from what is known, and is new. *)
Definition unit_of (known : list lit) (c : list lit) : option lit :=
  match nodup lit_eq_dec (filter (fun l => negb (mem (negate l) known)) c) with
  | [] => find (fun l => negb (mem l known)) c
  | [l] => if mem l known then None else Some l
  | _ => None
  end.

Fixpoint first_unit (known : list lit) (f : cnf) : option lit :=
  match f with
  | [] => None
  | c :: rest => match unit_of known c with Some l => Some l | None => first_unit known rest end
  end.

Fixpoint propagate_from (fuel : nat) (known : list lit) (f : cnf) : list lit :=
  match fuel with
  | 0 => known
  | S k => match first_unit known f with
           | None => known
           | Some l => propagate_from k (l :: known) f
           end
  end.

(** As many steps as there are literals are enough. *)
Definition propagate (f : cnf) : list lit := propagate_from (S (length (concat f))) [] f.

Lemma unit_of_spec known c l :
  unit_of known c = Some l ->
  In l c /\ ~ In l known /\ forall m, In m c -> m <> l -> In (negate m) known.
Proof.
  unfold unit_of. intro U.
  assert (F : forall m, In m c -> ~ In m (nodup lit_eq_dec (filter (fun l => negb (mem (negate l) known)) c))
                        -> In (negate m) known).
  { intros m M N. apply mem_In. apply not_false_is_true. intro E. apply N, nodup_In, filter_In.
    rewrite E. auto. }
  destruct (nodup _ _) as [|x [|y ys]] eqn:E; [| |discriminate].
  - apply find_some in U. destruct U as [I N]. apply negb_true_iff in N.
    split; [exact I|]. split; [intro K; apply mem_In in K; congruence|].
    intros m M _. apply (F m M). intros [].
  - destruct (mem x known) eqn:K; [discriminate|]. injection U as <-.
    assert (I : In x c).
    { assert (J : In x (nodup lit_eq_dec (filter (fun l => negb (mem (negate l) known)) c)))
        by (rewrite E; left; reflexivity).
      apply nodup_In, filter_In in J. tauto. }
    split; [exact I|]. split; [intro J; apply mem_In in J; congruence|].
    intros m M N. apply (F m M). intros [J|[]]. congruence.
Qed.

Lemma unit_of_none known c l :
  unit_of known c = None -> In l c -> (forall m, In m c -> m <> l -> In (negate m) known) ->
  In l known.
Proof.
  unfold unit_of. intros U L N.
  assert (S : forall m, In m (nodup lit_eq_dec (filter (fun l => negb (mem (negate l) known)) c)) ->
              m = l).
  { intros m M. apply nodup_In, filter_In in M. destruct M as [M E].
    destruct (lit_eq_dec m l) as [|D]; [assumption|]. apply negb_true_iff in E.
    specialize (N m M D). apply mem_In in N. congruence. }
  destruct (nodup _ _) as [|x [|y ys]] eqn:E.
  - apply mem_In, not_false_is_true. intro F. apply (find_none _ _ U) in L.
    rewrite F in L. discriminate.
  - rewrite (S x (or_introl eq_refl)) in U. apply mem_In. destruct (mem l known); [reflexivity|discriminate].
  - exfalso. pose proof (NoDup_nodup lit_eq_dec (filter (fun l => negb (mem (negate l) known)) c)) as D.
    rewrite E in D. inversion D as [|? ? X _]. apply X.
    rewrite (S x (or_introl eq_refl)), (S y (or_intror (or_introl eq_refl))). left. reflexivity.
Qed.

Lemma first_unit_spec known f l :
  first_unit known f = Some l -> exists c, In c f /\ unit_of known c = Some l.
Proof.
  induction f as [|c f IH]; simpl; [discriminate|]. destruct (unit_of known c) eqn:U.
  - intro E. injection E as <-. eauto.
  - intro E. destruct (IH E) as [d [I D]]. eauto.
Qed.

Lemma first_unit_none known f c : first_unit known f = None -> In c f -> unit_of known c = None.
Proof.
  induction f as [|d f IH]; simpl; [tauto|]. destruct (unit_of known d) eqn:U; [discriminate|].
  intros E [<-|I]; auto.
Qed.

Lemma propagate_from_spec fuel known f :
  NoDup known -> incl known (concat f) -> (forall l, In l known -> derives f l) ->
  length (concat f) < length known + fuel ->
  first_unit (propagate_from fuel known f) f = None /\
  forall l, In l (propagate_from fuel known f) -> derives f l.
Proof.
  revert known. induction fuel as [|fuel IH]; intros known N I D L.
  - apply (NoDup_incl_length N) in I. lia.
  - cbn [propagate_from]. destruct (first_unit known f) as [l|] eqn:F; [|auto].
    destruct (first_unit_spec _ _ _ F) as [c [C U]]. apply unit_of_spec in U.
    destruct U as [LC [NK R]]. apply IH.
    + constructor; assumption.
    + intros m [<-|M]; [apply in_concat; eauto|auto].
    + intros m [<-|M]; [|auto]. apply (unit_clause f c l C LC). auto.
    + simpl. lia.
Qed.

(** What is computed is what is derived. *)
Theorem propagate_correct f l : In l (propagate f) <-> derives f l.
Proof.
  destruct (propagate_from_spec (S (length (concat f))) [] f) as [N D].
  - constructor.
  - intros m [].
  - intros m [].
  - simpl. lia.
  - split; [apply D|]. intro E. fold (propagate f) in N.
    induction E as [c l C L _ IH]. apply (unit_of_none _ c); auto.
    exact (first_unit_none _ _ _ N C).
Qed.

Definition contradicts (ls : list lit) : bool := existsb (fun l => mem (negate l) ls) ls.

Theorem contradicts_correct f : contradicts (propagate f) = true <-> refutes f.
Proof.
  unfold contradicts, refutes. rewrite existsb_exists.
  split; intros [l [A B]]; exists l.
  - rewrite mem_In in B. split; apply propagate_correct; assumption.
  - rewrite mem_In. split; apply propagate_correct; assumption.
Qed.
