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
    short_help="A script by which a shell completes commands.",
    epilog="Example: sleec-verify completion bash > ~/.sleec-verify-completion.bash",
)
@click.argument("shell", type=click.Choice(("bash", "zsh", "fish")))
def command(shell: str) -> int:
    """Print a script for SHELL by which it completes commands, options, their values, finding codes and paths.

    \b
    bash  put  eval "$(sleec-verify completion bash)"  into ~/.bashrc
    zsh   put  eval "$(sleec-verify completion zsh)"  into ~/.zshrc, below compinit
    fish  put  sleec-verify completion fish | source  into ~/.config/fish/config.fish
    """
    from click.shell_completion import get_completion_class

    from sleec_verify.cli.commands import sleec_verify

    kind = get_completion_class(shell)
    assert kind is not None, "click knows the shells that are offered"
    script: ShellComplete = kind(sleec_verify, {}, "sleec-verify", COMPLETION)
    # Its own source() looks for the shell's version first, and fails where the shell is on another machine.
    write_data((script.source_template % script.source_vars() + "\n",))
    return exits.HOLDS
