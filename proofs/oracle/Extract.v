(** The oracle as OCaml.  Only booleans, options, lists and pairs become those of OCaml;
    numbers stay the inductive types that the theorems are about. *)

From Coq Require Import Extraction ExtrOcamlBasic.
From Sleec Require Import Model Evaluation Entailment Nested Constraints Conflict.
From Traces Require Import Trace History.
From Oracle Require Import Certified Findings.

Extraction Language OCaml.
Extraction "oracle.ml"
  flatten all_due triggered algorithm_1 due contradictory
  entails_by_propagation entails_by_table formula_of
  possible compatible_by_table ask
  broken broken_so_far comes_about.
