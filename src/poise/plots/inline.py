"""A picture as SVG for a page: its text is text, and the page's style decides on light or dark."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING

from poise.plots import style
from poise.plots.attitude import SHADES as ATTITUDE_SHADES
from poise.plots.comparison import ABSENT, SHADES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAMES = {
    style.INK: "ink",
    style.QUIET: "quiet",
    style.PALE: "pale",
    style.EDGE: "edge",
    style.GRID: "grid",
    style.PAPER: "paper",
    style.BLUE: "blue",
    style.ORANGE: "orange",
    style.GREEN: "green",
    style.PURPLE: "purple",
    ABSENT: "absent",
    **{shade: f"shade-{i}" for i, shade in enumerate(SHADES)},
    **{colour: f"mark-{i}" for i, (colour, _) in enumerate(ATTITUDE_SHADES)},
}
"""the names of the colours: a page gives each a value as --NAME"""


_DECIMALS = re.compile(r"-?\d+\.\d{2,}")  # of a point, 1/72 in: a tenth is finer than any screen


def inline_svg(figure: Figure, key: str, description: str) -> str:
    """*figure* as an ``<svg>`` element that loads nothing and refers to nothing outside itself.

    *key* is its own among the pictures of the page; *description* (plain text) is what is read out instead of it.
    """
    from html import escape

    from matplotlib import rc_context

    buffer = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": key}), style.quiet():
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    svg = buffer.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<!--.*?-->\n?", "", svg, flags=re.DOTALL)  # a copy of every text, which may be anything
    box = re.search(r'viewBox="[^"]*"', svg)
    start = f'<svg role="img" aria-label="{escape(description, quote=True)}" {box[0] if box else ""}>'
    svg = start + svg[svg.index(">") + 1 :].rstrip()
    svg = svg.replace("xlink:href", "href")
    svg = re.sub(r'(?<= d=")[^"]+', lambda m: _short(m[0]), svg)
    used = set(re.findall(r'href="#([^"]+)"|url\(#([^)]+)\)', svg))
    kept = {name for pair in used for name in pair if name}
    svg = re.sub(r' id="([^"]+)"', lambda m: m[0] if m[1] in kept else "", svg)
    svg = re.sub(r"<style[^>]*>.*?</style>", "", svg, flags=re.DOTALL)  # the page's own says the same
    svg = "".join(c for c in svg if c.isprintable() or c == "\n")  # a name may hold anything
    named = {colour.lower(): name for colour, name in NAMES.items()}
    return re.sub(
        r"(?<=[:\s])#[0-9a-f]{6}(?=[;\"\s])", lambda m: f"var(--{named[m[0]]})" if m[0] in named else m[0], svg
    )


def _short(path: str) -> str:
    """The same path with fewer characters: a long recording has tens of thousands of points."""
    path = _DECIMALS.sub(lambda n: f"{float(n[0]):.1f}", path)
    path = re.sub(r"\s+", " ", path).strip()
    return path if re.search("[CQ]", path) else path.replace(" L ", " ")  # lines are what follows a move
