"""The ``.sleec`` DSL of SLEEC-TK and LEGOS-SLEEC: text to `Ruleset` and back (docs/dsl.md)."""

from __future__ import annotations

from sleec_runtime.language.dsl.parser import parse_dsl

__all__ = ["parse_dsl"]
