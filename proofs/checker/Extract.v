(** The checker as OCaml. Only booleans, options and lists become those of OCaml; numbers stay the inductive type that
    the theorem is about, so that nothing unproved takes the place of what was proved. *)

From Coq Require Import Extraction ExtrOcamlBasic.
From Checker Require Import Formula Checker.

Extraction Language OCaml.
Extraction "lrat.ml" check.
