"""Assertions about rules: ``never RefuseRequest when MedicalEmergency``, ``always CallNurse when FallDetected``.

An assertion is about the obligations of the clauses that decide, with or without a window. It must hold in every
situation that the assumptions allow. The check `conflict` reports whether the rules contradict each other there.
"""
