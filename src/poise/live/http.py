"""The addresses of the server; the only module that imports starlette."""

from __future__ import annotations

import asyncio
import json
import os
import time
from collections.abc import AsyncIterator, MutableMapping
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np

from poise.data.attitude import Attitude
from poise.errors import PoiseError
from poise.live.access import App, Receive, Scope, Send
from poise.live.address import for_phones, svg_qr
from poise.live.certificate import public_part
from poise.live.hub import HubError
from poise.live.joint import Joint
from poise.live.metrics import metrics
from poise.live.recordings import NoRecording, finished, listed, running, snapshot
from poise.live.sockets import DeviceSocket, Viewer, accept

if TYPE_CHECKING:
    from starlette.requests import Request
    from starlette.responses import Response

    from poise.live.server import Server

_PARQUET = "application/vnd.apache.parquet"
_NO_PAGE = """poise live is running. Its dashboard is not part of this installation; what it serves:

GET  /devices                      devices and their methods
GET  /devices/NAME/attitude        the latest attitude
PUT  /devices/NAME/methods         change what a device runs
POST /devices/NAME/heading         "this way is forward"
POST /devices/NAME/acknowledge     an alarm was seen: what holds until then may end
PUT  /joints/NAME                  a device seen from another: {"segment": …, "base": …}; DELETE
GET  /methods                      methods and their parameters
GET  /events                       what happens, as server-sent events
GET  /phone                        a page that makes a phone a device
GET  /recordings, /recordings/NAME  what was recorded, as Parquet files
GET  /healthz, /metrics            health, for people and for Prometheus
WS   /ws/view                      attitudes as they come
WS   /ws/device/NAME               samples in
"""


def needed(method: str, path: str) -> Scope | None:
    """The scope that a request takes."""
    if path.startswith("/ws/device/"):
        return "device"
    if path == "/healthz":
        return None
    if path == "/phone/qr.svg":
        return "write"  # it holds a token that devices push with
    if path.startswith(("/devices", "/joints", "/methods", "/events", "/metrics", "/ws/view", "/recordings", "/films")):
        return "read" if method in ("GET", "HEAD") else "write"
    return None  # the page itself holds no data


