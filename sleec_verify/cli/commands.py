"""The group of commands. Each command's module is imported when it is called for, and no sooner."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import click

from sleec_verify import __version__

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

_SUMMARIES = {
    "check": "Are the rules free of conflict, and does each make sense?",
    "entail": "What do the rules oblige in a situation?",
    "explain": "What do the rules oblige in a situation, and why?",
    "compile": "The rules as formulas or clauses (Equation 1).",
    "cases": "Few situations that reach every clause, for trials.",
    "certify": "Proofs of what a check found, for others to check.",
    "conform": "Does a robot's code have the structure that the rules ask for?",
    "convert": "The rules in another language or reading.",
    "diff": "What changes between two versions of the rules?",
    "gate": "May this change to the rules go in?",
    "fmt": "The rules in their usual layout.",
    "rules": "List and explain every finding code.",
    "completion": "A script by which a shell completes commands.",
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
            from sleec_verify.results.phrases import shortened

            near = nearest(args[0], _SUMMARIES)
            hint = f"did you mean {near}?" if near else f"there are {', '.join(_SUMMARIES)}"
            raise click.UsageError(f"there is no command {shortened(args[0])!r}; {hint}", ctx)
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
@click.option("--traceback", is_flag=True, expose_value=False, help="Where something fails, show the traceback.")
def sleec_verify() -> None:
    """Prove things about SLEEC rules.

    Exit codes: 0 all holds; 1 findings; 2 unusable input or usage; 3 some verdict is unknown;
    130 interrupted (Ctrl-C); 141 the output was closed by its reader.
    """
