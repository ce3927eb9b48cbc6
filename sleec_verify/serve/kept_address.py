"""The port and the secret of the page of a file. They are stored, so that an open page continues after a restart."""

from __future__ import annotations

import json
from contextlib import suppress
from secrets import token_hex
from time import time
from typing import NamedTuple

from sleec_runtime.support.files import read_file
from sleec_verify.serve.state_folder import keep, state_path

_LONGEST = 30 * 24 * 3600
"""The seconds after which a new secret replaces the old one."""


class KeptAddress(NamedTuple):
    """A port, the secret of the server that used it last, and when that secret was made, in seconds since 1970."""

    port: int
    secret: str
    since: float

    @classmethod
    def read(cls, path: str, folder: str | None = None) -> KeptAddress:
        """The address for the rules at `path`. If none is stored, or if it is too old: a new secret and port 0."""
        with suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            found = json.loads(read_file(state_path(path, "addresses", folder)))
            port, secret, since = int(found["port"]), str(found["secret"]), float(found["since"])
            if len(secret) == 64 and 0 < port < 2**16 and 0 <= time() - since < _LONGEST:
                return cls(port, secret, since)
        return cls(0, token_hex(32), time())

    def keep(self, path: str, folder: str | None = None) -> None:
        """Store it, if that is possible. Without it, pages need the new address after a restart."""
        with suppress(OSError):
            keep(state_path(path, "addresses", folder), json.dumps(self._asdict()).encode())