def application(server: Server) -> App:
    """The application, without the gate before it."""
    from starlette.applications import Starlette
    from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response, StreamingResponse
    from starlette.routing import Mount, Route, WebSocketRoute
    from starlette.staticfiles import StaticFiles

    from poise.live.server import DASHBOARD, PHONE

    hub = server.hub

    async def devices(request: Request) -> Response:
        return JSONResponse(server.device_list()["devices"])

    async def attitude(request: Request) -> Response:
        name = request.path_params["name"]
        device = hub.joints.all.get(name) or hub.find(name)
        record = hub.latest(device, request.query_params.get("method"))
        if record is None:
            return JSONResponse({"error": f"{device.name} has sent no sample yet"}, 404)
        return JSONResponse(as_json(record, device.name, isinstance(device, Joint)))

    async def methods(request: Request) -> Response:
        return JSONResponse(server.hello()["methods"])

    async def change(request: Request) -> Response:
        kind = "methods" if request.method == "PUT" else "reset_heading"
        asked = await _object(request, "methods" if kind == "methods" else None)
        server.change(kind, asked | {"device": request.path_params["name"]})
        return JSONResponse(hub.find(request.path_params["name"]).described())

    async def joint(request: Request) -> Response:
        name = request.path_params["name"]
        if request.method == "DELETE":
            server.change("remove_joint", {"name": name})
            return Response(status_code=204)
        server.change("joint", await _object(request) | {"name": name})
        return JSONResponse(hub.joints.all[name].described(hub.devices))

    async def acknowledge(request: Request) -> Response:
        name = request.path_params["name"]
        return JSONResponse({"device": name, "holding": server.acknowledge(name)})

    making = asyncio.Lock()  # one at a time: making a file takes a core

    async def recordings(request: Request) -> Response:
        session = None if server.recorder is None else server.recorder.session
        found = [] if session is None else await asyncio.to_thread(listed, session, list(hub.devices.values()))
        return JSONResponse(found)

    async def recording(request: Request) -> Response:
        name = "{session}/{file}".format(**request.path_params)
        if server.recorder is None:
            raise NoRecording(f"{name[:160]}: this server does not record; --record FOLDER does")
        session, file = server.recorder.session, request.path_params["file"]
        attachment = {"content-disposition": f"attachment; filename*=utf-8''{quote(file)}"}
        if path := (await asyncio.to_thread(finished, session.root)).get(name):
            return FileResponse(path, media_type=_PARQUET, headers=attachment)
        device = running(hub.devices.values()).get(name)
        if device is None:
            raise NoRecording(f"no recording {name[:160]!r}; GET /recordings lists them")
        async with making:
            made = await asyncio.to_thread(snapshot, session, device, file)
        size = str(os.fstat(made.fileno()).st_size)

        async def pieces() -> AsyncIterator[bytes]:
            with made:
                while piece := await asyncio.to_thread(made.read, 1 << 18):
                    yield piece

        return StreamingResponse(pieces(), media_type=_PARQUET, headers=attachment | {"content-length": size})

    async def films(request: Request) -> Response:
        hello = {key: server.hello()[key] for key in ("server", "flags", "invalid_flags")}
        return JSONResponse(hello | {"films": [film.described(k) for k, film in enumerate(server.films)]})

    async def film_frame(request: Request) -> Response:
        number, asked = request.path_params["number"], request.query_params
        if not 0 <= number < len(server.films):
            return JSONResponse({"error": f"no film {number}; there are {len(server.films)}"}, 404)
        film = server.films[number]
        usual = {"start": film.start, "end": film.end, "most": 4000.0}
        try:
            start, end, most = (float(asked.get(name, value)) for name, value in usual.items())
        except ValueError as problem:
            raise HubError(f"start, end and most are numbers: {problem}") from None
        frame = await asyncio.to_thread(film.frame, number, start, end, most)
        return Response(frame, media_type="application/octet-stream", headers={"cache-control": "no-store"})

    async def events(request: Request) -> Response:
        after = request.headers.get("last-event-id") or request.query_params.get("after") or "0"

        async def lines() -> AsyncIterator[str]:
            yield ": poise\n\n"
            async for event in server.events(int(after) if after.isdecimal() and len(after) < 20 else 0):
                yield f"id: {event['number']}\nevent: {event['kind']}\ndata: {json.dumps(event)}\n\n"

        return StreamingResponse(lines(), media_type="text/event-stream", headers={"cache-control": "no-store"})

    async def healthz(request: Request) -> Response:
        healthy, reasons = server_health(server)
        answer: dict[str, Any] = {"status": "ok" if healthy else "degraded"}
        if "read" in request.scope["poise_scopes"]:
            answer |= {"reasons": reasons} | {k: v for k, v in server.health().items() if k != "type"}
        return JSONResponse(answer, 200 if healthy else 503)

    async def prometheus(request: Request) -> Response:
        return PlainTextResponse(metrics(server), media_type="text/plain; version=0.0.4; charset=utf-8")

    async def phone(request: Request) -> Response:
        return FileResponse(PHONE / "index.html", headers={"cache-control": "no-cache"})

    async def qr(request: Request) -> Response:
        link = for_phones(server.options)
        if link is None:
            return JSONResponse({"error": "no phone can get here: `poise live phone --host 0.0.0.0 --https`"}, 404)
        return Response(svg_qr(link), media_type="image/svg+xml", headers={"cache-control": "no-store"})

    async def own_certificate(request: Request) -> Response:
        if server.options.certificate is None:
            return JSONResponse({"error": "this server has no certificate: it was started without --https"}, 404)
        return Response(public_part(server.options.certificate[0]), media_type="application/x-x509-ca-cert")

    async def no_page(request: Request) -> Response:
        return PlainTextResponse(_NO_PAGE)

    async def refused(request: Request, problem: Exception) -> Response:
        absent = isinstance(problem, NoRecording) or str(problem).startswith(("no device", "no joint"))
        status = 404 if absent else 503 if isinstance(problem, OSError) else 400
        return JSONResponse({"error": str(problem) or type(problem).__name__}, status)

    page: Any = Mount("/", StaticFiles(directory=DASHBOARD, html=True)) if DASHBOARD.is_dir() else Route("/", no_page)
    app: Any = Starlette(
        routes=[
            Route("/devices", devices),
            Route("/devices/{name}/attitude", attitude),
            Route("/devices/{name}/methods", change, methods=["PUT"]),
            Route("/devices/{name}/heading", change, methods=["POST"]),
            Route("/devices/{name}/acknowledge", acknowledge, methods=["POST"]),
            Route("/joints/{name}", joint, methods=["PUT", "DELETE"]),
            Route("/methods", methods),
            Route("/films", films),
            Route("/films/{number:int}/frame", film_frame),
            Route("/recordings", recordings),
            Route("/recordings/{session}/{file}", recording),
            Route("/events", events),
            Route("/healthz", healthz),
            Route("/metrics", prometheus),
            Route("/phone", phone),
            Route("/phone/qr.svg", qr),
            Route("/phone/certificate.crt", own_certificate),
            Mount("/phone", StaticFiles(directory=PHONE)),
            WebSocketRoute("/ws/view", _View(server)),
            WebSocketRoute("/ws/device/{name}", _Push(server)),
            page,
        ],
        exception_handlers={PoiseError: refused, ValueError: refused, RecursionError: refused, OSError: refused},
    )
    server.offers = ["/phone", *(["/recordings"] if server.recorder is not None else [])]
    return app  # type: ignore[no-any-return]


