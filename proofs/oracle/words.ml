(* Reads a line, word by word: numbers, names, formulas and what is made of them. Nothing here is proved. *)

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

let constraint_ () =
  match word () with
  | "E" -> Exclusive (several name)
  | "N" -> Never (formula atom ())
  | "A" -> Assume (formula fact ())
  | kind -> unreadable "%S is no constraint" kind

let reading () =
  match word () with
  | "cascade" -> Cascade
  | "priority" -> Priority
  | other -> unreadable "%S is no reading" other

let list show all = String.concat " " (List.map show all)
