"""Rules with time: clocks, pending obligations, and timer events. Only rulesets with time import this room."""
