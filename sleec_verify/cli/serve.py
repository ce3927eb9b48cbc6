"""``sleec-verify serve``."""

from __future__ import annotations

import os

import click

from sleec_verify.cli import exits, options


@click.command(
    "serve",
    short_help="Write rules and try them on a local page.",
    epilog="Example: sleec-verify serve rulesets/household.sleec",
)
@options.paths(several=False)
@click.option(
    "--port",
    metavar="PORT",
    type=click.IntRange(0, 65535),
    default=0,
    help="The port of the page. Without this option, it is the port of the last time if that is free, or any free one.",
)
@click.option("--no-browser", is_flag=True, help="Only print the address; do not open it in the browser.")
@options.max_size
def command(path: str, port: int, no_browser: bool) -> int:
    """Open a page on which you write the rules in FILE and try them in situations. Press Ctrl-C to stop.

    Only this machine can open the page, and only with the address that the command prints.
    """
    from sleec_runtime.errors import UnreadableFile
    from sleec_runtime.language import read_source
    from sleec_verify.cli.output import tell, write_line
    from sleec_verify.serve.server import serve

    if path == "-":
        raise click.UsageError("standard input cannot be saved; name a file")
    if not os.path.lexists(path):
        raise UnreadableFile(
            f"file {path} does not exist", "check its name and folder; for new rules, create an empty file first"
        )
    read_source(path)  # reports a file that cannot be read

    def started(address: str) -> None:
        write_line(address)
        tell(f"{path}: open the address above; press Ctrl-C to stop")
        if not no_browser:
            import webbrowser

            webbrowser.open(address)

    serve(path, port, started)
    return exits.HOLDS
