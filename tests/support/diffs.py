"""Rulesets for tests of `diff`."""

from __future__ import annotations

OLD = "RULE a\nWHEN t THEN o\nUNLESS c IN WHICH CASE p\n"
SAME = "RULE z\nWHEN t THEN o\nUNLESS NOT NOT c IN WHICH CASE p\n"
MORE = "RULE a\nWHEN t THEN o AND q\nUNLESS c IN WHICH CASE p\n"
LESS = "RULE a\nWHEN t AND NOT c THEN o\n"
CLASH = OLD + "RULE b\nWHEN t THEN NOT o\n"
