(** The untimed definition of a conflict is the special case of the timed one: without
    windows, relations over time and chains, the conflicts are the minimal sets of rules
    whose clauses, decided in one context, oblige what the constraints rule out.

    In a context each rule that is triggered has one clause that decides, and every rule of
    a minimal set is triggered: a minimal set of rules is one of clauses decided at once. *)

From Coq Require Import List Bool PArith ZArith Lia Sorted.
From Sleec Require Import Model Evaluation Entailment Constraints Clashes Conflict.
From Traces Require Import Trace History Continuation Growth Situation Untimed.
Import ListNotations.
Local Open Scope Z_scope.

(** * The untimed definition *)

(** What [S] obliges in a context does not go with the constraints, and what remains without
    any one rule does. *)
Definition minimal_conflict (r : reading) (S : ruleset) (Ks : list constraint) (chi : context) : Prop :=
  conflicts r S Ks chi
  /\ forall one R other, S = one ++ R :: other -> compatible r (one ++ other) Ks chi.

Theorem minimal_conflict_decides r S Ks chi :
  minimal_conflict r S Ks chi -> forall R, In R S -> triggered chi R = true.
Proof.
  intros [C M] R I. destruct (in_split _ _ I) as [one [other E]]. apply not_false_is_true.
  intro N. apply C. assert (D : due r S chi = due r (one ++ other) chi).
  { rewrite E. unfold due. rewrite !flat_map_app. cbn [flat_map]. f_equal. unfold due_of at 1.
    rewrite N. reflexivity. }
  unfold compatible. rewrite D. exact (M _ _ _ E).
Qed.

Lemma compatible_fewer r S T Ks chi :
  incl T S -> compatible r S Ks chi -> compatible r T Ks chi.
