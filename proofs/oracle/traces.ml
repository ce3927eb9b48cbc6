(* Questions about traces: laws with time, what a trace breaks, and the claims that it brings about.

   Names of events, conditions and measures are numbers from 1, each kind by itself: t N and o N are one event. Times are
   whole seconds. The rest is written as in main.ml.

     BOUND     s SECONDS | m N                                 a measure says how long
     WINDOW    - | w BOUND BOUND | e BOUND                     none; from and to; from
     RESPONSE  LITERAL WINDOW count (otherwise CHAIN | else CHAIN)…
     CHAIN     count RESPONSE…  count (FORMULA CHAIN)…
     LAW       rule N FORMULA CHAIN                            trigger, guard
               | witness N N | equal N N | exclusive N N | before N N
               | imply FORMULA FORMULA | iff FORMULA FORMULA | not-both FORMULA FORMULA | invariant FORMULA
               | causation N FORMULA | includes N FORMULA | forbid N FORMULA
               | until N FORMULA FORMULA N FORMULA | for N FORMULA FORMULA BOUND
               | stated CONSTRAINT
     CLAIM     N FORMULA count CHAIN…                          event, condition, responses
     INSTANT   SECONDS count N… count N… count (N SECONDS)…    the events, the true conditions, the measures

     laws cascade|priority at|eventually  count LAW…           what follows is asked of these; ok
     trace count INSTANT…                                      broken PLACE…; so-far PLACE…
                               PLACE: I.K, law K is broken at instant I, both from 0
     claims count CLAIM…       whether the last trace brings all of them about: yes | no *)

open Oracle
open Words

let seconds () =
  let number = integer () in
  if number = 0 then Z0 else if number > 0 then Zpos (positive number) else Zneg (positive (-number))

let bound () =
  match word () with
  | "s" -> Seconds (seconds ())
  | "m" -> Measured (name ())
  | kind -> unreadable "%S is no bound" kind

let window () =
  match word () with
  | "-" -> None
  | "w" ->
    let opens = bound () in
    Some { opens; closes = Some (bound ()) }
  | "e" -> Some { opens = bound (); closes = None }
  | kind -> unreadable "%S is no window" kind

let facts () = formula fact ()
let condition () = formula condition ()

let rec response () =
  let obliged = literal () in
  let due = window () in
  Response (obliged, due, several alternative)

and alternative () =
  match word () with
  | "otherwise" -> (Otherwise, chain ())
  | "else" -> (Else, chain ())
  | kind -> unreadable "%S is no alternative" kind

and chain () =
  let all = several response in
  TimedChain (all, several hedge)

and hedge () =
  let when_ = facts () in
  (when_, chain ())

let two read make =
  let first = read () in
  make first (read ())

let of_event make =
  let event = name () in
  make event (condition ())

let law () =
  let relation rel = RelationLaw rel in
  match word () with
  | "rule" ->
    let timed_trigger = name () in
    let timed_guard = facts () in
    RuleLaw { timed_trigger; timed_guard; timed_response = chain () }
  | "witness" -> relation (two name (fun a b -> Witness (a, b)))
  | "equal" -> relation (two name (fun a b -> Equal (a, b)))
  | "exclusive" -> relation (two name (fun a b -> MutuallyExclusive (a, b)))
  | "before" -> relation (two name (fun a b -> HappenBefore (a, b)))
  | "imply" -> relation (two condition (fun p q -> Imply (p, q)))
  | "iff" -> relation (two condition (fun p q -> Iff (p, q)))
  | "not-both" -> relation (two condition (fun p q -> NotBoth (p, q)))
  | "invariant" -> relation (Invariant (condition ()))
  | "causation" -> relation (of_event (fun e p -> Causation (e, p)))
  | "includes" -> relation (of_event (fun e p -> Includes (e, p)))
  | "forbid" -> relation (of_event (fun e p -> Forbid (e, p)))
  | "until" ->
    let event = name () in
    let when_ = condition () in
    let lasting = condition () in
    let stop = name () in
    relation (Until (event, when_, lasting, stop, condition ()))
  | "for" ->
    let event = name () in
    let when_ = condition () in
    let lasting = condition () in
    relation (For (event, when_, lasting, bound ()))
  | "stated" -> relation (Stated (constraint_ ()))
  | kind -> unreadable "%S is no law" kind

let claim () =
  let claimed_event = name () in
  let claimed_condition = facts () in
  { claimed_event; claimed_condition; claimed_responses = several chain }

let member names =
  let known = Hashtbl.create 16 in
  List.iter (fun one -> Hashtbl.replace known one ()) names;
  Hashtbl.mem known

let instant () =
  let time = seconds () in
  let events = member (several name) in
  let conditions0 = member (several name) in
  let measured = several (fun () -> let measure = name () in (measure, seconds ())) in
  { time; events; conditions0; lengths = (fun m -> try List.assoc m measured with Not_found -> Z0) }

type asked = { reading : reading; untimed : untimed; laws : law list }

let laws () =
  let reading = reading () in
  let untimed =
    match word () with
    | "at" -> At
    | "eventually" -> Eventually
    | other -> unreadable "%S is no meaning of a response without a window" other
  in
  { reading; untimed; laws = several law }

let places broken =
  let of_instant i laws = List.mapi (fun k is_broken -> if is_broken then [ Printf.sprintf "%d.%d" i k ] else []) laws in
  list Fun.id (List.concat (List.concat (List.mapi of_instant broken)))

let judged { reading; untimed; laws } trace =
  Printf.sprintf "broken %s; so-far %s"
    (places (broken reading untimed laws trace))
    (places (broken_so_far reading untimed laws trace))

let come_about { reading; untimed; _ } trace claims = comes_about reading untimed trace claims
