(* Reads a formula in DIMACS and a refutation in LRAT, and runs the checker that is proved correct.

   This file is not proved. It must read the formula as DIMACS means it. To trust the answer, you need to read this file
   and to trust Coq. How it reads the refutation does not matter: no refutation of a satisfiable formula is accepted.

   check-lrat FORMULA.cnf PROOF.lrat
     VERIFIED            exit 0: the formula is unsatisfiable
     REFUSED: reason     exit 1: the proof shows nothing
     UNREADABLE: reason  exit 2: a file cannot be read, or is not in its format *)

open Lrat

exception Unreadable of string

let unreadable place format = Printf.ksprintf (fun text -> raise (Unreadable (place ^ ": " ^ text))) format

(* Numbers of DIMACS as Coq has them. Each is made once, so that a variable costs its memory once. *)
let made : (int, positive) Hashtbl.t = Hashtbl.create 4096

let rec positive_of number =
  if number = 1 then XH
  else if number land 1 = 1 then XI (positive_of (number lsr 1))
  else XO (positive_of (number lsr 1))

let positive number =
  match Hashtbl.find_opt made number with
  | Some known -> known
  | None ->
    let fresh = positive_of number in
    Hashtbl.add made number fresh;
    fresh

let rec int_of = function XH -> 1 | XO rest -> 2 * int_of rest | XI rest -> (2 * int_of rest) + 1

let literal number = if number > 0 then Pos (positive number) else Neg (positive (-number))

let lines path =
  let channel = try open_in_bin path with Sys_error reason -> raise (Unreadable reason) in
  let rec next number () =
    match input_line channel with
    | line -> Seq.Cons ((number, line), next (number + 1))
    | exception End_of_file ->
      close_in channel;
      Seq.Nil
    | exception Sys_error reason -> unreadable path "%s" reason
  in
  next 1

(* A clause may be longer than the stack is deep. *)
let map f list = List.rev (List.rev_map f list)

let words line = List.filter (fun word -> word <> "") (String.split_on_char ' ' (String.trim line))

(* Digits only, and few enough to be a number here. OCaml's own conversion also takes 0x10, 1_000 and the like. *)
let integer place word =
  let digits = if word <> "" && word.[0] = '-' then String.sub word 1 (String.length word - 1) else word in
  let is_digit = function '0' .. '9' -> true | _ -> false in
  if digits = "" || String.length digits > 17 || not (String.for_all is_digit digits) then
    unreadable place "%S is not a number" word;
  int_of_string word

(* The numbers before the 0, and what follows it. *)
let rec until_zero place found = function
  | [] -> unreadable place "the line does not end in 0"
  | 0 :: rest -> (List.rev found, rest)
  | number :: rest -> until_zero place (number :: found) rest

let at path number = Printf.sprintf "%s:%d" path number

(* One clause a line, as certificates have it, after one line "p cnf variables clauses" whose counts must be right. *)
let formula path =
  let header = ref None and count = ref 0 and found = ref [] in
  let read (number, line) =
    let place = at path number in
    match words line with
    | [] -> ()
    | "c" :: _ -> ()
    | [ "p"; "cnf"; variables; clauses ] when !header = None ->
      header := Some (integer place variables, integer place clauses)
    | "p" :: _ -> unreadable place "this header is not the one line \"p cnf variables clauses\""
    | row ->
      (match !header with
       | None -> unreadable place "a clause before the header"
       | Some (variables, _) ->
         let clause, rest = until_zero place [] (map (integer place) row) in
         if rest <> [] then unreadable place "more than one clause in a line";
         List.iter (fun l -> if abs l > variables then unreadable place "the header says there is no variable %d" (abs l)) clause;
         incr count;
         found := map literal clause :: !found)
  in
  Seq.iter read (lines path);
  match !header with
  | None -> unreadable path "there is no header \"p cnf variables clauses\""
  | Some (_, clauses) when clauses <> !count -> unreadable path "the header says %d clauses, and there are %d" clauses !count
  | Some _ -> List.rev !found

let number place n = if n > 0 then positive n else unreadable place "%d is no number of a clause" n

let steps path =
  let read (line_number, line) =
    let place = at path line_number in
    match words line with
    | [] | "c" :: _ -> None
    | _ :: "d" :: rest ->
      let numbers, rest = until_zero place [] (map (integer place) rest) in
      if rest <> [] then unreadable place "something follows the 0";
      Some (Forget (map (number place) numbers))
    | first :: rest ->
      let clause, rest = until_zero place [] (map (integer place) rest) in
      let hints, rest = until_zero place [] rest in
      if rest <> [] then unreadable place "something follows the last 0";
      List.iter (fun hint -> if hint < 0 then unreadable place "a RAT step, which this checker does not know") hints;
      Some (Add (number place (integer place first), map literal clause, map (number place) hints))
  in
  List.of_seq (Seq.filter_map read (lines path))

let () =
  (* Most of what is made is there to the end, and no time goes into looking for what is not. *)
  Gc.set { (Gc.get ()) with Gc.minor_heap_size = 1 lsl 20; space_overhead = 1000 };
  match Sys.argv with
  | [| _; formula_path; proof_path |] ->
    (match check (formula formula_path) (steps proof_path) with
     | Verified -> print_endline "VERIFIED"
     | Refused n ->
       Printf.printf "REFUSED: clause %d does not follow from its hints\n" (int_of n);
       exit 1
     | Unfinished ->
       print_endline "REFUSED: the proof ends before the empty clause";
       exit 1
     | exception Unreadable reason ->
       Printf.printf "UNREADABLE: %s\n" reason;
       exit 2)
  | _ ->
    prerr_endline "check-lrat FORMULA.cnf PROOF.lrat";
    exit 2
