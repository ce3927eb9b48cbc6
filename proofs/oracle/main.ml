(* Reads questions, a line each, and has what is proved in Coq answer them, a line each.

   What is here is not proved. It must read rules and contexts as they are meant: whoever doubts an answer has this file
   to read, and sleec_verify/theory, which writes the questions. How it reads the steps of a refutation does not matter.

   Names are numbers from 1, each kind by itself; everything is written before what it is made of, with no parentheses:

     FORMULA  1 | 0 | t N | c N | o N | ! FORMULA | & FORMULA FORMULA | \| FORMULA FORMULA     trigger, condition, obligation
     LITERAL  N | -N                                                   an obligation, or that it is forbidden
     CHAIN    count LITERAL…  count (FORMULA CHAIN)…                   what is obliged, and the hedges
     RULE     N N FORMULA CHAIN                                        label, trigger, guard
     CONSTRAINT  E count N… | N FORMULA | A FORMULA                    EXCLUSIVE, NEVER, ASSUME

     rules cascade|priority count-of-obligations  count RULE…  count CONSTRAINT…      what follows is asked of these; ok
     at count FACT…            the facts (t N, c N) that are true; the others are false
       possible 0|1; consistent 0|1; due LITERAL…; entailed LITERAL…; said WHICH…
                               WHICH: of each rule that has no chain in a chain, - (not triggered), e (ε) or the hedge
     table count FACT…         to the letter, by all interpretations: possible 0|1; compatible 0|1; entailed LITERAL…
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

exception Unreadable of string

let unreadable format = Printf.ksprintf (fun text -> raise (Unreadable text)) format

(* Numbers as Coq has them. Each is made once, so that a name costs its memory once. *)
let made : (int, positive) Hashtbl.t = Hashtbl.create 4096

let rec positive_of number =
  if number = 1 then XH
  else if number land 1 = 1 then XI (positive_of (number lsr 1))
  else XO (positive_of (number lsr 1))

let positive number =
  if number < 1 then unreadable "%d is not a number from 1 on" number;
  match Hashtbl.find_opt made number with
  | Some known -> known
  | None ->
    let fresh = positive_of number in
    Hashtbl.add made number fresh;
    fresh

let rec int_of = function XH -> 1 | XO rest -> 2 * int_of rest | XI rest -> (2 * int_of rest) + 1
let rec int_of_nat = function O -> 0 | S n -> 1 + int_of_nat n

(* One line, and how far it is read. A line may have millions of words, which are never all there at once. *)
let line = ref "" and place = ref 0

let at_end () =
  while !place < String.length !line && !line.[!place] = ' ' do incr place done;
  !place = String.length !line

let word () =
  if at_end () then unreadable "the line ends too early";
  let start = !place in
  while !place < String.length !line && !line.[!place] <> ' ' do incr place done;
  String.sub !line start (!place - start)

(* Digits only, and few enough to be a number here. OCaml's own conversion also takes 0x10, 1_000 and the like. *)
let number text =
  let first = if text <> "" && text.[0] = '-' then 1 else 0 in
  let digits = String.length text - first and value = ref 0 in
  if digits = 0 || digits > 17 then unreadable "%S is not a number" text;
  for i = first to String.length text - 1 do
    match text.[i] with
    | '0' .. '9' as digit -> value := (10 * !value) + Char.code digit - Char.code '0'
    | _ -> unreadable "%S is not a number" text
  done;
  if first = 1 then - !value else !value

let integer () = number (word ())
let name () = positive (integer ())

let several read =
  let count = integer () in
  if count < 0 then unreadable "%d is no count" count;
  let rec take left found = if left = 0 then List.rev found else take (left - 1) (read () :: found) in
  take count []

let rec formula atom () =
  match word () with
  | "1" -> Truth true
  | "0" -> Truth false
  | "!" -> Not (formula atom ())
  | "&" ->
    let left = formula atom () in
    And (left, formula atom ())
  | "|" ->
    let left = formula atom () in
    Or (left, formula atom ())
  | kind -> Atom (atom kind (name ()))

let condition kind number = if kind = "c" then number else unreadable "%S in a condition" kind

let fact kind number =
  match kind with
  | "t" -> Occurs number
  | "c" -> Holds number
  | _ -> unreadable "%S where only triggers and conditions can be" kind

let atom kind number = if kind = "o" then Done number else Fact (fact kind number)

let literal () =
  let number = integer () in
  if number > 0 then Do (positive number) else Avoid (positive (-number))

let rec chain () =
  let obliged = several literal in
  Chain (obliged, several hedge)

and hedge () =
  let when_ = formula condition () in
  (when_, chain ())

let rule () =
  let nested_label = name () in
  let nested_trigger = name () in
  let nested_guard = formula condition () in
  { nested_label; nested_trigger; nested_guard; response = chain () }

let constraint_ () =
  match word () with
  | "E" -> Exclusive (several name)
  | "N" -> Never (formula atom ())
  | "A" -> Assume (formula fact ())
  | kind -> unreadable "%S is no constraint" kind

type asked = {
  reading : reading;
  literals : literal list;  (* all that there can be, positive ones first *)
  rules : nested_rule list;
  constraints : constraint0 list;
}

let ruleset () =
  let reading =
    match word () with
    | "cascade" -> Cascade
    | "priority" -> Priority
    | other -> unreadable "%S is no reading" other
  in
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
let list show all = String.concat " " (List.map show all)
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

let answer () =
  match word () with
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
