"""The page in a browser: where a server is, and opening it."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from poise.live.listening import Options


def address(options: Options) -> str:
    """Where the page of a server is, once it listens."""
    from poise.live.address import base, listens_everywhere

    return base(options, "127.0.0.1" if listens_everywhere(options.host) else options.host)


def show_in_browser(where: str, wanted: bool | None) -> None:
    """Opens *where* in the user's browser: where *wanted*, or, unless told, where someone sits at a terminal.

    Only if there is a screen for one, and never a browser of the terminal.
    """
    import webbrowser

    if wanted is None:
        wanted = sys.stdout.isatty()
    screen = bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")) or not sys.platform.startswith(
        "linux"
    )
    if wanted and screen:
        webbrowser.open(where)
