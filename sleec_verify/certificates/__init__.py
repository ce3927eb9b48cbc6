"""Certificates: the results of a check with their evidence, which others can verify without trusting the solver.

- `recorder` keeps the unsatisfiable questions of a check.
- `refutation` combines them into one formula and refutes it.
- `lrat` checks a refutation.
- `manifest` lists the results and their evidence.
- `directory` writes the folder of a certificate.
- `verification` verifies it from the text of the rules.
"""
