(** No context of hospital-ward.sleec conflicts.

    A comparison of a measure is a condition here, as in `certificates.theory.boolean`;
    what is assumed of the order of these is true of all values.

    Written by `make theorems`; do not edit. *)

From Coq Require Import List PArith.
From Sleec Require Import Model Nested Constraints.
From Checker Require Import Formula Checker.
From Oracle Require Import Certified.
Import ListNotations.
Local Open Scope positive_scope.

(** The rules.

    triggers: 1 PatientApproached, 2 AddressingPatient, 3 ExplainingProcedure,
      4 DiagnosisAsked, 5 DistressNoticed, 6 MedicationHandover, 7 MedicationRefused,
      8 DrinkRequested, 9 MealRound, 10 PainReported, 11 ObservationsDue,
      12 ObservationsTaken, 13 TemperatureTaken, 14 FallDetected, 15 PatientStandsUp,
      16 WalkRequested, 17 PatientLeavesWard, 18 RestraintRequested, 19 RoomEntryNeeded,
      20 RoomLeft, 21 PreparingExamination, 22 PersonalCareStarts, 23 PhotoRequested,
      24 VisitorArrives, 25 VisitorAsksForPatient, 26 PatientDischarged, 27 NightRound,
      28 AnnouncementDue, 29 SpillSeen, 30 LiftNeeded, 31 FireAlarm, 32 StaffSaysStop,
      33 BatteryChecked, 34 SelfTestFails
    conditions: 1 PatientAsleep, 2 PatientInNeed, 3 PreferredNameKnown,
      4 NeedsInterpreter, 5 WantsToBeAlone, 6 SelfHarmRisk, 7 IdentityConfirmed,
      8 AllergyToMedication, 9 LacksCapacity, 10 NilByMouth, 11 SwallowingRisk,
      12 AllergyToMeal, 13 PainScore < 4, 14 PainScore < 7, 15 EarlyWarningScore < 5,
      16 EarlyWarningScore < 7, 17 Temperature < 38, 18 Temperature < 35,
      19 PatientResponsive, 20 FallRisk < high, 21 FallRisk < moderate, 22 Halted,
      23 MaySafelyLeave, 24 ExaminationInProgress, 25 PersonalCareOngoing,
      26 InIsolation, 27 PatientAge < 18, 28 PhotoConsent < written,
      29 OutsideVisitingHours, 30 NoVisitorsWanted, 31 PatientDying, 32 VisitorListed,
      33 IncidentUnderReview, 34 QuietHours, 35 BodyFluid, 36 LiftReserved,
      37 SupportsPatient, 38 BatteryPercent < 20
    obligations: 1 GreetPatient, 2 SayItIsARobot, 3 LeaveQuietly, 4 UseFullName,
      5 UsePreferredName, 6 ExplainInPlainWords, 7 CallInterpreter,
      8 PostponeExplanation, 9 ReferToDoctor, 10 TellDiagnosis, 11 ComfortPatient,
      12 InformNurse, 13 CallNurse, 14 StayWithPatient, 15 HandOverMedication,
      16 HoldMedication, 17 RecordRefusal, 18 PersuadePatient, 19 OfferDrink,
      20 ExplainWhy, 21 OfferMeal, 22 RecordPain, 23 AskConsent,
      24 PostponeObservations, 25 RecordObservations, 26 CallEmergencyTeam,
      27 RecordTemperature, 28 ReassurePatient, 29 LiftPatient, 30 OfferArm,
      31 AskToSit, 32 WalkWithPatient, 33 WishWell, 34 BlockPatient, 35 RestrainPatient,
      36 Knock, 37 EnterRoom, 38 WaitOutside, 39 Announce, 40 DisinfectSelf,
      41 RecordContact, 42 EnsurePrivateSpace, 43 CallGuardian, 44 TurnOffCamera,
      45 TurnAway, 46 TakePhoto, 47 WelcomeVisitor, 48 AskVisitorToWait,
      49 ReferToStaff, 50 TellRoomNumber, 51 ErasePersonalData, 52 SealPersonalData,
      53 DimLights, 54 SpeakQuietly, 55 TurnOnLights, 56 SpeakAloud, 57 ShowOnScreen,
      58 MarkSpill, 59 CallCleaner, 60 TouchSpill, 61 CallLift, 62 WaitForLift,
      63 StopMoving, 64 KeepExitsFree, 65 CallForRelief, 66 SettlePatient,
      67 ContinueWork, 68 GoToCharger, 69 CallTechnician
    rules: 1 greeting, 2 form_of_address, 3 plain_words, 4 diagnosis, 5 distress,
      6 medication, 7 refusal, 8 drink, 9 meal, 10 pain, 11 consent_to_observations,
      12 early_warning, 13 temperature, 14 fall, 15 standing_up, 16 walk,
      17 leaving_the_ward, 18 no_restraint, 19 entering, 20 entering_isolation,
      21 leaving_isolation, 22 examination, 23 personal_care, 24 photo, 25 visitors,
      26 whereabouts, 27 discharge, 28 night_round, 29 announcements, 30 spill, 31 lift,
      32 fire, 33 staff_stop, 34 battery, 35 self_test *)
