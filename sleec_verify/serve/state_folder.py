"""The user's folder for the state of programs. What the server keeps there can be read by its user only."""

from __future__ import annotations

import os
import sys
from hashlib import sha256

from sleec_verify.files.temporary import put_in_place


def state_path(path: str, kind: str, folder: str | None = None) -> str:
    """Where the server keeps something of a `kind` about the rules at `path`. Without a `folder`, it is in the user's
    state folder."""
    name = sha256(os.fsencode(os.path.realpath(path))).hexdigest()
    return os.path.join(folder if folder is not None else os.path.join(_state_folder(), kind), f"{name}.json")


def keep(path: str, content: bytes) -> None:
    """Store a content, atomically, so that only its user can read it. Raises OSError if it cannot be stored."""
    os.makedirs(os.path.dirname(path), 0o700, exist_ok=True)
    put_in_place(path, content, private=True)


def _state_folder() -> str:
    """The folder of the XDG Base Directory Specification, and ours in it."""
    base = os.environ.get("LOCALAPPDATA" if sys.platform == "win32" else "XDG_STATE_HOME", "")
    if not os.path.isabs(base):  # the standard says to ignore others
        base = os.path.join(os.path.expanduser("~"), ".local", "state")
    return os.path.join(base, "sleec-verify")
