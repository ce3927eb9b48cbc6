"""Theorems about one ruleset, in Coq: that no context of it conflicts, by a refutation that Coq follows itself.

    python -m sleec_verify.certificates.theory.theorems rulesets/*.sleec -o proofs/rulesets

writes a file for each ruleset that never conflicts, with a theorem for each of its domains, and one that asks what they
all rest on. Only the steps of the refutations come from a solver: all else follows from the text.
"""

from __future__ import annotations

import argparse
import re
import sys
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load
from sleec_runtime.model import Ruleset
from sleec_verify.certificates.theory.boolean import Boolean
from sleec_verify.certificates.theory.numbering import Kind, Numbering
from sleec_verify.certificates.theory.oracle import NotRefuted, built
from sleec_verify.certificates.theory.theory_questions import ProofStep, Theory, not_modelled

STEPS = "Definition steps"
"""What comes from a solver begins with this."""

_WORDS: dict[Kind, str] = {
    "trigger": "triggers",
    "condition": "conditions",
    "obligation": "obligations",
    "rule": "rules",
}

_HEAD = """\
(** No context of {path} conflicts.{more}

    Written by `make theorems`; do not edit. *)

From Coq Require Import List PArith.
From Sleec Require Import Model Nested Constraints.
From Checker Require Import Formula Checker.
From Oracle Require Import Certified.
Import ListNotations.
Local Open Scope positive_scope.
"""

_MODULE = """
(** {title}

{names} *)
Module {module}.

Definition rules : list nested_rule :={rules}.

Definition constraints : list constraint :={constraints}.

{steps}
End {module}.

Theorem {module}_conflict_free :
  never_conflicts {reading} {module}.rules {module}.constraints.
Proof. apply (certified_never_conflicts _ _ _ {module}.steps). vm_compute. reflexivity. Qed.
"""


def modules(ruleset: Ruleset) -> dict[str, Ruleset]:
    """The rules in each of their domains, or as they are if they have one or none, by the names of Coq modules."""
    name = _identifier(Path(ruleset.source.path).stem)
    if len(ruleset.domains) < 2:
        return {name: ruleset.in_domain(ruleset.domains[0]) if ruleset.domains else ruleset}
    return {f"{name}_{_identifier(domain)}": ruleset.in_domain(domain) for domain in ruleset.domains}


def theorems(ruleset: Ruleset, steps: Mapping[str, Sequence[ProofStep]]) -> str:
    """The Coq file of a ruleset, with the steps for each of its modules."""
    more = ""
    if ruleset.measures:
        more = "\n\n" + "\n".join(_comment(_MEASURES, hanging=""))
    parts = [_HEAD.format(path=Path(ruleset.source.path).name, more=more)]
    for module, part in modules(ruleset).items():
        numbered = Numbering(Boolean(part).ruleset)
        domain = next((d for d in ruleset.domains if part == ruleset.in_domain(d)), None)
        parts.append(
            _MODULE.format(
                title=f"The rules in the domain {domain}." if domain else "The rules.",
                names="\n".join(_names(numbered)),
                module=module,
                reading=part.reading.capitalize(),
                rules=numbered.coq_rules(),
                constraints=numbered.coq_constraints(),
                steps=_steps(steps[module]),
            )
        )
    return "".join(parts)


_MEASURES = (
    "A comparison of a measure is a condition here, as in `certificates.theory.boolean`; what is assumed of the order "
    "of these is true of all values."
)


def but_steps(text: str) -> str:
    """What of a file follows from the rules alone."""
    return re.sub(rf"^{STEPS}.*?^End ", "", text, flags=re.MULTILINE | re.DOTALL)


def assumptions(files: Iterable[tuple[str, Iterable[str]]]) -> str:
    """The file that asks what all theorems rest on, from the names of Coq files, each with its modules."""
    known = [(file, list(found)) for file, found in files]
    asked = "".join(f"Print Assumptions {file}.{module}_conflict_free.\n" for file, found in known for module in found)
    return (
        "(** What the theorems about rulesets rest on; [make -C proofs check] reads the answers.\n\n"
        "    Written by `make theorems`; do not edit. *)\n\n"
        f"From Rulesets Require\n  {' '.join(file for file, _ in known)}.\n\n{asked}"
    )


def file_of(path: Path) -> str:
    """The name of a ruleset's Coq file, without its ending."""
    return _identifier(path.stem).capitalize()


def _identifier(text: str) -> str:
    plain = re.sub(r"\W+", "_", text, flags=re.ASCII).strip("_").lower()
    return plain if plain[:1].isalpha() else f"r_{plain}"


def _names(numbered: Numbering) -> list[str]:
    """A line of each kind of names, with their numbers."""
    entries = []
    for kind, word in _WORDS.items():
        names = numbered.names[kind]
        if names:
            entries.append(f"{word}: {', '.join(f'{number}{_TIE}{name}' for number, name in enumerate(names, 1))}")
    return [line for one in entries for line in _comment(one)]


_TIE = "\N{WORD JOINER}"
"""A space at which no line is broken."""


def _comment(text: str, hanging: str = "  ") -> list[str]:
    # No name may end the comment, or open another.
    safe = text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")
    indent = " " * 4
    rows = textwrap.wrap(safe, 88, initial_indent=indent, subsequent_indent=indent + hanging, break_long_words=False)
    return [row.replace(_TIE, " ") for row in rows]


def _steps(steps: Sequence[ProofStep]) -> str:
    def literals(numbers: Iterable[int]) -> str:
        return "; ".join(f"Pos {n}" if n > 0 else f"Neg {-n}" for n in numbers)

    rows = (f"Add {number} [{literals(clause)}] [{'; '.join(map(str, hints))}]" for number, clause, hints in steps)
    return f"{STEPS} : list step :=\n  [ " + ";\n    ".join(rows) + " ].\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the files. 0, or 2 where the oracle is not built or a ruleset cannot be read."""
    parser = argparse.ArgumentParser(prog="make theorems", description="Theorems in Coq about rulesets.")
    parser.add_argument("paths", metavar="FILE", nargs="+", type=Path)
    parser.add_argument("-o", "--output", metavar="DIR", required=True, type=Path)
    options = parser.parse_args(arguments)
    program = built()
    if program is None:
        print("the oracle is not built; build it with: make -C proofs oracle-alone", file=sys.stderr)
        return 2
    texts: dict[str, str] = {}
    asked: list[tuple[str, list[str]]] = []
    try:
        for path in options.paths:
            ruleset = load(path)
            reason = not_modelled(ruleset)
            steps: dict[str, Sequence[ProofStep]] = {}
            if reason is None:
                try:
                    for module, part in modules(ruleset).items():
                        with Theory(program, part) as theory:
                            steps[module] = theory.steps_for("conflict")
                except NotRefuted:
                    reason = "it may conflict"
            if reason is not None:
                print(f"{path}: no theorem: {reason}")
                continue
            texts[f"{file_of(path)}.v"] = theorems(ruleset, steps)
            asked.append((file_of(path), list(steps)))
            print(f"{path}: {', '.join(f'{module}_conflict_free' for module in steps)}")
        texts["Assumptions.v"] = assumptions(asked)
        options.output.mkdir(parents=True, exist_ok=True)
        for stale in options.output.glob("*.v"):
            if stale.name not in texts:
                stale.unlink()
        for name, text in texts.items():
            (options.output / name).write_text(text, encoding="utf-8")
    except (SleecError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