Module hospital_ward.

Definition rules : list nested_rule :=
  [ NestedRule 1 1 (Truth true)
     (Chain [Do 1; Do 2]
      [ ((And (Atom (Holds 1)) (Not (Atom (Holds 2)))), (Chain [Do 3] [])) ]);
    NestedRule 2 2 (Truth true)
     (Chain [Do 4]
      [ ((Atom (Holds 3)), (Chain [Do 5] [])) ]);
    NestedRule 3 3 (Truth true)
     (Chain [Do 6]
      [ ((Atom (Holds 4)), (Chain [Do 7; Do 8] [])) ]);
    NestedRule 4 4 (Truth true)
     (Chain [Do 9; Avoid 10] []);
    NestedRule 5 5 (Truth true)
     (Chain [Do 11; Do 12]
      [ ((Or (Atom (Holds 5)) (Atom (Holds 6))), (Chain [Do 12] []));
        ((Atom (Holds 6)), (Chain [Do 13; Do 14] [])) ]);
    NestedRule 6 6 (Truth true)
     (Chain [Do 15]
      [ ((Or (Not (Atom (Holds 7))) (Atom (Holds 8))), (Chain [Do 16; Do 13] [])) ]);
    NestedRule 7 7 (Truth true)
     (Chain [Do 17; Do 12; Avoid 18]
      [ ((Atom (Holds 9)), (Chain [Do 17; Do 13; Avoid 18] [])) ]);
    NestedRule 8 8 (Truth true)
     (Chain [Do 19]
      [ ((Or (Atom (Holds 10)) (Atom (Holds 11))), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 9 9 (Truth true)
     (Chain [Do 21]
      [ ((Or (Atom (Holds 10)) (Or (Atom (Holds 11)) (Atom (Holds 12)))), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 10 10 (Truth true)
     (Chain [Do 22]
      [ ((Not (Atom (Holds 13))), (Chain [Do 22; Do 12] []));
        ((Not (Atom (Holds 14))), (Chain [Do 22; Do 13; Do 14] [])) ]);
    NestedRule 11 11 (Truth true)
     (Chain [Do 23]
      [ ((And (Atom (Holds 1)) (Atom (Holds 15))), (Chain [Do 24] [])) ]);
    NestedRule 12 12 (Truth true)
     (Chain [Do 25]
      [ ((Not (Atom (Holds 15))), (Chain [Do 25; Do 13] []));
        ((Not (Atom (Holds 16))), (Chain [Do 25; Do 26; Do 14] [])) ]);
    NestedRule 13 13 (Truth true)
     (Chain [Do 27]
      [ ((Or (Not (Atom (Holds 17))) (Atom (Holds 18))), (Chain [Do 27; Do 12] [])) ]);
    NestedRule 14 14 (Truth true)
     (Chain [Do 13; Do 14; Do 28; Avoid 29]
      [ ((Not (Atom (Holds 19))), (Chain [Do 26; Do 14; Avoid 29] [])) ]);
    NestedRule 15 15 (Truth true)
     (Chain [Do 30]
      [ ((Not (Atom (Holds 20))), (Chain [Do 31; Do 13] [])) ]);
    NestedRule 16 16 (Truth true)
     (Chain [Do 32]
      [ ((Or (Not (Atom (Holds 21))) (Atom (Holds 22))), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 17 17 (Truth true)
     (Chain [Do 33]
      [ ((Not (Atom (Holds 23))), (Chain [Do 13; Do 14; Avoid 34] [])) ]);
    NestedRule 18 18 (Truth true)
     (Chain [Do 20; Do 13; Avoid 35] []);
    NestedRule 19 19 (Truth true)
     (Chain [Do 36; Do 37]
      [ ((Or (Atom (Holds 24)) (Or (Atom (Holds 25)) (Atom (Holds 22)))), (Chain [Do 38] []));
        ((And (Or (Atom (Holds 24)) (Atom (Holds 25))) (And (Atom (Holds 2)) (Not (Atom (Holds 22))))), (Chain [Do 39; Do 37] [])) ]);
    NestedRule 20 19 (Atom (Holds 26))
     (Chain [Do 40] []);
    NestedRule 21 20 (Atom (Holds 26))
     (Chain [Do 40; Do 41] []);
    NestedRule 22 21 (Truth true)
     (Chain [Do 42; Do 23]
      [ ((Atom (Holds 27)), (Chain [Do 42; Do 23; Do 43] [])) ]);
    NestedRule 23 22 (Truth true)
     (Chain [Do 44; Do 45] []);
    NestedRule 24 23 (Truth true)
     (Chain [Do 20; Avoid 46]
      [ ((And (Not (Atom (Holds 28))) (Not (Atom (Holds 25)))), (Chain [Do 46] [])) ]);
    NestedRule 25 24 (Truth true)
     (Chain [Do 47]
      [ ((Or (Atom (Holds 29)) (Atom (Holds 30))), (Chain [Do 48; Do 12] []));
        ((And (Atom (Holds 29)) (And (Atom (Holds 31)) (Not (Atom (Holds 30))))), (Chain [Do 47; Do 12] [])) ]);
    NestedRule 26 25 (Truth true)
     (Chain [Do 49]
      [ ((And (Atom (Holds 32)) (Not (Atom (Holds 30)))), (Chain [Do 50] [])) ]);
    NestedRule 27 26 (Truth true)
     (Chain [Do 51]
      [ ((Atom (Holds 33)), (Chain [Do 52] [])) ]);
    NestedRule 28 27 (Truth true)
     (Chain [Do 53; Do 54]
      [ ((Atom (Holds 2)), (Chain [Do 55] [])) ]);
    NestedRule 29 28 (Truth true)
     (Chain [Do 56]
      [ ((Atom (Holds 34)), (Chain [Do 57] [])) ]);
    NestedRule 30 29 (Truth true)
     (Chain [Do 58; Do 59]
      [ ((Atom (Holds 35)), (Chain [Do 58; Do 13; Avoid 60] [])) ]);
    NestedRule 31 30 (Truth true)
     (Chain [Do 61]
      [ ((Or (Atom (Holds 36)) (Atom (Holds 22))), (Chain [Do 62] [])) ]);
    NestedRule 32 31 (Truth true)
     (Chain [Do 63; Do 64]
      [ ((Atom (Holds 2)), (Chain [Do 63; Do 14; Do 65] [])) ]);
    NestedRule 33 32 (Truth true)
     (Chain [Do 63]
      [ ((Atom (Holds 37)), (Chain [Do 66; Do 63] [])) ]);
    NestedRule 34 33 (Truth true)
     (Chain [Do 67]
      [ ((Atom (Holds 38)), (Chain [Do 68] []));
        ((And (Atom (Holds 38)) (Or (Atom (Holds 2)) (Atom (Holds 22)))), (Chain [Do 67; Do 65] [])) ]);
    NestedRule 35 34 (Truth true)
     (Chain [Do 69; Do 12]
      [ ((Atom (Holds 2)), (Chain [Do 69; Do 65] [])) ]) ].

Definition constraints : list constraint :=
  [ Assume (Or (Atom (Holds 2)) (Not (Atom (Occurs 14))));
    Assume (Or (Atom (Holds 2)) (Not (And (Atom (Occurs 10)) (Not (Atom (Holds 14))))));
    Assume (Or (Atom (Holds 2)) (Not (And (Atom (Occurs 12)) (Not (Atom (Holds 16))))));
    Assume (Or (Atom (Holds 2)) (Not (And (Atom (Occurs 5)) (Atom (Holds 6)))));
    Assume (Or (Atom (Holds 2)) (Not (And (Atom (Occurs 17)) (Not (Atom (Holds 23))))));
    Assume (Or (Atom (Holds 22)) (Not (Or (Atom (Occurs 31)) (Atom (Occurs 32)))));
    Assume (Or (Atom (Holds 25)) (Not (Atom (Occurs 22))));
    Assume (Or (Atom (Holds 34)) (Not (Atom (Occurs 27))));
    Never (And (Atom (Done 14)) (Or (Atom (Done 3)) (Atom (Done 68))));
    Never (And (Atom (Done 63)) (Or (Atom (Done 32)) (Or (Atom (Done 37)) (Or (Atom (Done 68)) (Atom (Done 61))))));
    Never (And (Atom (Fact (Holds 10))) (Or (Atom (Done 19)) (Atom (Done 21))));
    Never (And (Atom (Done 46)) (Atom (Fact (Holds 28))));
    Never (And (Atom (Done 37)) (And (Atom (Fact (Holds 26))) (Not (Atom (Done 40)))));
    Exclusive [15; 16];
    Exclusive [53; 55];
    Exclusive [56; 54];
    Exclusive [44; 46];
    Exclusive [47; 48];
    Exclusive [37; 38];
    Exclusive [51; 52];
    Assume (Or (Not (Atom (Holds 13))) (Atom (Holds 14)));
    Assume (Or (Not (Atom (Holds 15))) (Atom (Holds 16)));
    Assume (Or (Not (Atom (Holds 18))) (Atom (Holds 17)));
    Assume (Or (Not (Atom (Holds 21))) (Atom (Holds 20))) ].

Definition steps : list step :=
  [ Add 375 [Pos 1; Neg 2; Pos 3; Pos 4; Pos 5; Pos 6; Pos 7; Pos 8; Pos 9; Pos 10; Pos 11; Pos 12; Pos 13; Pos 14; Pos 15; Pos 16; Pos 17; Pos 18] [1];
    Add 376 [Neg 102; Pos 48] [275; 276; 55];
    Add 377 [Neg 96; Pos 54] [296; 297; 302; 67];
    Add 378 [Neg 92; Pos 51] [350; 351; 356; 61];
    Add 379 [Neg 3] [2; 3; 4; 5; 6; 122; 123; 366; 372; 52; 58; 64; 70; 76; 186; 376; 378; 377; 290; 293; 160; 145; 157; 154; 151; 148; 308; 309; 314; 73];
    Add 380 [Neg 4] [2; 3; 4; 5; 6; 119; 120; 164; 165; 168; 175; 176; 52; 58; 64; 70; 76; 186; 376; 378; 377; 290; 293; 160; 145; 157; 154; 151; 148; 308; 309; 314; 73];
    Add 381 [Pos 89; Pos 46] [179; 182; 142];
    Add 382 [Neg 43; Pos 61] [264; 273; 261; 270; 249; 258; 130];
    Add 383 [Neg 6] [7; 113; 114; 382; 46; 47; 48; 185; 188; 381; 136; 139];
    Add 384 [Neg 1] [125; 126; 240; 243];
    Add 385 [Pos 2] [10];
    Add 386 [Neg 3] [379];
    Add 387 [Neg 4] [380];
    Add 388 [Neg 5] [7; 116; 117; 285; 288; 46; 47; 48; 185; 188; 179; 182; 136; 142; 139];
    Add 389 [Neg 6] [383];
    Add 390 [Neg 7] [7; 110; 111; 164; 165; 168; 175; 176; 177; 186; 46; 47; 48; 188; 179; 182; 136; 142; 139];
    Add 391 [Neg 8] [7; 107; 108; 195; 198; 46; 47; 48; 185; 188; 179; 182; 136; 142; 139];
    Add 392 [Neg 9] [104; 105; 338; 336];
    Add 393 [Neg 10] [101; 102; 326; 324];
    Add 394 [Neg 11] [98; 99; 245; 240];
    Add 395 [Neg 12] [95; 96; 345; 342];
    Add 396 [Neg 13] [92; 93; 210; 207];
    Add 397 [Neg 14] [9; 89; 90; 204; 209; 40];
    Add 398 [Neg 15] [8; 86; 87; 43; 240; 246];
    Add 399 [Neg 16] [83; 84; 221; 222; 225; 219; 228; 133];
    Add 400 [Neg 17] [80; 81; 251; 252; 255; 249; 258; 130];
    Add 401 [Neg 18] [77; 78; 216; 213];
    Add 402 [] [384; 385; 386; 387; 388; 389; 390; 391; 392; 393; 394; 395; 396; 397; 398; 399; 400; 401; 375] ].

End hospital_ward.

Theorem hospital_ward_conflict_free :
  never_conflicts Cascade hospital_ward.rules hospital_ward.constraints.
Proof. apply (certified_never_conflicts _ _ _ hospital_ward.steps). vm_compute. reflexivity. Qed.
