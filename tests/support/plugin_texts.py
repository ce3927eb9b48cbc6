"""Rules and a robot for tests of the pytest plugin."""

RULES = """
MEASURE Age: number
RULE curtains
WHEN Request THEN Open
UNLESS Undressed IN WHICH CASE (Refuse AND Explain)
UNLESS Distressed OR Age < 12 IN WHICH CASE (Warn AND Open)
RULE stop WHEN Stop AND NOT Asleep THEN Halt
"""
ROBOT = """
import sleec_runtime

def make():
    sleec = sleec_runtime.load("house.sleec")
    sleec.implement(dict.fromkeys(sleec.ruleset.obligations, lambda: None))
    return sleec

def careless():
    import contextpy3 as cop
    sleec = make()
    class Robot:
        def refuse(self): pass
        def explain(self): pass
        def warn(self): pass
        def open(self): pass
        @sleec.rule("curtains")
        @cop.base
        def curtains(self): self.open()
        @cop.around(sleec.layers["curtains.hc1"])
        def curtains(self): self.refuse()
        @cop.around(sleec.layers["curtains.hc2"])
        def curtains(self): self.warn(); self.open()
    sleec.bind(Robot())
    return sleec

nothing = 5
def none(): return None
def broken(): raise RuntimeError("no arm")
"""
