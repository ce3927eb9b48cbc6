(* Reads questions, one per line, and answers each on one line, by functions that are proved in Coq.

   This file is not proved. It must read rules and contexts correctly. To trust an answer, you need to read this file,
   words.ml, and sleec_verify/certificates/theory, which writes the questions. Questions about traces are in traces.ml.
   How the file reads the steps of a refutation does not matter.

   Names are numbers from 1, separately for each kind. The notation is prefix notation without parentheses:

     FORMULA  1 | 0 | t N | c N | o N | ! FORMULA | & FORMULA FORMULA | \| FORMULA FORMULA     trigger, condition, obligation
     LITERAL  N | -N                                                   an obligation, or that it is forbidden
     CHAIN    count LITERAL…  count (FORMULA CHAIN)…                   what is obliged, and the hedges
     RULE     N N FORMULA CHAIN                                        label, trigger, guard
     CONSTRAINT  E count N… | N FORMULA | A FORMULA                    EXCLUSIVE, NEVER, ASSUME

     rules cascade|priority count-of-obligations  count RULE…  count CONSTRAINT…      what follows is asked of these; ok
     at count FACT…            the facts (t N, c N) that are true; the others are false
       possible 0|1; consistent 0|1; due LITERAL…; entailed LITERAL…; said WHICH…
                               WHICH: of each rule that has no chain in a chain, - (not triggered), e (ε) or the hedge
     table count FACT…         by definition, over all interpretations: possible 0|1; compatible 0|1; entailed LITERAL…
     formula QUESTION          its formula, which is unsatisfiable exactly if the answer is no: LITERAL… 0 LITERAL… 0 …
                               QUESTION: conflict (does some context?) | reading (does some rule depend on it?)
                               | findings count FINDING… (is one of them false?)
                               FINDING: dead-rule N | dead-hedge N I | redundant-rule N count N…
                               | redundant-hedge N I count N… | vacuous-conflict N count N… count I… | assumptions
                               N is a label, I the number of a hedge; then the rules that are to suffice, and, by their
                               places from 0, the constraints
     refuted STEP…             yes if these steps refute the formula that was asked for last, no if not
                               STEP: a N LITERAL… 0 N… 0 (clause N follows from those clauses) | d N… 0 (forget them)

   UNREADABLE: reason, exit 2, where a line is not of this kind. *)

open Oracle
open Words

let rec chain () =
  let obliged = several literal in
  Chain (obliged, several hedge)

and hedge () =
  let when_ = formula fact () in
  (when_, chain ())

let rule () =
  let nested_label = name () in
  let nested_trigger = name () in
  let nested_guard = formula fact () in
  { nested_label; nested_trigger; nested_guard; response = chain () }

type asked = {
  reading : reading;
  literals : literal list;  (* all that there can be, positive ones first *)
  rules : nested_rule list;
  constraints : constraint0 list;
}

let ruleset () =
  let reading = reading () in
  let obligations = List.init (integer ()) (fun place -> positive (place + 1)) in
  let literals = List.map (fun o -> Do o) obligations @ List.map (fun o -> Avoid o) obligations in
  let rules = several rule in
  { reading; literals; rules; constraints = several constraint_ }

let context () =
  let one () =
    let kind = word () in
    fact kind (name ())
  in
  let true_ = Hashtbl.create 16 in
  List.iter (fun f -> Hashtbl.replace true_ f ()) (several one);
  fun f -> Hashtbl.mem true_ f

let shown = function Do o -> string_of_int (int_of o) | Avoid o -> string_of_int (-int_of o)
let bit b = if b then 1 else 0