class _View:
    """An ASGI application and not a coroutine: starlette would wrap every message of one in an object of its own."""

    def __init__(self, server: Server) -> None:
        self._server = server

    async def __call__(self, scope: MutableMapping[str, Any], receive: Receive, send: Send) -> None:
        await receive()
        await send(accept(scope))
        await Viewer(self._server, send, scope["poise_scopes"]).run(receive)


class _Push:
    def __init__(self, server: Server) -> None:
        self._server = server

    async def __call__(self, scope: MutableMapping[str, Any], receive: Receive, send: Send) -> None:
        await receive()
        try:
            if self._server.films:
                raise HubError("this is `poise view`, which plays recordings: devices push to `poise live`")
            socket = DeviceSocket(self._server, scope["path_params"]["name"], send, scope.get("query_string", b""))
        except PoiseError as problem:
            await send({"type": "websocket.http.response.start", "status": 400, "headers": []})
            await send({"type": "websocket.http.response.body", "body": f"{problem}\n".encode()})
            return
        await send(accept(scope))
        await socket.run(receive)


def server_health(server: Server) -> tuple[bool, list[str]]:
    """Whether all is well, and what is not."""
    devices = server.hub.devices.values()
    reasons = [f"{d.name} is silent" for d in devices if d.health.silent and d.silent_for(1.0)]
    reasons += [f"{d.name}: its clock stands still" for d in devices if d.standstill.standing and not d.failed]
    bad = [f"{c['name']}: {c['text']}" for c in server.feeding.conditions() if c["state"] in ("waiting", "failed")]
    bad += [f"{d.name}: its run has ended by a fault: {d.failed}" for d in devices if d.failed]
    bad += server.missing.reasons()
    if server.hub.guarding.overloaded(time.monotonic()):
        bad.append("overloaded: ticks are late, so that silence is told later")
    if server.recorder is not None and (reason := server.recorder.condition()["reason"]):
        bad.append(f"not recording: {reason}")
    return not bad, bad + reasons


_EXPECTED = {
    None: "an object such as {}",
    "methods": '{"methods": [{"name": "two-stage", "settings": {}}]}',
}


async def _object(request: Request, of_list: str | None = None) -> dict[str, Any]:
    """The JSON object of a request; a list stands for one whose only key is *of_list*."""
    body = b""
    async for piece in request.stream():
        body += piece
        if len(body) > 65536:
            raise HubError("more than 64 KiB")
    try:
        asked = json.loads(body or b"{}")
    except (ValueError, RecursionError) as problem:
        found = body[:60].decode("utf-8", "replace")
        raise HubError(f"not JSON: {found!r} ({problem}); expected {_EXPECTED[of_list]}") from None
    if of_list is not None and isinstance(asked, list):
        asked = {of_list: asked}
    if not isinstance(asked, dict):
        raise HubError("expected a JSON object")
    return asked


def as_json(record: Any, name: str, relative: bool = False) -> dict[str, Any]:
    """A record of :data:`poise.live.frames.ATTITUDE` for people and scripts; NaN becomes null.

    An attitude *relative* to another device has an ``angle_deg``, and neither heading nor tilt.
    """
    from poise.data.flags import Flag

    quat = np.array([record["quat"]], float)
    known = bool(np.isfinite(quat).all())
    attitude = Attitude.of([float(record["time"])], quat)
    yaw = np.degrees(attitude.euler("ZYX")[0]) if known else [float("nan")] * 3
    earth = known and not relative
    return {
        "device": name,
        "time": _number(record["time"]),
        "host_time": _number(record["host"]),
        "sequence": int(record["sequence"]),
        "quat_wxyz": [_number(v) for v in record["quat"]],
        "heading_deg": _number(degrees(float(attitude.heading()[0])) % 360.0) if earth else None,
        "tilt_deg": _number(degrees(float(attitude.tilt()[0]))) if earth else None,
        **({"angle_deg": _number(degrees(float(attitude.angle()[0])))} if relative else {}),
        "yaw_pitch_roll_deg": [_number(v) for v in yaw],
        "rate": [_number(v) for v in record["rate"]],
        "sigma": [_number(v) for v in record["sigma"]],
        "valid": bool(record["valid"]),
        "flags": [flag.name for flag in Flag if int(record["flags"]) & flag],
    }


def _number(value: Any) -> float | None:
    return float(value) if isfinite(value) else None
