"""``poise live``: devices in, attitude out."""

from __future__ import annotations

import os
import secrets
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading
from poise.cli.words import UsageError, method_choices, usage
from poise.errors import PoiseError

if TYPE_CHECKING:
    from poise.live.hub import Hub
    from poise.live.listening import Options
    from poise.live.server import Server
    from poise.live.watching import Watch


def live(
    sources: Annotated[list[str] | None, Parameter(name="SOURCE", negative="")] = None,
    /,
    *,
    method: Annotated[tuple[str, ...], Parameter(name=["--method", "-m"], negative="")] = ("self-calibrating",),
    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative="")] = (),
    host: str = "127.0.0.1",
    port: int = 8760,
    token: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    allow_host: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    https: Annotated[bool, Parameter(negative="")] = False,
    cert: Path | None = None,
    key: Path | None = None,
    record: Path | None = None,
    describe: Path | None = None,
    tipover: Path | None = None,
    respond: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    joint: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    max_rate: float = 5000.0,
    open: bool | None = None,
    reading: Reading | None = None,
) -> int:
    """Serve the attitude of devices as their samples come.

    SOURCE is where samples come from; any number of them:

    - `ws`: devices connect by themselves and push, to `ws://HOST:PORT/ws/device/NAME`; always on, whatever else is given
    - `phone`: a QR code to a page that makes a phone a device, without an app; `poise live phone --host 0.0.0.0 --https`
    - `replay:FILE`: a recording as a device, `replay:FILE@10` ten times as fast, `@max` as fast as it can be taken
    - `sim:balance`, `sim:arm`, `sim:handle`, `sim:attitude`: a simulated world; `sim:arm?seed=2&pace=0.5@2`
    - `udp::9000`, `udp:127.0.0.1:9000`: datagrams with samples, on all addresses of this machine or one
    - `serial:/dev/ttyUSB0`: text lines or binary frames; unplugged and plugged in again it goes on
    - `mqtt://HOST/TOPIC`: messages at a broker, by default of `poise/+`; the last level names the device
    - `ble:NAME`, `ble:AA:BB:CC:DD:EE:FF`: a device over Bluetooth Low Energy, as --describe says

    Attitudes come out over WebSocket and HTTP; docs/live.md has the protocol, a client of ten lines and a `curl` example.
    Only this machine can connect unless --host says otherwise, and then a --token is needed.

    Examples: `poise live`; `poise live sim:balance`; `poise live replay:walk.csv -m self-calibrating -m two-stage`;
    `poise live --host 0.0.0.0 --token $(openssl rand -hex 16)`

    Parameters
    ----------
    sources
        Where samples come from.
    method
        What runs on every device; repeat for several side by side.
    set_
        A parameter, `NAME=VALUE`, of every method above that has it.
    host
        The address to listen on.
    port
        The port; 0 takes a free one.
    token
        What clients must show; `read:…`, `write:…` and `device:…` (or `read+write:…`) may do just that, a bare one
        everything. Repeat for more. The environment's POISE_TOKEN counts, too, and is not seen in a list of processes.
    allow_host
        One more name that this machine goes by.
    https
        Serve over HTTPS, with a certificate that this machine makes for itself and keeps; browsers ask whether to trust it.
    cert
        A certificate of your own instead, in PEM format; with --key.
    key
        Its key.
    record
        A folder to keep samples and attitudes in, as Parquet files, one a device and one a method of it. A device is
        told what is on the disk. After a crash the same command goes on where it was; `poise recover` just saves what is there.
    describe
        A TOML file that says what text lines or binary frames from a serial port, UDP, MQTT or BLE mean; see docs/live.md.
    tipover
        A TOML file with the tip-over monitor's parameters, as for `poise tipover`: every device is watched.
    respond
        `DEVICE=FILE.toml`: what answers when that device tips over, as for `poise respond`, with the monitor's parameters in
        the same file. Repeat for more devices. `POST /devices/DEVICE/acknowledge` says that an alarm has been seen.
    joint
        `NAME=SEGMENT/BASE`: how the device SEGMENT stands seen from the device BASE, as a device of its own. Repeat for more.
    max_rate
        Samples a second above which a device is cut off.
    open
        Open the page in a browser; done unless told where there is a terminal and a screen.
    """
    try:
        server = _server(
            sources or [],
            method,
            set_,
            (host, port, token, allow_host, "phone" in (sources or [])),
            (https, cert, key),
            (record, describe, tipover),
            respond,
            joint,
            max_rate,
            reading or Reading(),
        )
    except UsageError as error:
        show.problem(error)
        return 2
    except PoiseError as error:
        show.problem(error)
        return 1
    from poise.live.serving import run

    try:
        run(_told(server, "phone" in (sources or []), open))
    except (PoiseError, OSError) as error:
        show.problem(error)
        return 1
    return 0


