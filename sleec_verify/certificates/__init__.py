"""Certificates: what a check found, in a form that others can check without trusting what found it.

`recording` keeps the questions that were answered no; `refutation` makes one formula of them, which says that one of
them has a model after all, and refutes it; `lrat` checks a refutation; `manifest` says what was found of which text;
`directory` writes the whole, and `checking` checks it again from the text of the rules.
"""
