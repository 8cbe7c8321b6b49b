"""uvicorn, as this server runs it: the only module that imports it."""

from __future__ import annotations

import asyncio
import resource
import socket
from collections.abc import Coroutine
from contextlib import suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from poise.errors import PoiseError

if TYPE_CHECKING:
    from poise.live.server import Server

_NEEDED = ("starlette", "uvicorn", "websockets", "cryptography", "segno")
_MOST_BYTES = 1 << 20  # of a message that comes in
_CLOSING = 0.5  # s
_MOST_CONNECTIONS = 20_000


async def serve(server: Server, sockets: list[socket.socket], ready: asyncio.Event | None) -> None:
    """Serves *server*'s application on *sockets* until its ``stopping`` is set."""
    import uvicorn
    from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

    class Protocol(WebSocketsSansIOProtocol):
        """Whoever is cut off and does not answer is not listened to for 10 s more."""

        def __init__(self, *arguments: Any, **named: Any) -> None:
            super().__init__(*arguments, **named)
            self.close_timeout = _CLOSING

        def shutdown(self) -> None:
            """As uvicorn's, but for a connection that the other side is closing at this moment: nothing is left to say."""
            if self.handshake_complete and not self.close_sent and self.conn.state.name != "OPEN":
                self.stop_keepalive()
                self.queue.put_nowait({"type": "websocket.disconnect", "code": 1012})
                self.transport.close()
            else:
                super().shutdown()

    _allow_connections()
    certificate = server.options.certificate
    config = uvicorn.Config(
        server.app,
        ws=Protocol,
        ws_max_size=_MOST_BYTES,
        ws_per_message_deflate=False,  # binary numbers do not shrink, and a megabyte of nothing shrinks too well
        ws_ping_interval=20.0,
        ws_ping_timeout=20.0,
        access_log=False,  # addresses of pages may hold what is nobody else's business
        log_level="critical",
        lifespan="off",
        server_header=False,
        timeout_graceful_shutdown=2,
        limit_concurrency=_MOST_CONNECTIONS,
        ssl_certfile=certificate and str(certificate[0]),
        ssl_keyfile=certificate and str(certificate[1]),
    )
    inner = uvicorn.Server(config)
    work = asyncio.create_task(inner._serve(sockets))  # `serve` would take over the signals
    waiting = asyncio.create_task(server.stopping.wait())
    while not inner.started and not work.done():
        await asyncio.sleep(0.01)
    if ready is not None:
        ready.set()
    await asyncio.wait((work, waiting), return_when=asyncio.FIRST_COMPLETED)
    inner.should_exit = True
    waiting.cancel()
    await work


def run(work: Coroutine[Any, Any, None]) -> None:
    """Runs *work* in the fastest event loop there is."""
    try:
        import uvloop
    except ImportError:  # it does not exist for every system
        asyncio.run(work)
    else:
        uvloop.run(work)


def check_installed() -> None:
    """Raises :class:`PoiseError` where the extra is not installed."""
    missing = [name for name in _NEEDED if find_spec(name) is None]
    if missing:
        text = f'`poise live` needs the extra "live": pip install "poise[live]" (missing: {", ".join(missing)})'
        raise PoiseError(text)


def _allow_connections() -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(_MOST_CONNECTIONS + 1000, hard)), hard))
