"""Running git. Every call goes through `run`, because the repository at hand may be hostile.

The settings of a repository name programs: file system monitors, hooks, filters, transports. None of them is run here:

- `SETTINGS` turn off file system monitors and hooks, and take no folder of the tree for a repository of its own.
- No command is used that compares contents or checks files out, so no filter, diff program or editor is asked.
- No protocol is allowed, so nothing is fetched and nobody is asked for a password.

Other settings change what a revision contains. Replacement objects (git-replace(1)), grafts and the commit graph (a
cache of parents and trees) are not read.
"""

from __future__ import annotations

import os
import subprocess

from sleec_runtime.errors import SleecError

SETTINGS = (
    "safe.bareRepository=explicit",
    "core.fsmonitor=false",
    f"core.hooksPath={os.devnull}",
    "core.commitGraph=false",
    "advice.graftFileDeprecated=false",
)
_ENVIRONMENT = {
    "LC_ALL": "C",
    "GIT_ALLOW_PROTOCOL": "none",
    "GIT_GRAFT_FILE": os.devnull,
    "GIT_NO_REPLACE_OBJECTS": "1",
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_TERMINAL_PROMPT": "0",
}


class GitError(SleecError):
    """Git cannot answer: there is no git, no repository, or no such revision."""


def run(*arguments: str) -> subprocess.CompletedProcess[bytes]:
    """A git command. Paths are literal; the exit code is the caller's to look at.

    Raises:
        GitError: git cannot be started.
    """
    settings = (argument for setting in SETTINGS for argument in ("-c", setting))
    command = ["git", "--no-pager", "--literal-pathspecs", *settings, *arguments]
    environment = {**os.environ, **_ENVIRONMENT}
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False, env=environment)
    except FileNotFoundError:
        raise GitError("git is not installed", "install it, or name two files or folders") from None
    except (OSError, ValueError) as error:
        raise GitError(f"git cannot be run: {error}") from None


def complaint(done: subprocess.CompletedProcess[bytes]) -> str:
    """The first line of what git wrote to standard error."""
    lines = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return lines[0] if lines else "no reason given"
