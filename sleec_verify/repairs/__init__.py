"""Repairs of findings: changes of the text, each verified by a check of the changed rules.

The operators are those of SLEEC-PATCH (2026) that need no language model. An operator proposes candidates;
`Verification` rejects every candidate that leaves the finding or introduces another one.
"""
