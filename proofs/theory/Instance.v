(** CO-SLEEC instances, the translation γ and Definition 2
    ([sleec_runtime/dispatch/instance.py]; paper, Section 3.2). *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment.
Import ListNotations.

(** * Instances and their execution *)

(** [SharedEpsilon] is the paper's ε, one for all rules; [Epsilon] the one that a
    rule has to itself; [Layer] is ℓ(R)i. *)
Inductive layer :=
| SharedEpsilon
| Epsilon (rule : name)
| Layer (rule : name) (number : nat).

(** ⟨M, L, MM, LM⟩, and for each method its implementation variants: the layer
    that each is bound with, and the obligations whose code it contains. *)
Record instance := Instance {
  methods : list name;
  layers : list layer;
  method_manager : rule -> name;
  layer_manager : context -> list layer;
  variants : name -> list (layer * list name) }.

(** Definition 2.  C0 is the trigger together with the rule's guard. *)
Definition executes (I : instance) (G : ruleset) (chi : context) (o : name) : Prop :=
  exists R l code,
    In R G /\ triggered chi R = true /\ In l (layer_manager I chi) /\
    In (l, code) (variants I (method_manager I R)) /\ In o code.

(** * The translation *)

(** [bound R i] is the layer that the variant of clause [i] is bound with, and
    [chosen chi R] the layer that Algorithm 1 returns.  Any two rules may share a
    method. *)
Definition translation (method : rule -> name) (bound : rule -> nat -> layer)
    (chosen : context -> rule -> layer) (G : ruleset) : instance :=
  {| methods := map method G;
     layers := flat_map (fun R => map (bound R) (clause_numbers R)) G;
     method_manager := method;
     layer_manager := fun chi => map (chosen chi) (filter (triggered chi) G);
     variants := fun m =>
       flat_map
         (fun R => if Pos.eqb (method R) m
                   then map (fun i => (bound R i, to_do (clause R i))) (clause_numbers R)
                   else [])
         G |}.

Definition layer_of (epsilon : rule -> layer) (R : rule) (i : nat) : layer :=
  match i with 0 => epsilon R | S _ => Layer (label R) i end.

Definition returned (epsilon : rule -> layer) (R : rule) (answer : option nat) : layer :=
  match answer with None => epsilon R | Some i => Layer (label R) i end.

Definition shared (R : rule) : layer := SharedEpsilon.
Definition own (R : rule) : layer := Epsilon (label R).

(** γ as printed: one ε, and Algorithm 1 as printed. *)
Definition gamma_as_printed (method : rule -> name) : ruleset -> instance :=
  translation method (layer_of shared)
    (fun chi R => returned shared R (algorithm_1_as_printed chi R)).

(** γ with one ε, but Algorithm 1 corrected for rules without hedges. *)
Definition gamma_shared (r : reading) (method : rule -> name) : ruleset -> instance :=
  translation method (layer_of shared) (fun chi R => returned shared R (algorithm_1 r chi R)).

(** γ corrected: each rule has an ε of its own. *)
Definition gamma (r : reading) (method : rule -> name) : ruleset -> instance :=
  translation method (layer_of own) (fun chi R => returned own R (algorithm_1 r chi R)).

(** * What is executed, computed *)

Definition layer_eq_dec (l m : layer) : {l = m} + {l <> m}.
Proof. decide equality; (apply Pos.eq_dec || apply Nat.eq_dec). Defined.

Definition executed (I : instance) (G : ruleset) (chi : context) : list name :=
  flat_map
    (fun R =>
       flat_map
         (fun v => if in_dec layer_eq_dec (fst v) (layer_manager I chi) then snd v else [])
         (variants I (method_manager I R)))
    (filter (triggered chi) G).

Lemma executed_spec I G chi o : In o (executed I G chi) <-> executes I G chi o.
Proof.
  unfold executed, executes. rewrite in_flat_map. split.
  - intros [R [F H]]. apply filter_In in F. apply in_flat_map in H.
    destruct H as [[l code] [V H]]. simpl in H.
    destruct (in_dec _ _ _) as [L|]; [|destruct H]. exists R, l, code. tauto.
  - intros [R [l [code [IR [T [L [V H]]]]]]]. exists R. rewrite filter_In. split; auto.
    apply in_flat_map. exists (l, code). split; auto. simpl.
    destruct (in_dec _ _ _); [exact H|contradiction].
Qed.

(** * What the corrected translation executes *)

(** The paper: "for all R, R', if ℓ(R) = ℓ(R') then R = R'". *)
Definition unique_labels (G : ruleset) : Prop :=
  forall R R', In R G -> In R' G -> label R = label R' -> R = R'.

Lemma returned_active epsilon r chi R :
  returned epsilon R (algorithm_1 r chi R) = layer_of epsilon R (active r chi R).
Proof. unfold algorithm_1. destruct (active r chi R); reflexivity. Qed.

Lemma in_variants method bound chosen G m l code :
  In (l, code) (variants (translation method bound chosen G) m) <->
  exists R i, In R G /\ method R = m /\ i <= length (hedges R) /\
              l = bound R i /\ code = to_do (clause R i).
Proof.
  cbn [variants translation]. rewrite in_flat_map. split.
  - intros [R [IR H]]. destruct (Pos.eqb_spec (method R) m); [|destruct H].
    apply in_map_iff in H. destruct H as [i [E H]]. apply in_clause_numbers in H.
    inversion E. exists R, i. auto.
  - intros [R [i [IR [M [H [-> ->]]]]]]. exists R. split; auto.
    rewrite M, Pos.eqb_refl. apply in_map_iff. exists i. rewrite in_clause_numbers. auto.
Qed.

(** What is due is executed.  This half needs nothing of the labels. *)
Theorem due_executed r method G chi o :
  In (Do o) (due r G chi) -> executes (gamma r method G) G chi o.
Proof.
  intro D. apply in_due in D. destruct D as [R [IR [T H]]].
  exists R, (layer_of own R (active r chi R)), (to_do (clause R (active r chi R))).
  repeat split; auto.
  - simpl. apply in_map_iff. exists R. rewrite returned_active, filter_In. auto.
  - apply in_variants. exists R, (active r chi R). auto using active_bound.
  - apply in_to_do. exact H.
Qed.

(** What is executed is due, if no two rules have one label. *)
Theorem executed_due r method G chi o :
  unique_labels G -> executes (gamma r method G) G chi o -> In (Do o) (due r G chi).
Proof.
  intros U [R [l [code [IR [T [L [V H]]]]]]].
  apply in_variants in V. destruct V as [R' [i [IR' [_ [_ [-> ->]]]]]].
  simpl in L. apply in_map_iff in L. destruct L as [Q [E F]].
  apply filter_In in F. destruct F as [IQ TQ]. rewrite returned_active in E.
  assert (S : Q = R' /\ active r chi Q = i).
  { destruct i, (active r chi Q); simpl in E; try discriminate E; inversion E; auto. }
  destruct S as [-> <-].
  apply in_due. exists R'. apply in_to_do in H. auto.
Qed.

Corollary executed_iff_due r method G chi o :
  unique_labels G -> executes (gamma r method G) G chi o <-> In (Do o) (due r G chi).
Proof. intro U. split; [apply executed_due, U|apply due_executed]. Qed.

(** The corrected translation activates only its own layers. *)
Theorem layers_exist r method G chi l :
  In l (layer_manager (gamma r method G) chi) -> In l (layers (gamma r method G)).
Proof.
  cbn [gamma translation layers layer_manager].
  intro H. apply in_map_iff in H. destruct H as [R [<- F]].
  apply filter_In in F. apply in_flat_map. exists R. split; [tauto|].
  rewrite returned_active. apply in_map, in_clause_numbers, active_bound.
Qed.

(** A hedge without a response has a layer like any other, and where it is active its
    rule does nothing: the base variant does not run in its place. *)
Theorem empty_hedge_suppresses r method G chi R k :
  In R G -> triggered chi R = true -> active r chi R = S k -> clause R (S k) = [] ->
  In (Layer (label R) (S k)) (layer_manager (gamma r method G) chi) /\
  In (Layer (label R) (S k)) (layers (gamma r method G)) /\
  due_of r chi R = [].
Proof.
  intros I T A C.
  assert (L : In (Layer (label R) (S k)) (layer_manager (gamma r method G) chi)).
  { cbn [gamma translation layer_manager]. apply in_map_iff. exists R.
    rewrite returned_active, A, filter_In. auto. }
  split; [exact L|]. split; [apply layers_exist in L; exact L|].
  unfold due_of. rewrite T, A. exact C.
Qed.
