"""Rules with times: clocks, pending obligations, and timer events. Only rulesets with times import this room."""
