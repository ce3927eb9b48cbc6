"""Properties asked of rules: ``never RefuseRequest when MedicalEmergency``, ``always CallNurse when FallDetected``.

An assertion is about what clauses that decide call for, at once or within a time, in every situation that the
assumptions allow. Whether the rules also contradict one another there is for the check `conflict`.
"""
