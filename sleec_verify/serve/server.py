"""The server: a port of this machine only, until Ctrl-C."""

from __future__ import annotations

import errno
import socket
from collections.abc import Callable
from contextlib import suppress
from secrets import token_hex

from sleec_runtime.errors import SleecError
from sleec_verify.serve.kept_address import KeptAddress
from sleec_verify.serve.key import Key

HOST = "127.0.0.1"


class PortInUse(SleecError):
    """A port on which another program listens."""


def serve(path: str, port: int, started: Callable[[str], None]) -> None:
    """Serve the page for the rules at `path` until Ctrl-C or SIGTERM. Port 0 means the port of the last time, or any
    free one.

    `started` gets the address, with the token, when the server accepts connections.

    Raises:
        PortInUse: another program uses the port.
        SleecError: the port may not be used, or a library is not installed.
    """
    try:
        import uvicorn

        from sleec_verify.serve.application import application
        from sleec_verify.serve.session import Session
    except ImportError as error:
        raise SleecError(
            f"serve needs a library that is not installed: {error.name}", "pip install 'sleec-verify[serve]'"
        ) from None
    kept = KeptAddress.read(path)
    with _listening(port) if port else _listening_again(kept.port) as listening:
        kept = kept._replace(port=listening.getsockname()[1])
        kept.keep(path)
        key = Key(kept.port, kept.secret, token_hex(32))
        config = uvicorn.Config(
            application(Session(path), key),
            lifespan="off",
            ws="none",
            loop="asyncio",
            http="h11",
            log_level="critical",  # the only errors are about requests that Ctrl-C cancels
            access_log=False,
            server_header=False,
            proxy_headers=False,
            timeout_graceful_shutdown=1,
        )
        started(f"http://{HOST}:{key.port}/?token={key.token}")
        with suppress(KeyboardInterrupt):  # uvicorn raises it again after the shutdown
            uvicorn.Server(config).run(sockets=[listening])


def _listening_again(port: int) -> socket.socket:
    """At a port that was used before, if it is free, otherwise at any free one."""
    try:
        return _listening(port)
    except SleecError:
        return _listening(0)


def _listening(port: int) -> socket.socket:
    # With the protocol named, asyncio sends small answers without the delay of Nagle's algorithm.
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((HOST, port))
        listening.listen()
    except OSError as error:
        listening.close()
        if error.errno == errno.EADDRINUSE:
            raise PortInUse(
                f"port {port} is in use", "choose another one with --port, or leave the option out"
            ) from None
        raise SleecError(f"port {port} cannot be used: {error.strerror}", "choose one above 1023") from None
    return listening
