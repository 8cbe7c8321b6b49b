"""The page in a browser: where a server is, and opening it."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from poise.live.server import Options


def address(options: Options) -> str:
    """Where the page of a server is, once it listens."""
    name = f"[{options.host}]" if ":" in options.host else options.host
    if options.host in ("0.0.0.0", "::"):
        name = "127.0.0.1"
    return f"{'https' if options.certificate else 'http'}://{name}:{options.port}/"


def show_in_browser(where: str) -> None:
    """Opens *where* in the user's browser, if there is a screen for one: never a browser of the terminal."""
    import webbrowser

    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return
    webbrowser.open(where)
