"""Assertions about rules: ``never RefuseRequest when MedicalEmergency``, ``always CallNurse when FallDetected``.

An assertion is about the obligations of the clauses that decide, with or without a window, in every situation that the
assumptions allow. Whether the rules also contradict each other there is a question for the check `conflict`.
"""
