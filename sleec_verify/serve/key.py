"""The key of a server: who knows its secret can derive the token, and can check that the server knows it, too.

Each start has a new token. An open page asks for the salt of the new start, and derives the token from it. Another
program at the same port learns nothing: the token is never sent before the server has proved that it knows the secret
(challenge and response with HMAC, RFC 2104). Each message has the port, so that nobody can pass a challenge on to a
server at another port.
"""

from __future__ import annotations

from hashlib import sha256
from hmac import digest
from typing import NamedTuple


class Key(NamedTuple):
    """The secret that a server shares with its pages, and the salt of its present start."""

    port: int
    secret: str
    salt: str

    @property
    def token(self) -> str:
        """The token that every request must have until the server ends."""
        return self._derived(f"token {self.port} {self.salt}")

    def response(self, challenge: str) -> str:
        """What only a server that knows the secret can answer to a challenge."""
        return self._derived(f"response {self.port} {self.salt} {challenge}")

    def _derived(self, message: str) -> str:
        return digest(self.secret.encode(), message.encode(), sha256).hex()
