(** Chains inside chains ([IN WHICH CASE (… UNLESS …)], [docs/semantics.md]): a chain
    in parentheses speaks only where the clause that holds it decides in its own.

    Such rules are no more than flat ones: each chain becomes a rule of its own, whose
    guard says that its holder decides.  So all that is proved of flat rules holds of
    them. *)

From Coq Require Import List Bool PArith Arith Lia.
From Sleec Require Import Model Evaluation Equation Entailment Readings.
Import ListNotations.

(** A response, and the chain of hedges that may take its place. *)
Inductive chain :=
| Chain (obliges : list literal) (inner : list (condition * chain)).

Definition obliges (c : chain) : list literal := let (ls, _) := c in ls.
Definition inner (c : chain) : list (condition * chain) := let (_, hs) := c in hs.

Record nested_rule := NestedRule {
  nested_label : name;
  nested_trigger : name;
  nested_guard : condition;
  response : chain }.

(** What a chain obliges: the member that decides speaks, by its own chain if it has
    one.  The walk is that of the text. *)
Fixpoint chain_due (r : reading) (chi : context) (c : chain) : list literal :=
  let (ls, hs) := c in
  nth (decides r (map (fun h => satisfies chi (fst h)) hs))
      (ls :: map (fun h => chain_due r chi (snd h)) hs) [].

Definition nested_due (r : reading) (chi : context) (R : nested_rule) : list literal :=
  if chi (Occurs (nested_trigger R)) && satisfies chi (nested_guard R)
  then chain_due r chi (response R) else [].

(** * Flat rules for it *)

(** A chain without inner ones, as a list of literals; an inner chain is left to the
    rules made of it. *)
Definition own_part (c : chain) : list literal :=
  match inner c with [] => obliges c | _ => [] end.

(** Where member [i] of a chain decides; the conditions are those of [conjuncts]. *)
Definition member_guard (r : reading) (g : condition) (hs : list (condition * chain)) (i : nat)
  : condition := conj (conjuncts r g (map fst hs) i).

Fixpoint flatten_chain (r : reading) (l t : name) (g : condition) (c : chain) : list rule :=
  let (ls, hs) := c in
  Rule l t g ls (map (fun h => Hedge (fst h) (own_part (snd h))) hs)
  :: concat
       ((fix go (i : nat) (rest : list (condition * chain)) : list (list rule) :=
           match rest with
           | [] => []
           | h :: more =>
               (match inner (snd h) with
                | [] => []
                | _ => flatten_chain r l t (member_guard r g hs i) (snd h)
                end) :: go (S i) more
           end) 1 hs).

Definition flatten (r : reading) (R : nested_rule) : ruleset :=
  flatten_chain r (nested_label R) (nested_trigger R) (nested_guard R) (response R).

(** * They oblige the same *)

Lemma member_guard_spec r chi g hs i :
  i <= length hs ->
  satisfies chi (member_guard r g hs i)
  = satisfies chi g && (decides r (map (fun h => satisfies chi (fst h)) hs) =? i).
Proof.
  intro I. unfold member_guard, satisfies. rewrite conjuncts_decide by (rewrite map_length; exact I).
  rewrite map_map. reflexivity.
Qed.

(** Induction over chains, into their inner ones. *)
Lemma chain_induction (P : chain -> Prop) :
  (forall ls hs, (forall h, In h hs -> P (snd h)) -> P (Chain ls hs)) -> forall c, P c.
Proof.
  intro H. fix self 1. intros [ls hs]. apply H.
  induction hs as [|h hs IH]; intros k I; [destruct I|].
  destruct I as [<-|I]; [apply self|exact (IH k I)].
Qed.

Lemma flatten_chain_due r chi l t c : forall g k,
  In k (due r (flatten_chain r l t g c) chi) <->
  chi (Occurs t) = true /\ satisfies chi g = true /\ In k (chain_due r chi c).