def _server(
    words: list[str],
    names: tuple[str, ...],
    settings: tuple[str, ...],
    where: Any,
    secure: tuple[bool, Path | None, Path | None],
    files: tuple[Path | None, Path | None, Path | None],
    respond: tuple[str, ...],
    joints: tuple[str, ...],
    max_rate: float,
    reading: Reading,
) -> Server:
    from poise.live.serving import check_installed

    check_installed()
    from poise.live.access import AccessError
    from poise.live.described import Description
    from poise.live.devices import DeviceError
    from poise.live.hub import Hub
    from poise.live.server import Server
    from poise.live.sources import apart, source

    record, describe, tipover = files
    if not 1.0 <= max_rate <= 1e6:
        usage(f"--max-rate {max_rate}: expected samples a second, 1 to 1e6")
    hub = Hub(method_choices(names, settings), max_rate, _watch(tipover, respond))
    _add_joints(hub, joints)
    try:
        options = _options(*where)
        options.certificate = _certificate(options, *secure)
        description = Description.read(describe) if describe is not None else None
        found = apart([each for word in words if (each := source(word, reading.read, description)) is not None])
        recorder = None
        if record is not None:
            from poise.live.recorder import Recorder
            from poise.live.session import Session

            recorder = Recorder(Session.below(record))
        return Server(hub, found, options, recorder)
    except (AccessError, DeviceError) as error:
        usage(str(error))


def _add_joints(hub: Hub, joints: tuple[str, ...]) -> None:
    for text in joints:
        name, equals, devices = text.partition("=")
        segment, slash, base = devices.partition("/")
        if not (equals and slash) or name in hub.joints.all:
            usage(f"--joint {text!r}: expected NAME=SEGMENT/BASE, once a name")
        try:
            hub.set_joint(name, segment, base)
        except PoiseError as error:
            usage(f"--joint {text!r}: {error}")


def _watch(tipover: Path | None, respond: tuple[str, ...]) -> Watch | None:
    if tipover is None and not respond:
        return None
    from poise.live.watching import Watch
    from poise.monitor import from_table, read_settings
    from poise.responses import Responses

    usual = read_settings(tipover) if tipover is not None else None
    own, responses = {}, {}
    for text in respond:
        device, equals, file = text.partition("=")
        if not (device and equals and file) or device in responses:
            usage(f"--respond {text!r}: expected DEVICE=FILE.toml, once a device")
        responses[device] = Responses.from_toml(file)
        table = responses[device].config.tipover
        if table is not None:
            own[device] = from_table(table, usual)
    return Watch(usual, own, responses)


def _options(host: str, port: int, tokens: tuple[str, ...], hosts: tuple[str, ...], phone: bool) -> Options:
    from poise.live.access import SCOPES, loopback, parsed_tokens
    from poise.live.listening import Options

    if not 0 <= port <= 65535:
        usage(f"--port {port}: expected 0 to 65535")
    if secret := os.environ.get("POISE_TOKEN"):
        tokens = (*tokens, secret)
    options = Options(host, port, parsed_tokens(tokens), hosts)
    if phone and not loopback(host):
        if not options.tokens:
            options.made_token = secrets.token_hex(12)
            options.tokens[options.made_token] = frozenset(SCOPES)
        own = [token for token, scopes in options.tokens.items() if scopes == {"device"}]
        options.phone_token = own[0] if own else secrets.token_hex(12)
        options.tokens[options.phone_token] = frozenset({"device"})
    return options


def _certificate(options: Options, https: bool, cert: Path | None, key: Path | None) -> tuple[Path, Path] | None:
    if (cert is None) != (key is None):
        usage("--cert and --key belong together: a certificate and its key, in PEM format")
    if cert is None and not https:
        return None
    from poise.live import certificate

    if cert is not None and key is not None:
        return certificate.check(cert, key)
    options.own_certificate = True
    return certificate.own_certificate(certificate.names_of(options.host, options.hosts))


async def _told(server: Server, phone: bool, opened: bool | None) -> None:
    """Runs *server* and says where it is and what happens to its devices."""
    import asyncio

    from poise.cli.page import show_in_browser
    from poise.cli.phone import addresses, page_address, tell_phone

    server.hub.on_event.append(lambda event: show.note(event["text"]))
    ready = asyncio.Event()

    async def tell() -> None:
        await ready.wait()
        for line in addresses(server.options):
            print(line, flush=True)
        if phone:
            tell_phone(server.options, sys.stdout)
        await asyncio.to_thread(show_in_browser, page_address(server.options), opened)

    telling = asyncio.create_task(tell())
    try:
        await server.run(ready)
    finally:
        telling.cancel()
    print(f"ended: {sum(d.health.samples for d in server.hub.devices.values())} samples", flush=True)
