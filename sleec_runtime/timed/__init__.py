"""Rules with times at work: clocks, what is pending, and what the clock starts. Imported by rulesets that need it."""
