"""Rules with time: what traces of instants they allow.

`responses` says what a response demands, as a formula over occurrences in windows; `times` compares the times of
instants; `unfolding` asks a solver for a trace, instant by instant as the rules call for them; `questions` and
`conflicts` put the questions of the field to it.
"""
