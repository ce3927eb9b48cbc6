(** Clauses, their satisfaction, and unit propagation: plain data that solvers and
    checkers share.  Nothing here knows of rules. *)

From Coq Require Import List Bool PArith Arith Lia.
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

Lemma negate_different l : negate l <> l.
Proof. destruct l as [[|] x]; discriminate. Qed.

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

(** * Numbering the variables anew *)

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

Lemma derives_incl f g l : incl f g -> derives f l -> derives g l.
Proof. intros I D. induction D as [c l C L _ IH]. exact (unit_clause g c l (I _ C) L IH). Qed.

Lemma derives_unit f l : In [l] f -> derives f l.
Proof.
  intro I. apply (unit_clause f [l] l I); [left; reflexivity|].
  intros m [<-|[]] N. congruence.
Qed.
