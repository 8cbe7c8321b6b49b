"""What `poise live` says about where it is, and how a phone gets there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TextIO

from poise.cli import show
from poise.cli.page import address

if TYPE_CHECKING:
    from poise.live.listening import Options

_COMMAND = "poise live phone --host 0.0.0.0 --https"


def page_address(options: Options) -> str:
    """Where the dashboard is; with the token only if it was made up just now, or nobody would know it."""
    return address(options) + _token(options)


def addresses(options: Options) -> Iterator[str]:
    """What to open on this machine, and on others."""
    from poise.live.address import base, listens_everywhere, own_addresses

    yield f"poise live on {page_address(options)}  (Ctrl-C ends it)"
    if listens_everywhere(options.host) and (own := own_addresses()):
        yield f"from other machines: {base(options, own[0])}{_token(options)}"


def _token(options: Options) -> str:
    return f"#token={options.made_token}" if options.made_token else ""


def tell_phone(options: Options, out: TextIO) -> None:
    """The address for a phone and, on a terminal, its QR code; or why no phone can get here."""
    from poise.live.access import loopback
    from poise.live.address import for_phones, show_qr

    link = for_phones(options)
    if link is None:
        reason = (
            f"a phone cannot reach {options.host}, which is this machine only: {_COMMAND}"
            if loopback(options.host)
            else "this machine has no address that a phone could reach: is it in a network?"
        )
        show.note(reason)
        return
    print(f"a phone opens {link}", file=out, flush=True)
    if out.isatty() and (out.encoding or "").lower().replace("-", "") == "utf8":
        show_qr(link, out)
        out.flush()
    if options.certificate is None:
        show.note(f"over plain HTTP a phone's browser gives no sensors at all: {_COMMAND}")
    elif options.own_certificate:
        show.note("the phone will ask whether to trust this machine, which made its certificate itself: say yes")
