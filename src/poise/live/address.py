"""Addresses of this machine, the one that a phone is to open, and its QR code."""

from __future__ import annotations

import ipaddress
import socket
from contextlib import suppress
from typing import TYPE_CHECKING, TextIO

from poise.live.access import loopback

if TYPE_CHECKING:
    from poise.live.listening import Options

_FAR = (("192.0.2.1", socket.AF_INET), ("2001:db8::1", socket.AF_INET6))  # for documentation: nobody has them


def own_addresses() -> list[str]:
    """The addresses that other machines reach this one at, the one on the way out first."""
    found: list[str] = []
    for far, family in _FAR:
        with suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((far, 9))  # says which way a datagram would go; none is sent
            found.append(probe.getsockname()[0])
    with suppress(OSError):
        found += [str(each[4][0]).partition("%")[0] for each in socket.getaddrinfo(socket.gethostname(), None)]
    usable = [a for a in found if not (ipaddress.ip_address(a).is_loopback or ipaddress.ip_address(a).is_link_local)]
    return list(dict.fromkeys(usable))


def listens_everywhere(host: str) -> bool:
    """Whether *host* stands for all addresses of this machine."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_unspecified
    except ValueError:
        return False


def base(options: Options, host: str) -> str:
    """The address of the server's pages by the name or address *host*."""
    name = f"[{host}]" if ":" in host else host
    return f"{'https' if options.certificate else 'http'}://{name}:{options.port}/"


def for_phones(options: Options) -> str | None:
    """The address that a phone is to open, with its token in the fragment, which browsers send nowhere; None where no
    phone can get here."""
    if loopback(options.host) or not options.phone_token:
        return None
    host = options.host
    if listens_everywhere(host):
        wanted = [a for a in own_addresses() if ":" not in a or ":" in host]
        if not wanted:
            return None
        host = wanted[0]
    return f"{base(options, host)}phone#token={options.phone_token}"


def show_qr(text: str, out: TextIO) -> None:
    """Writes the QR code of *text* for a terminal, two rows in a line, white on black whatever the terminal's colours are."""
    import io

    import segno

    drawn = io.StringIO()
    segno.make(text, error="l", micro=False).terminal(drawn, compact=True, border=2)
    for line in drawn.getvalue().splitlines():
        out.write(f"\x1b[97;40m{line}\x1b[0m\n")


def svg_qr(text: str) -> bytes:
    """The QR code of *text* as an SVG file, black on white so that it can be read from a dark page, too."""
    import io

    import segno

    out = io.BytesIO()
    title = "QR code of the address for a phone"
    segno.make(text, error="m", micro=False).save(
        out, kind="svg", border=3, scale=4, light="#fff", title=title, xmldecl=False, omitsize=True
    )
    return out.getvalue()
