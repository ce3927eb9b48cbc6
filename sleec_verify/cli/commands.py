"""The group of commands. The module of a command is imported when the command is used."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import click

from sleec_verify import __version__

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

_SUMMARIES = {
    "check": "Check the rules for contradictions and other mistakes.",
    "serve": "Write rules and try them on a local page.",
    "resolve": "Resolve conflicts one by one, and record the decisions.",
    "entail": "Show what the rules require in a situation.",
    "report": "Write a report for people about the rules.",
    "explain": "Explain what the rules require in a situation.",
    "compile": "Translate the rules into formulas or clauses.",
    "cases": "Choose a small set of situations for tests.",
    "certify": "Write or verify proofs of the results of check.",
    "conform": "Check a robot's code against the rules.",
    "audit": "Check recorded missions against the rules.",
    "convert": "Translate rules into another language or reading.",
    "diff": "Compare the meaning of two versions of the rules.",
    "gate": "Decide in CI whether a change may be merged.",
    "fmt": "Format rules.",
    "rules": "List and explain every finding code.",
    "completion": "Print a completion script for a shell.",
}


class _Lazy(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_SUMMARIES)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _SUMMARIES:
            return None
        command: click.Command = import_module(f"sleec_verify.cli.{cmd_name}").command
        return command

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """What click would answer, without an import of every command."""
        from click.shell_completion import CompletionItem

        names = [CompletionItem(name, help=said) for name, said in _SUMMARIES.items() if name.startswith(incomplete)]
        return names + click.Command.shell_complete(self, ctx, incomplete)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and args[0] not in _SUMMARIES and not args[0].startswith("-"):
            from sleec_runtime.support.suggestions import nearest
            from sleec_verify.wording.phrases import shortened

            near = nearest(args[0], _SUMMARIES)
            hint = f"did you mean {near}?" if near else f"the commands are {', '.join(_SUMMARIES)}"
            raise click.UsageError(f"no command is called {shortened(args[0])!r}; {hint}", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(_SUMMARIES.items()))


@click.command(
    cls=_Lazy,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example: sleec-verify check rulesets/",
    no_args_is_help=True,
)
@click.version_option(__version__, message="%(prog)s %(version)s")
@click.option("--traceback", is_flag=True, expose_value=False, help="Show tracebacks of errors.")
def sleec_verify() -> None:
    """Verify SLEEC rules for robots.

    Exit codes: 0 no findings at or above --fail-level; 1 findings; 2 invalid input or usage; 3 a check was
    inconclusive; 130 interrupted (Ctrl-C); 141 the reader closed the output.
    """
