(** No context of hospital-ward.sleec conflicts.

    A comparison of a measure is a condition here, as in `sleec_verify.theory.boolean`;
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
      [ ((And (Atom 1) (Not (Atom 2))), (Chain [Do 3] [])) ]);
    NestedRule 2 2 (Truth true)
     (Chain [Do 4]
      [ ((Atom 3), (Chain [Do 5] [])) ]);
    NestedRule 3 3 (Truth true)
     (Chain [Do 6]
      [ ((Atom 4), (Chain [Do 7; Do 8] [])) ]);
    NestedRule 4 4 (Truth true)
     (Chain [Do 9; Avoid 10] []);
    NestedRule 5 5 (Truth true)
     (Chain [Do 11; Do 12]
      [ ((Or (Atom 5) (Atom 6)), (Chain [Do 12] []));
        ((Atom 6), (Chain [Do 13; Do 14] [])) ]);
    NestedRule 6 6 (Truth true)
     (Chain [Do 15]
      [ ((Or (Not (Atom 7)) (Atom 8)), (Chain [Do 16; Do 13] [])) ]);
    NestedRule 7 7 (Truth true)
     (Chain [Do 17; Do 12; Avoid 18]
      [ ((Atom 9), (Chain [Do 17; Do 13; Avoid 18] [])) ]);
    NestedRule 8 8 (Truth true)
     (Chain [Do 19]
      [ ((Or (Atom 10) (Atom 11)), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 9 9 (Truth true)
     (Chain [Do 21]
      [ ((Or (Atom 10) (Or (Atom 11) (Atom 12))), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 10 10 (Truth true)
     (Chain [Do 22]
      [ ((Not (Atom 13)), (Chain [Do 22; Do 12] []));
        ((Not (Atom 14)), (Chain [Do 22; Do 13; Do 14] [])) ]);
    NestedRule 11 11 (Truth true)
     (Chain [Do 23]
      [ ((And (Atom 1) (Atom 15)), (Chain [Do 24] [])) ]);
    NestedRule 12 12 (Truth true)
     (Chain [Do 25]
      [ ((Not (Atom 15)), (Chain [Do 25; Do 13] []));
        ((Not (Atom 16)), (Chain [Do 25; Do 26; Do 14] [])) ]);
    NestedRule 13 13 (Truth true)
     (Chain [Do 27]
      [ ((Or (Not (Atom 17)) (Atom 18)), (Chain [Do 27; Do 12] [])) ]);
    NestedRule 14 14 (Truth true)
     (Chain [Do 13; Do 14; Do 28; Avoid 29]
      [ ((Not (Atom 19)), (Chain [Do 26; Do 14; Avoid 29] [])) ]);
    NestedRule 15 15 (Truth true)
     (Chain [Do 30]
      [ ((Not (Atom 20)), (Chain [Do 31; Do 13] [])) ]);
    NestedRule 16 16 (Truth true)
     (Chain [Do 32]
      [ ((Or (Not (Atom 21)) (Atom 22)), (Chain [Do 20; Do 12] [])) ]);
    NestedRule 17 17 (Truth true)
     (Chain [Do 33]
      [ ((Not (Atom 23)), (Chain [Do 13; Do 14; Avoid 34] [])) ]);
    NestedRule 18 18 (Truth true)
     (Chain [Do 20; Do 13; Avoid 35] []);
    NestedRule 19 19 (Truth true)
     (Chain [Do 36; Do 37]
      [ ((Or (Atom 24) (Or (Atom 25) (Atom 22))), (Chain [Do 38] []));
        ((And (Or (Atom 24) (Atom 25)) (And (Atom 2) (Not (Atom 22)))), (Chain [Do 39; Do 37] [])) ]);
    NestedRule 20 19 (Atom 26)
     (Chain [Do 40] []);
    NestedRule 21 20 (Atom 26)
     (Chain [Do 40; Do 41] []);
    NestedRule 22 21 (Truth true)
     (Chain [Do 42; Do 23]
      [ ((Atom 27), (Chain [Do 42; Do 23; Do 43] [])) ]);
    NestedRule 23 22 (Truth true)
     (Chain [Do 44; Do 45] []);
    NestedRule 24 23 (Truth true)
     (Chain [Do 20; Avoid 46]
      [ ((And (Not (Atom 28)) (Not (Atom 25))), (Chain [Do 46] [])) ]);
    NestedRule 25 24 (Truth true)
     (Chain [Do 47]
      [ ((Or (Atom 29) (Atom 30)), (Chain [Do 48; Do 12] []));
        ((And (Atom 29) (And (Atom 31) (Not (Atom 30)))), (Chain [Do 47; Do 12] [])) ]);
    NestedRule 26 25 (Truth true)
     (Chain [Do 49]
      [ ((And (Atom 32) (Not (Atom 30))), (Chain [Do 50] [])) ]);
    NestedRule 27 26 (Truth true)
     (Chain [Do 51]
      [ ((Atom 33), (Chain [Do 52] [])) ]);
    NestedRule 28 27 (Truth true)
     (Chain [Do 53; Do 54]
      [ ((Atom 2), (Chain [Do 55] [])) ]);
    NestedRule 29 28 (Truth true)
     (Chain [Do 56]
      [ ((Atom 34), (Chain [Do 57] [])) ]);
    NestedRule 30 29 (Truth true)
     (Chain [Do 58; Do 59]
      [ ((Atom 35), (Chain [Do 58; Do 13; Avoid 60] [])) ]);
    NestedRule 31 30 (Truth true)
     (Chain [Do 61]
      [ ((Or (Atom 36) (Atom 22)), (Chain [Do 62] [])) ]);
    NestedRule 32 31 (Truth true)
     (Chain [Do 63; Do 64]
      [ ((Atom 2), (Chain [Do 63; Do 14; Do 65] [])) ]);
    NestedRule 33 32 (Truth true)
     (Chain [Do 63]
      [ ((Atom 37), (Chain [Do 66; Do 63] [])) ]);
    NestedRule 34 33 (Truth true)
     (Chain [Do 67]
      [ ((Atom 38), (Chain [Do 68] []));
        ((And (Atom 38) (Or (Atom 2) (Atom 22))), (Chain [Do 67; Do 65] [])) ]);
    NestedRule 35 34 (Truth true)
     (Chain [Do 69; Do 12]
      [ ((Atom 2), (Chain [Do 69; Do 65] [])) ]) ].

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
  [ Add 672 [Neg 18] [10; 77];
    Add 673 [Neg 129; Pos 155] [296; 297; 307; 300];
    Add 674 [Neg 7; Pos 210] [7; 10; 140; 141; 143; 238; 336; 339; 46; 463; 47; 48; 324; 329; 320; 326; 314; 317; 241; 250; 247; 244];
    Add 675 [Neg 13] [9; 10; 104; 105; 217; 107; 357; 214; 40; 365; 368];
    Add 676 [Neg 14] [8; 10; 98; 99; 211; 101; 428; 208; 43; 417; 423];
    Add 677 [Neg 9] [10; 128; 129; 578; 131; 576; 232];
    Add 678 [Neg 11] [10; 116; 117; 229; 119; 612; 226; 609];
    Add 679 [Neg 17] [10; 80; 81; 187; 83; 375; 184; 372];
    Add 680 [Neg 16; Neg 106] [10; 86; 87; 193; 89; 456; 190; 453; 449];
    Add 681 [Neg 131; Pos 52] [620; 621; 626; 61; 635];
    Add 682 [Neg 133; Pos 57] [557; 558; 563; 73; 569];
    Add 683 [Neg 135; Pos 55] [530; 531; 536; 67; 542];
    Add 684 [Neg 141; Pos 49] [479; 480; 485; 55];
    Add 685 [Neg 15] [10; 92; 93; 95; 199; 395; 396; 399; 393; 402; 205; 202];
    Add 686 [Neg 193; Pos 4; Pos 3; Pos 2; Pos 5; Pos 6; Pos 7; Pos 8; Pos 12; Pos 16] [677; 678; 675; 676; 685; 679; 672; 10; 420; 422; 283; 122; 179; 1; 177];
    Add 687 [Pos 3; Pos 5; Pos 131; Pos 133; Pos 6; Pos 7; Pos 8; Pos 12; Pos 16; Pos 2; Pos 4; Pos 135; Pos 137; Pos 139; Pos 141] [677; 678; 675; 676; 685; 679; 672; 10; 686; 417; 208; 125; 176; 123; 1];
    Add 688 [Neg 8] [10; 134; 135; 593; 137; 591; 235];
    Add 689 [Neg 155; Pos 88] [7; 10; 308; 309; 324; 46; 47; 48; 329; 320; 326; 314; 317; 241; 250; 247; 244];
    Add 690 [Pos 48; Pos 155; Pos 63] [10; 461; 310; 459; 471; 447; 468; 196; 456; 193];
    Add 691 [Neg 44; Pos 63] [10; 462; 471; 459; 468; 447; 456; 196; 193];
    Add 692 [Neg 5] [7; 10; 152; 153; 689; 155; 690; 691; 327; 46; 241; 47; 48; 329; 320; 323; 314; 317; 244; 250; 247];
    Add 693 [Pos 4; Pos 7; Pos 3; Pos 6; Pos 2; Pos 12; Pos 16] [692; 688; 677; 678; 675; 676; 685; 679; 672; 10; 686; 417; 208; 125; 176; 123; 1];
    Add 694 [Neg 16] [10; 87; 680; 89; 196; 190; 447; 450];
    Add 695 [Neg 210] [694; 7; 10; 461; 462; 308; 327; 366; 666; 46; 673; 223; 660; 47; 48; 253; 110; 280; 329; 320; 149; 167; 173; 323; 314; 317; 147; 165; 171; 250; 247; 244; 241; 140; 158; 693];
    Add 696 [Neg 7] [695; 674];
    Add 697 [Neg 48; Pos 3; Pos 6] [696; 694; 10; 695; 366; 463; 666; 223; 495; 660; 110; 492; 280; 256; 173; 161; 171; 159; 693];
    Add 698 [Pos 155] [692; 696; 688; 694; 2; 3; 4; 5; 6; 10; 673; 253; 149; 167; 147; 165; 697; 52; 58; 64; 70; 76; 310; 324; 363; 684; 681; 683; 682; 515; 495; 277; 220; 274; 509; 512; 492; 113; 271; 268; 256; 111; 265; 161; 262; 159; 259; 687; 170];
    Add 699 [Neg 48] [698; 308];
    Add 700 [Pos 88] [698; 689];
    Add 701 [Neg 49] [699; 6; 52];
    Add 702 [Neg 52] [699; 5; 58];
    Add 703 [Neg 55] [699; 4; 64];
    Add 704 [Neg 57] [699; 3; 70];
    Add 705 [Neg 59] [699; 2; 76];
    Add 706 [Neg 124] [699; 324];
    Add 707 [Neg 116] [699; 363];
    Add 708 [Neg 6] [700; 146];
    Add 709 [Neg 4] [700; 158];
    Add 710 [Neg 141] [701; 684];
    Add 711 [Neg 131] [702; 681];
    Add 712 [Neg 135] [703; 683];
    Add 713 [Neg 133] [704; 682];
    Add 714 [Neg 225] [705; 515];
    Add 715 [Pos 142] [706; 10; 277];
    Add 716 [Pos 77] [707; 10; 220];
    Add 717 [Pos 140] [710; 715; 274];
    Add 718 [Neg 139] [714; 509];
    Add 719 [Neg 137] [714; 512];
    Add 720 [Neg 76] [716; 113];
    Add 721 [Pos 138] [718; 717; 271];
    Add 722 [Pos 136] [719; 721; 268];
    Add 723 [Neg 12] [720; 111];
    Add 724 [Pos 134] [722; 712; 265];
    Add 725 [Pos 132] [724; 713; 262];
    Add 726 [Pos 96] [725; 711; 259];
    Add 727 [Neg 3] [726; 164];
    Add 728 [Neg 2] [726; 170];
    Add 729 [] [728; 727; 709; 692; 708; 696; 688; 723; 694; 711; 713; 712; 719; 718; 710; 687] ].

End hospital_ward.

Theorem hospital_ward_conflict_free :
  never_conflicts Cascade hospital_ward.rules hospital_ward.constraints.
Proof. apply (certified_never_conflicts _ _ _ hospital_ward.steps). vm_compute. reflexivity. Qed.
