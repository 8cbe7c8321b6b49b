"""Who may do what: tokens and their scopes, origins, hosts, and the headers that keep pages to themselves."""

from __future__ import annotations

import hmac
import ipaddress
import re
import socket
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from typing import Any, Literal

from poise.errors import PoiseError

Scope = Literal["read", "write", "device"]
SCOPES: tuple[Scope, ...] = ("read", "write", "device")
_TOKEN = re.compile(r"[A-Za-z0-9._~-]{16,256}")
_HEADERS = [
    (
        b"content-security-policy",
        b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
        b"connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
        b"frame-ancestors 'none'",
    ),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"permissions-policy", b"accelerometer=(self), gyroscope=(self), magnetometer=(self), camera=(), microphone=()"),
]

Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
App = Callable[[MutableMapping[str, Any], Receive, Send], Awaitable[None]]


class AccessError(PoiseError):
    """Tokens or an address that the server must not be started with."""


def parsed_tokens(texts: tuple[str, ...]) -> dict[str, frozenset[Scope]]:
    """Tokens and their scopes from ``TOKEN`` (all scopes) or ``read+device:TOKEN``.

    Raises :class:`AccessError`, which does not repeat the token, for one that is too short or has other characters than
    letters, digits and ``. _ ~ -``, and for a scope that does not exist.
    """
    found: dict[str, frozenset[Scope]] = {}
    for text in texts:
        names, colon, token = text.rpartition(":")
        scopes = frozenset(s for s in SCOPES if s in names.split("+")) if colon else frozenset(SCOPES)
        if colon and len(scopes) != len(names.split("+")):
            raise AccessError(f"a token's scopes are {', '.join(SCOPES)}, joined by +, before a colon")
        if not _TOKEN.fullmatch(token):
            raise AccessError("a token has 16 to 256 letters, digits or . _ ~ -; `openssl rand -hex 16` makes one")
        found[token] = found.get(token, frozenset()) | scopes
    return found


def loopback(host: str) -> bool:
    """Whether *host* is reached from this machine only."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return host == "localhost"


class Access:
    """The rules for one server. Raises :class:`AccessError` for a *host* beyond loopback without a token."""

    def __init__(self, host: str, tokens: Mapping[str, frozenset[Scope]], hosts: tuple[str, ...] = ()) -> None:
        if not tokens and not loopback(host):
            raise AccessError(
                f"--host {host} is reached from other machines: give --token, or leave it out and use 127.0.0.1"
            )
        self._tokens = {token.encode(): scopes for token, scopes in tokens.items()}
        name = socket.gethostname().lower()
        self._hosts = {"localhost", name, f"{name}.local", host.lower(), *(each.lower() for each in hosts)}

    def host_known(self, host: str) -> bool:
        """Whether a Host header names this machine: by its name, or by an address, which no foreign name can stand for."""
        name = _without_port(host)
        try:
            ipaddress.ip_address(name.strip("[]"))
            return True
        except ValueError:
            return name in self._hosts

    def scopes(self, token: bytes | None) -> frozenset[Scope]:
        """What the bearer of *token* may do; every token is compared in constant time."""
        if not self._tokens:
            return frozenset(SCOPES)
        found: frozenset[Scope] = frozenset()
        for known, scopes in self._tokens.items():
            if token is not None and hmac.compare_digest(known, token):
                found |= scopes
        return found


class Gate:
    """The application *app* behind the rules: foreign names and origins get 403, who may not 401, before any upgrade.

    *needed* says which scope a method and path take; None for none.
    """

    def __init__(self, app: App, access: Access, needed: Callable[[str, str], Scope | None]) -> None:
        self._app, self._access, self._needed = app, access, needed

    async def __call__(self, scope: MutableMapping[str, Any], receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            return await self._app(scope, receive, send)
        headers = {name.lower(): value for name, value in scope["headers"]}
        refusal = self._refusal(scope, headers)
        if refusal is not None:
            return await _refuse(scope, receive, send, *refusal)

        async def sent(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", ()), *_HEADERS]
            await send(message)

        return await self._app(scope, receive, sent)

    def _refusal(self, scope: MutableMapping[str, Any], headers: dict[bytes, bytes]) -> tuple[int, str] | None:
        host = headers.get(b"host", b"").decode("latin-1").lower()
        if not self._access.host_known(host):
            return 403, "this server does not go by that name; --allow-host adds one"
        origin = headers.get(b"origin")
        if origin is not None and origin.decode("latin-1").lower() not in (f"http://{host}", f"https://{host}"):
            return 403, "pages of other origins may not use this server"
        token = bearer(scope, headers)
        scope["poise_scopes"] = allowed = self._access.scopes(token)
        need = self._needed(scope.get("method", "GET"), scope["path"])
        if need is not None and need not in allowed:
            return 401, f"a token with the scope {need!r} is needed: `Authorization: Bearer TOKEN`"
        return None


def bearer(scope: MutableMapping[str, Any], headers: dict[bytes, bytes]) -> bytes | None:
    """The token of a request: of its Authorization header or, as pages cannot set that, a subprotocol ``bearer.TOKEN``."""
    kind, _, token = headers.get(b"authorization", b"").partition(b" ")
    if kind.lower() == b"bearer":
        return token.strip()
    for protocol in scope.get("subprotocols", ()):
        if protocol.startswith("bearer."):
            return str(protocol)[len("bearer.") :].encode("latin-1", "replace")
    return None


def _without_port(host: str) -> str:
    if host.startswith("["):
        return host.partition("]")[0] + "]"
    return host.partition(":")[0]


async def _refuse(scope: MutableMapping[str, Any], receive: Receive, send: Send, status: int, text: str) -> None:
    kind = "websocket.http.response" if scope["type"] == "websocket" else "http.response"
    headers = [(b"content-type", b"text/plain; charset=utf-8"), *_HEADERS]
    if status == 401:
        headers.append((b"www-authenticate", b"Bearer"))
    if scope["type"] == "websocket":
        await receive()
    await send({"type": f"{kind}.start", "status": status, "headers": headers})
    await send({"type": f"{kind}.body", "body": f"{text}\n".encode()})
