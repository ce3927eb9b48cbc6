"""Conditions, and phrases with a negation that deny them, or that may mean something else."""

from __future__ import annotations

CERTAIN = [
    ("it is night", "it is not night"),
    ("it is night", "it isn't night"),
    ("the user is alone", "the user is not alone"),
    ("the front door is open", "the front door isn\u2019t open"),
    ("the user has a key", "the user has not a key"),
    ("the user has eaten", "the user hasn't eaten"),
    ("the user can speak", "the user cannot speak"),
    ("the user can speak", "the user can't speak"),
    ("the user does sleep", "the user does not sleep"),
    ("the lamps are on", "the lamps are not on"),
    ("my family is here", "my family is not here"),
    ("user is allowed to leave", "user is not allowed to leave"),
    ("is empty", "is not empty"),
    ("there is a fire", "there is not a fire"),
]
"""A condition, and a phrase that denies it."""

UNCERTAIN = [
    ("the user must leave", "the user must not leave"),
    ("the user should leave", "the user should not leave"),
    ("the user may leave", "the user may not leave"),
    ("the user asked to be disturbed", "the user asked not to be disturbed"),
    ("the user wants to eat", "the user wants not to eat"),
    ("the user says that the door is open", "the user says that the door is not open"),
    ("the user says Bob is ill", "the user says Bob is not ill"),
    ("says it is dark", "says it is not dark"),
    ("the user thinks it is dark", "the user thinks it isn't dark"),
    ("the user is sure it is night", "the user is sure it is not night"),
    ("the user who is alone sleeps", "the user who is not alone sleeps"),
    ("all doors are closed", "all doors are not closed"),
    ("any door is open", "any door is not open"),
    ("a door is open", "a door is not open"),
    ("every user is here", "every user is not here"),
    ("somebody is here", "somebody is not here"),
    ("the user is in any room", "the user is not in any room"),
    ("it is dark or late", "it is not dark or late"),
    ("it is dark and late", "it is not dark and late"),
    ("it is night and the user sleeps", "it is night and the user not sleeps"),
    ("the user is awake because it is dark", "the user is not awake because it is dark"),
    ("the user is awake until noon", "the user is not awake until noon"),
    ("the user is asleep for 5 minutes", "the user is not asleep for 5 minutes"),
    ("the user probably is ill", "the user probably is not ill"),
    ("the user is to be disturbed", "the user is not to be disturbed"),
    ("the user is alone", "the user is never alone"),
]
"""A condition, and a phrase that contains a negation and may mean something else than the opposite."""
