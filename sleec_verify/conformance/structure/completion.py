"""Obligations whose code takes time: whether the code reports their completion, and what may complete too late."""

from __future__ import annotations

import ast

from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.structure.control import own_nodes
from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.prohibitions import LastingProhibitions
from sleec_verify.conformance.structure.report import Findings
from sleec_verify.conformance.structure.resolve import Resolver
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.conformance.structure.uses import Use
from sleec_verify.conformance.structure.values import Code, ObligationMark, Text
from sleec_verify.wording.phrases import listed

Place = tuple[PythonFile, ast.AST]


class CompletionCheck:
    """Obligations that are marked with ``completes=False``, and the calls of ``completed`` that fulfil them."""

    def __init__(self, resolver: Resolver, names: Names, prohibitions: LastingProhibitions, findings: Findings) -> None:
        self._resolver = resolver
        self._names = names
        self._prohibitions = prohibitions
        self._findings = findings
        self._started: dict[str, Place] = {}
        """What the marked code only starts, or may only start."""
        self._completed: set[str] = set()
        self._unclear: list[Place] = []
        """Calls of ``completed`` for an obligation that is known only at run time."""

    def read(self, use: Use) -> None:
        """Takes note of a mark, and of a call of ``completed``."""
        if isinstance(use.node, ast.Call):
            mark = self._resolver.of(use.node, use.scope)
            if isinstance(mark, ObligationMark) and mark.name is not None and mark.completes is not True:
                self._started.setdefault(mark.name, (use.scope.file, use.node))
        elif isinstance(use.node, ast.Attribute) and use.node.attr == "completed":
            self._completion(use)

    def _completion(self, use: Use) -> None:
        if isinstance(self._resolver.of(use.node, use.scope), Code):
            return  # a method of the target
        call = use.parent if isinstance(use.parent, ast.Call) and use.parent.func is use.node else None
        given = [] if call is None else [*call.args, *(k.value for k in call.keywords if k.arg == "obligation")]
        name = self._resolver.of(given[0], use.scope) if given else None
        if not isinstance(name, Text):
            self._unclear.append((use.scope.file, use.node))
        elif name.value in self._names.obligations:
            self._completed.add(name.value)
        else:
            near = nearest(name.value, sorted(self._names.obligations))
            self._findings.add(
                "unknown-obligation",
                f"the rules have no obligation called `{name.value}`",
                (use.scope.file, given[0]),
                help=f"did you mean `{near}`?" if near else f"the rules have {listed(sorted(self._names.obligations))}",
            )

    def report(self) -> None:
        """Reports what is never completed, and what may complete while a rule forbids it."""
        for name, (file, node) in self._started.items():
            if name in self._completed or name not in self._prohibitions.required:
                continue
            for unclear, at in self._unclear:
                self._findings.undecided(unclear, at, f"whether this reports that {name} is completed")
            if not self._unclear:
                self._findings.add(
                    "never-completed",
                    f"{name} is started, but its completion is never reported",
                    (file, node),
                    obligations=(name,),
                    help=f'call sleec.completed("{name}") when it is done',
                )
        for name, (file, node) in {**self._awaiting(), **self._started}.items():
            if name in self._prohibitions and name in self._prohibitions.required:
                why = f"{name} takes time, so it may complete while {self._prohibitions.forbid_it(name)}"
                self._findings.undecided(file, node, why)

    def _awaiting(self) -> dict[str, Place]:
        """The obligations whose code is a coroutine function that awaits."""
        return {
            name: (function.file, function.node)
            for function in self._resolver.program.functions
            if isinstance(function.node, ast.AsyncFunctionDef)
            and any(isinstance(node, (ast.Await, ast.AsyncFor, ast.AsyncWith)) for node in own_nodes(function.node))
            and (name := self._names.of(function)) is not None
        }
