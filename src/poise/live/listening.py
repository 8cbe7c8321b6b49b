"""Where a server listens."""

from __future__ import annotations

import socket
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from poise.errors import PoiseError

_BACKLOG = 8192
_SEND_BUFFER = 128 << 10  # bytes: by itself the system keeps 4 MB for each viewer that does not read


class ServerError(PoiseError):
    """Why the server cannot start."""


@dataclass
class Options:
    """Where a server listens, and for whom."""

    host: str = "127.0.0.1"
    port: int = 8760
    tokens: dict[str, Any] = field(default_factory=dict)
    hosts: tuple[str, ...] = ()
    certificate: tuple[Path, Path] | None = None
    """certificate and key, for HTTPS"""
    phone_token: str = ""
    """what a phone's page shows; given to whoever may write"""
    made_token: str = ""
    """a token that was made up at the start, which nobody knows yet"""
    own_certificate: bool = False
    """whether this machine made its certificate itself"""


class Listening:
    """The listening sockets of *options*, closed at the end. Raises :class:`ServerError` where they cannot be had."""

    def __init__(self, options: Options) -> None:
        self._options = options

    def __enter__(self) -> list[socket.socket]:
        host, port = self._options.host, self._options.port
        try:
            family, _, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[
                0
            ]
        except (socket.gaierror, OverflowError) as problem:
            raise ServerError(f"--host {host}: no such address ({problem})") from None
        self._socket = socket.socket(family, socket.SOCK_STREAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            self._socket.bind(address)
        except OSError as problem:
            self._socket.close()
            reason = "another program listens there; give another --port" if problem.errno in (48, 98) else problem
            raise ServerError(f"cannot listen on {host} port {port}: {reason}") from None
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _SEND_BUFFER)  # connections inherit it
        self._socket.listen(_BACKLOG)
        self._options.port = self._socket.getsockname()[1]
        return [self._socket]

    def __exit__(self, *_: object) -> None:
        self._socket.close()