(* One of the theory's rules, if there is no chain in a chain. *)
let flat_one reading rule =
  match flatten reading rule with
  | [ flat ] -> Some flat
  | _ -> None

let at { reading; literals; rules; constraints } chi =
  let all = List.concat_map (flatten reading) rules in
  let said rule =
    if not (triggered chi rule) then "-"
    else
      match algorithm_1 reading chi rule with
      | None -> "e"
      | Some layer -> string_of_int (int_of_nat layer)
  in
  Printf.sprintf "possible %d; consistent %d; due %s; entailed %s; said %s"
    (bit (possible constraints chi))
    (bit (not (contradictory (due reading all chi))))
    (list shown (all_due reading chi rules))
    (list shown (List.filter (entails_by_propagation reading all chi) literals))
    (list said (List.filter_map (flat_one reading) rules))

let table { reading; literals; rules; constraints } chi =
  let all = List.concat_map (flatten reading) rules in
  let entailed l = entails_by_table reading all chi (formula_of l) in
  Printf.sprintf "possible %d; compatible %d; entailed %s"
    (bit (possible constraints chi))
    (bit (compatible_by_table reading all constraints chi))
    (list shown (List.filter entailed literals))

let clauses formula =
  let text = Buffer.create 65536 in
  let say number = Buffer.add_string text (string_of_int number); Buffer.add_char text ' ' in
  let literal = function Pos x -> say (int_of x) | Neg x -> say (-int_of x) in
  List.iter (fun clause -> List.iter literal clause; say 0) formula;
  Buffer.contents text

let steps () =
  let rec until_zero found =
    match integer () with
    | 0 -> List.rev found
    | number -> until_zero (number :: found)
  in
  let in_proof number = if number > 0 then Pos (positive number) else Neg (positive (-number)) in
  let rec take found =
    if at_end () then List.rev found
    else
      match word () with
      | "a" ->
        let number = name () in
        let clause = List.map in_proof (until_zero []) in
        take (Add (number, clause, List.map positive (until_zero [])) :: found)
      | "d" -> take (Forget (List.map positive (until_zero [])) :: found)
      | kind -> unreadable "%S is no step" kind
  in
  take []

let verdict accepted = if accepted then "yes" else "no"

let rec nat_of number = if number = 0 then O else S (nat_of (number - 1))

(* The place of something in a text: none is so long that it has more. *)
let place_in_text () =
  let number = integer () in
  if number < 0 || number > 1_000_000 then unreadable "%d is no place in a text" number;
  nat_of number

let finding () =
  match word () with
  | "dead-rule" -> DeadRule (name ())
  | "dead-hedge" ->
    let rule = name () in
    DeadHedge (rule, place_in_text ())
  | "redundant-rule" ->
    let rule = name () in
    RedundantRule (rule, several name)
  | "redundant-hedge" ->
    let rule = name () in
    let hedge = place_in_text () in
    RedundantHedge (rule, hedge, several name)
  | "vacuous-conflict" ->
    let rule = name () in
    let meeting = several name in
    VacuousConflict (rule, meeting, several place_in_text)
  | "assumptions" -> NoSituation
  | other -> unreadable "%S is no finding" other

let question () =
  match word () with
  | "conflict" -> AnyConflict
  | "reading" -> AnyReading
  | "findings" -> AnyFalse (several finding)
  | other -> unreadable "%S is no question" other

(* The rules, and what judges refutations of the formula that was asked for last. *)
let asked : asked option ref = ref None
let judge : (step list -> bool) option ref = ref None

let of_rules f =
  match !asked with
  | Some known -> f known
  | None -> unreadable "a question before the rules"

(* The laws and the last trace of the questions about traces. *)
let laws : Traces.asked option ref = ref None
let trace : instant list ref = ref []

let of_laws f =
  match !laws with
  | Some known -> f known
  | None -> unreadable "a question before the laws"

let answer () =
  match word () with
  | "laws" ->
    laws := Some (Traces.laws ());
    trace := [];
    "ok"
  | "trace" ->
    of_laws (fun known ->
        trace := several Traces.instant;
        Traces.judged known !trace)
  | "claims" -> of_laws (fun known -> verdict (Traces.come_about known !trace (several Traces.claim)))
  | "rules" ->
    asked := Some (ruleset ());
    judge := None;
    "ok"
  | "at" -> of_rules (fun known -> at known (context ()))
  | "table" -> of_rules (fun known -> table known (context ()))
  | "formula" ->
    of_rules (fun { reading; rules; constraints; _ } ->
        let formula, judges = ask reading rules constraints (question ()) in
        judge := Some judges;
        clauses formula)
  | "refuted" -> (
    match !judge with
    | Some accepts -> verdict (accepts (steps ()))
    | None -> unreadable "steps before a formula")
  | other -> unreadable "%S is no question" other

let () =
  (* Most of what is made is there to the end, and no time goes into looking for what is not. *)
  Gc.set { (Gc.get ()) with Gc.minor_heap_size = 1 lsl 20; space_overhead = 1000 };
  try
    while true do
      line := input_line stdin;
      place := 0;
      let said = answer () in
      if not (at_end ()) then unreadable "something follows the question";
      print_endline said
    done
  with
  | End_of_file -> ()
  (* What is extracted walks lists as they are written down, not from the left. *)
  | Stack_overflow ->
    print_endline "UNREADABLE: the rules are more than the stack holds (ulimit -s)";
    exit 2
  | Unreadable reason ->
    Printf.printf "UNREADABLE: %s\n" reason;
    exit 2
