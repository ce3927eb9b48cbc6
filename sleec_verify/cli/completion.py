"""``sleec-verify completion``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from sleec_verify.cli import COMPLETION, exits
from sleec_verify.cli.output import write_data

if TYPE_CHECKING:
    from click.shell_completion import ShellComplete


@click.command(
    "completion",
    short_help="Print a completion script for a shell.",
    epilog="Example: sleec-verify completion bash > ~/.sleec-verify-completion.bash",
)
@click.argument("shell", type=click.Choice(("bash", "zsh", "fish")))
def command(shell: str) -> int:
    """Print a script that completes commands, options, values, finding codes and paths in a shell.

    \b
    bash  add  eval "$(sleec-verify completion bash)"  to ~/.bashrc
    zsh   add  eval "$(sleec-verify completion zsh)"  to ~/.zshrc, below compinit
    fish  add  sleec-verify completion fish | source  to ~/.config/fish/config.fish
    """
    from click.shell_completion import get_completion_class

    from sleec_verify.cli.commands import sleec_verify

    kind = get_completion_class(shell)
    assert kind is not None, "click knows the shells that are offered"
    script: ShellComplete = kind(sleec_verify, {}, "sleec-verify", COMPLETION)
    # ShellComplete.source() runs the shell to get its version, which fails if the shell is on another machine.
    write_data((script.source_template % script.source_vars() + "\n",))
    return exits.HOLDS