Proof.
  intros I [v [A [T' R]]]. exists v. split; [exact A|]. split; [|exact R]. intros l L. apply T'.
  apply in_flat_map in L. destruct L as [Q [IQ L]]. apply in_flat_map. eauto.
Qed.

(** * One situation *)

(** An event triggers a rule without time, or its conditions name it. *)
Definition mentions_event (R : rule) (x : name) : Prop :=
  x = trigger R \/ In x (triggers_in (conditions_of R)).

Lemma concerns_timed R x : concerns (timed_of R) x <-> mentions_event R x.
Proof.
  unfold concerns, rule_events, mentions_event, timed_of, conditions_of, triggers_in.
  cbn [timed_trigger timed_guard timed_response chain_events flat_map].
  assert (E : flat_map response_events (timed_literals (default R)) = []).
  { unfold timed_literals. induction (default R); [reflexivity|exact IHl]. }
  assert (F : flat_map (fun h => events_in (fst h) ++ chain_events (snd h))
                (map (fun h => (hedge_condition h, TimedChain (timed_literals (hedge_obliges h)) []))
                     (hedges R))
              = flat_map events_in (map hedge_condition (hedges R))).
  { induction (hedges R) as [|h hs IH]; [reflexivity|]. cbn [map flat_map fst snd chain_events].
    rewrite IH. f_equal. rewrite app_nil_r.
    assert (G : flat_map response_events (timed_literals (hedge_obliges h)) = []).
    { unfold timed_literals. induction (hedge_obliges h); [reflexivity|exact IHl]. }
    rewrite G. apply app_nil_r. }
  rewrite E, F. reflexivity.
Qed.

Lemma responds_now r G Ks mere s e :
  responds (timed_ruleset_of r G Ks mere) s e ->
  exists now' later, e = past s ++ now' :: later /\ ordered e
    /\ same_inputs mere (context_of now') (context_of (now s)).
Proof.
  intros [now' [later [E [O [[_ [C [_ G']]] B]]]]]. exists now', later. split; [exact E|].
  split; [exact O|]. split; [|intro c; simpl; rewrite C; reflexivity]. intros x M. simpl.
  destruct (events (now s) x) eqn:X; [apply G', X|]. apply not_true_is_false. intro Y.
  destruct (B x Y) as [Z|Z]; [congruence|]. simpl in Z. congruence.
Qed.

Lemma can_comply_iff r G Ks mere S s :
  no_chains G Ks mere -> incl S G -> ordered (past s ++ [now s]) ->
  (forall i, In i (past s) -> kept_at r G Ks i) ->
  (forall x, events (now s) x = true -> mere x = true) ->
  possible Ks (context_of (now s)) = true ->
  can_comply (timed_ruleset_of r G Ks mere) (map timed_of S) s
  <-> compatible r S Ks (context_of (now s)).
Proof.
  intros N I O Past Inputs P. pose proof (chains_rules_over _ _ _ N) as NR.
  pose proof (chains_constraints_over _ _ _ N) as NK. split.
  - intros [e [Re H]]. destruct (responds_now _ _ _ _ _ _ Re) as [now' [later [E [Oe Same]]]].
    rewrite complies_iff in H by exact Oe.
    destruct (H now') as [_ [Q D]]; [rewrite E; apply in_elt|].
    apply (same_compatible mere r G S Ks (context_of now')); auto.
    exists (done_at now'). split; [intro f; reflexivity|auto].
  - intros [v [A [T Q]]].
    set (more := fun x => negb (mere x) && v (Done x)). set (now' := with_events (now s) more).
    assert (Same : same_inputs mere (context_of now') (context_of (now s))).
    { split; [|reflexivity]. intros x M. simpl. unfold more. rewrite M. apply orb_false_r. }
    assert (Acts : forall o, mere o = false -> events now' o = v (Done o)).
    { intros o M. simpl. unfold more. rewrite M. simpl.
      destruct (events (now s) o) eqn:X; [|reflexivity]. rewrite (Inputs o X) in M. discriminate. }
    assert (O' : ordered (past s ++ [now'])).
    { eapply ordered_grown; [exact O|apply with_events_grown]. }
    exists (past s ++ [now']). split.
    + exists now', []. split; [reflexivity|]. split; [exact O'|]. split; [apply with_events_grown|].
      cbn [mere_input timed_ruleset_of]. intros x X. simpl in X. apply orb_true_iff in X.
      destruct X as [X|X]; [auto|]. right. apply andb_true_iff in X. apply negb_true_iff, X.
    + apply complies_iff; [exact O'|]. intros i J. apply in_app_iff in J. destruct J as [J|[<-|[]]].
      * apply kept_at_fewer with G; auto.
      * split; [rewrite (same_possible mere Ks _ _ NK Same); exact P|]. split.
        -- intros k K. rewrite <- (Q k K). apply eval_on_atoms. intros [[x|c]|o] B.
           ++ change (context_of now' (Occurs x) = v (Fact (Occurs x))). rewrite A.
              apply (proj1 Same), (forbidden_mere _ _ _ N k x K B).
           ++ change (context_of now' (Holds c) = v (Fact (Holds c))). rewrite A.
              apply (proj2 Same).
           ++ apply Acts, (forbidden_act _ _ _ N k o K B).
        -- intros l L. rewrite (same_due mere r G S _ _ NR I Same) in L.
           pose proof (due_acts mere r G Ks S _ l N I L) as M. rewrite <- (T l L).
           destruct l as [o|o]; unfold true_in; cbn [formula_of eval];
             change (done_at now' (Done o)) with (events now' o); rewrite (Acts o M); reflexivity.
Qed.

Lemma situation_possible r G Ks mere S s :
  no_chains G Ks mere -> situation_for (timed_ruleset_of r G Ks mere) S s ->
  possible Ks (context_of (now s)) = true.
Proof.
  intros N Sit. destruct (relations_satisfiable _ _ _ Sit) as [e [Re H]].
  destruct (responds_now _ _ _ _ _ _ Re) as [now' [later [E [Oe Same]]]].
  rewrite <- (same_possible mere Ks _ _ (chains_constraints_over _ _ _ N) Same).
  change (@nil timed_rule) with (map timed_of []) in H. rewrite complies_iff in H by exact Oe.
  apply (H now'). rewrite E. apply in_elt.
Qed.

Theorem conflict_in_situation r G Ks mere S s :
  no_chains G Ks mere -> incl S G ->
  situation_for (timed_ruleset_of r G Ks mere) (map timed_of S) s ->
  in_conflict (timed_ruleset_of r G Ks mere) (map timed_of S) s
  <-> minimal_conflict r S Ks (context_of (now s)).
Proof.
  intros N I Sit.
  assert (Inputs : forall x, events (now s) x = true -> mere x = true).
  { intros x X. destruct (inputs_concern _ _ _ Sit x X) as [_ [R' [J T]]].
    apply in_map_iff in J. destruct J as [R [<- J]].
    apply (triggers_mere _ _ _ N R x (I R J)), concerns_timed, T. }
  pose proof (situation_possible _ _ _ _ _ _ N Sit) as P.
  pose proof (in_order _ _ _ Sit) as O.
  pose proof (lawful_kept _ _ _ _ _ O (is_lawful _ _ _ Sit)) as Past.
  assert (C : forall T, incl T S -> can_comply (timed_ruleset_of r G Ks mere) (map timed_of T) s
                                    <-> compatible r T Ks (context_of (now s))).
  { intros T J. apply can_comply_iff; auto. intros R IR. apply I, J, IR. }
  assert (Less : forall (one : ruleset) R other, S = one ++ R :: other -> incl (one ++ other) S).
  { intros one R other -> Q J. apply in_app_iff in J. apply in_app_iff. simpl. tauto. }
  unfold in_conflict, minimal_conflict, conflicts. split.
  - intros [_ [_ [X M]]]. rewrite (C S (incl_refl S)) in X. split; [exact X|].
    intros one R other E. apply C; [exact (Less _ _ _ E)|]. rewrite map_app.
    apply (M (map timed_of one) (timed_of R) (map timed_of other)).
    rewrite E, map_app. reflexivity.
  - intros [X M]. split; [apply incl_map, I|]. split; [exact Sit|].
    split; [rewrite (C S (incl_refl S)); exact X|]. intros one' R' other' E.
    apply map_eq_app in E. destruct E as [one [rest [E [<- E']]]].
    apply map_eq_cons in E'. destruct E' as [R [other [-> [<- <-]]]].
    rewrite <- map_app. apply C; [exact (Less _ _ _ E)|]. exact (M _ _ _ E).
Qed.

(** * All of them *)

(** A context in which rules are in conflict is a situation without a history. *)
Lemma context_is_situation r G Ks mere S i :
  no_chains G Ks mere -> incl S G -> S <> [] ->
  possible Ks (context_of i) = true ->
  (forall x, events i x = true -> exists R, In R S /\ mentions_event R x) ->
  minimal_conflict r S Ks (context_of i) ->
  situation_for (timed_ruleset_of r G Ks mere) (map timed_of S) (AtNow [] i).
Proof.
  intros N I Ne P T M. constructor; cbn [past now].
  - repeat constructor.
  - intros earlier j later k E. destruct earlier; discriminate E.
  - intros x X. destruct (T x X) as [R [J Q]]. split.
    + left. exact (triggers_mere _ _ _ N R x (I R J) Q).
    + exists (timed_of R). split; [apply in_map, J|]. apply concerns_timed, Q.
  - destruct S as [|R S]; [congruence|]. exists (timed_of R). split; [simpl; auto|].
    apply (minimal_conflict_decides _ _ _ _ M R). simpl. auto.
  - intros j R [].
  - change (@nil timed_rule) with (map timed_of []). apply can_comply_iff; cbn [past now]; auto.
    + intros R [].
    + repeat constructor.
    + intros j [].
    + intros x X. destruct (T x X) as [R [J Q]]. exact (triggers_mere _ _ _ N R x (I R J) Q).
    + destruct M as [_ M]. destruct S as [|R S]; [congruence|].
      apply compatible_fewer with S; [intros Q []|exact (M [] R S eq_refl)].
Qed.

Theorem untimed_conflicts r G Ks mere S :
  no_chains G Ks mere -> incl S G -> S <> [] ->
  (exists s, in_conflict (timed_ruleset_of r G Ks mere) (map timed_of S) s) <->
  (exists chi, possible Ks chi = true
               /\ (forall x, chi (Occurs x) = true -> exists R, In R S /\ mentions_event R x)
               /\ minimal_conflict r S Ks chi).
Proof.
  intros N I Ne. split.
  - intros [s C]. pose proof (proj1 (proj2 C)) as Sit. exists (context_of (now s)). split; [|split].
    + exact (situation_possible _ _ _ _ _ _ N Sit).
    + intros x X. destruct (inputs_concern _ _ _ Sit x X) as [_ [R' [J T]]].
      apply in_map_iff in J. destruct J as [R [<- J]]. apply concerns_timed in T. eauto.
    + apply (conflict_in_situation r G Ks mere S s N I Sit), C.
  - intros [chi [P [T M]]].
    set (i := Instant 0 (fun x => chi (Occurs x)) (fun c => chi (Holds c)) (fun _ => 0)).
    assert (E : forall f, chi f = context_of i f) by (intros [x|c]; reflexivity).
    assert (Same : same_inputs (fun _ => true) chi (context_of i)) by (split; reflexivity).
    assert (Cs : forall T, compatible r T Ks chi <-> compatible r T Ks (context_of i)).
    { intro U. split; apply (same_compatible (fun _ => true) r U U);
        try (intros ? ? ? ?; reflexivity); try apply incl_refl; split; reflexivity. }
    assert (M' : minimal_conflict r S Ks (context_of i)).
    { destruct M as [X M]. split; [intro Y; apply X, Cs, Y|]. intros one R other F. apply Cs, (M _ _ _ F). }
    assert (Sit : situation_for (timed_ruleset_of r G Ks mere) (map timed_of S) (AtNow [] i)).
    { apply context_is_situation; auto. rewrite <- (possible_ext Ks chi _ E). exact P. }
    exists (AtNow [] i). apply conflict_in_situation; auto.
Qed.

(** Other triggers may occur, too, if no constraint names them. *)
Theorem other_triggers r S Ks chi :
  let own := fun x => existsb (fun R => existsb (Pos.eqb x) (trigger R :: triggers_in (conditions_of R))) S in
  constraints_over own Ks ->
  possible Ks chi = true -> minimal_conflict r S Ks chi ->
  exists psi, possible Ks psi = true
              /\ (forall x, psi (Occurs x) = true -> exists R, In R S /\ mentions_event R x)
              /\ minimal_conflict r S Ks psi.
Proof.
  intros own NK P [C M].
  assert (Own : forall x, own x = true <-> exists R, In R S /\ mentions_event R x).
  { intro x. unfold own. rewrite existsb_exists. split; intros [R [I H]]; exists R; (split; [exact I|]).
    - apply existsb_exists in H. destruct H as [y [Y H]]. apply Pos.eqb_eq in H. subst y.
      destruct Y as [<-|Y]; [left; reflexivity|right; exact Y].
    - apply existsb_exists. exists x. rewrite Pos.eqb_refl. split; [|reflexivity].
      destruct H as [->|H]; [left; reflexivity|right; exact H]. }
  assert (NR : rules_over own S) by (intros R x I H; apply Own; exists R; auto).
  set (psi := fun f => match f with Occurs x => chi f && own x | Holds _ => chi f end).
  assert (E : same_inputs own chi psi).
  { split; [|reflexivity]. intros x X. simpl. rewrite X, andb_true_r. reflexivity. }
  assert (E' : same_inputs own psi chi) by (split; intros; symmetry; apply E; assumption).
  exists psi. split; [|split; [|split]].
  - rewrite <- (same_possible own Ks _ _ NK E). exact P.
  - intros x X. simpl in X. apply andb_true_iff in X. apply Own, X.
  - intro X. apply C. exact (same_compatible own r S S Ks _ _ NR NK (incl_refl S) E' X).
  - intros one R other F. apply (same_compatible own r S (one ++ other) Ks chi); auto.
    + intros Q J. rewrite F. apply in_app_iff in J. apply in_app_iff. simpl. tauto.
    + exact (M _ _ _ F).
Qed.