Proof.
  induction c as [ls hs IH] using chain_induction. intros g k.
  set (bs := map (fun h => satisfies chi (fst h)) hs).
  set (n := decides r bs).
  assert (N : n <= length hs).
  { unfold n. eapply Nat.le_trans; [apply decides_bound|]. unfold bs. rewrite map_length. auto. }
  (* What the rules of the inner chains oblige. *)
  assert (Inner : forall rest i, (forall h, In h rest -> In h hs) -> i + length rest = S (length hs) ->
    1 <= i ->
    In k (due r (concat
      ((fix go (i : nat) (rest : list (condition * chain)) : list (list rule) :=
          match rest with
          | [] => []
          | h :: more =>
              (match inner (snd h) with
               | [] => []
               | _ => flatten_chain r l t (member_guard r g hs i) (snd h)
               end) :: go (S i) more
          end) i rest)) chi) <->
    chi (Occurs t) = true /\ satisfies chi g = true /\
    exists j h, nth_error rest j = Some h /\ n = i + j /\ inner (snd h) <> [] /\
                In k (chain_due r chi (snd h))).
  { induction rest as [|h rest IHr]; intros i S L P.
    - simpl. split; [tauto|]. intros [_ [_ [[|j] [h [E _]]]]]; discriminate E.
    - cbn [concat]. unfold due. rewrite flat_map_app, in_app_iff.
      fold (due r (match inner (snd h) with
                   | [] => []
                   | _ => flatten_chain r l t (member_guard r g hs i) (snd h)
                   end) chi).
      match goal with |- _ \/ In k (flat_map _ ?rs) <-> _ => fold (due r rs chi) end.
      rewrite IHr; [|intros; apply S; right; assumption|simpl in L; lia|lia].
      cbn [length] in L.
      assert (Here : In k (due r (match inner (snd h) with
                   | [] => []
                   | _ => flatten_chain r l t (member_guard r g hs i) (snd h)
                   end) chi) <->
          chi (Occurs t) = true /\ satisfies chi g = true /\ n = i /\ inner (snd h) <> [] /\
          In k (chain_due r chi (snd h))).
      { destruct (inner (snd h)) as [|x xs] eqn:X.
        - simpl. split; [tauto|]. intros [_ [_ [_ [F _]]]]. congruence.
        - rewrite (IH h (S h (or_introl eq_refl))), member_guard_spec by lia.
          fold bs. fold n. rewrite andb_true_iff, Nat.eqb_eq.
          split; [|tauto]. intros [A [[B C] D]]. repeat split; auto. discriminate. }
      rewrite Here. split.
      + intros [[A [B [C [D E]]]]|[A [B [j [h' [E [C D]]]]]]].
        * split; [exact A|]. split; [exact B|]. exists 0, h. split; [reflexivity|].
          rewrite Nat.add_0_r. auto.
        * split; [exact A|]. split; [exact B|]. exists (Datatypes.S j), h'.
          split; [exact E|]. split; [lia|exact D].
      + intros [A [B [[|j] [h' [E [C D]]]]]].
        * left. injection E as ->. rewrite Nat.add_0_r in C. tauto.
        * right. split; [exact A|]. split; [exact B|]. exists j, h'.
          split; [exact E|]. split; [lia|exact D]. }
  cbn [flatten_chain chain_due]. fold bs. fold n.
  unfold due. cbn [flat_map]. rewrite in_app_iff.
  match goal with |- _ \/ In k (flat_map _ ?rs) <-> _ => fold (due r rs chi) end.
  rewrite (Inner hs 1) by (auto; lia).
  assert (Flat : In k (due_of r chi (Rule l t g ls (map (fun h => Hedge (fst h) (own_part (snd h))) hs)))
    <-> chi (Occurs t) = true /\ satisfies chi g = true /\
        In k (nth n (ls :: map (fun h => own_part (snd h)) hs) [])).
  { unfold due_of, triggered, active, truths, clause, clauses.
    cbn [trigger rule_guard hedges default]. rewrite !map_map. cbn [hedge_condition hedge_obliges].
    fold bs. fold n. destruct (chi (Occurs t)), (satisfies chi g); simpl; intuition discriminate. }
  rewrite Flat.
  assert (Split : In k (nth n (ls :: map (fun h => chain_due r chi (snd h)) hs) []) <->
    In k (nth n (ls :: map (fun h => own_part (snd h)) hs) []) \/
    exists j h, nth_error hs j = Some h /\ n = 1 + j /\ inner (snd h) <> [] /\
                In k (chain_due r chi (snd h))).
  { destruct n as [|m]; cbn [nth].
    - split; [auto|]. intros [I|[j [h [_ [E _]]]]]; [exact I|discriminate E].
    - assert (M : m < length hs) by lia. destruct (nth_error hs m) as [h|] eqn:E;
        [|apply nth_error_None in E; lia].
      assert (V : forall f, nth m (map f hs) [] = (f h : list literal)).
      { intro f. apply nth_error_nth. rewrite nth_error_map, E. reflexivity. }
      rewrite !V. unfold own_part. destruct (snd h) as [os is] eqn:H. cbn [inner obliges].
      destruct is as [|x xs].
      + assert (D : chain_due r chi (Chain os []) = os) by (destruct r; reflexivity).
        rewrite D. split; [auto|]. intros [I|[j [h' [E' [J [F _]]]]]]; [exact I|].
        injection J as <-. rewrite E in E'. injection E' as <-. rewrite H in F.
        destruct (F eq_refl).
      + split.
        * intro I. right. exists m, h. rewrite H. repeat split; auto. discriminate.
        * intros [[]|[j [h' [E' [J [_ I]]]]]]. injection J as <-.
          rewrite E in E'. injection E' as <-. rewrite H in I. exact I. }
  rewrite Split. tauto.
Qed.

Theorem flatten_due r chi R k :
  In k (due r (flatten r R) chi) <-> In k (nested_due r chi R).
Proof.
  unfold flatten, nested_due. rewrite flatten_chain_due.
  destruct (chi (Occurs (nested_trigger R))), (satisfies chi (nested_guard R)); simpl;
    intuition discriminate.
Qed.

(** ** Definition 1 for nested rules is Definition 1 for the flat ones *)

Definition nested_models (r : reading) (G : list nested_rule) (v : atom -> bool) : Prop :=
  forall R, In R G -> forall l, In l (nested_due r (context_in v) R) -> true_in v l = true.

Theorem flatten_models r G v :
  models r (flat_map (flatten r) G) v <-> nested_models r G v.
Proof.
  rewrite (models_iff_due _ _ (context_in v)) by (intro; reflexivity). unfold nested_models. split.
  - intros H R I l L. apply H. apply flatten_due in L. apply in_due in L.
    destruct L as [Q [IQ D]]. apply in_due. exists Q. split; [|exact D].
    apply in_flat_map. eauto.
  - intros H l I. apply in_due in I. destruct I as [Q [IQ D]].
    apply in_flat_map in IQ. destruct IQ as [R [IR IQ]]. apply (H R IR).
    apply flatten_due, in_due. eauto.
Qed.

Theorem flatten_entails r G chi phi :
  entails r (flat_map (flatten r) G) chi phi <->
  forall v, agrees chi v -> nested_models r G v -> eval v phi = true.
Proof.
  unfold entails. split; intros H v A M; apply (H v A), flatten_models, M.
Qed.
