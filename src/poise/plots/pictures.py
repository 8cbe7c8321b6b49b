"""Pictures that are already drawn, as files: one, or several that move."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from poise.errors import FormatError

MOVING = ".gif"


def save_picture(frames: NDArray[np.uint8], path: str | Path, rate: float = 10.0) -> None:
    """Write one picture (height, width, 3) as PNG, or *frames* (n, height, width, 3), *rate* a second, as GIF.

    The whole file or nothing. Raises :class:`FormatError` for another extension or where the file cannot be written.
    """
    from PIL import Image

    path = Path(path)
    moves = path.suffix.lower() == MOVING
    if not moves and path.suffix.lower() != ".png":
        raise FormatError(f"{path}: cannot draw {path.suffix or 'without an extension'!r}; expected .png or {MOVING}")
    pictures = [Image.fromarray(frame) for frame in np.asarray(frames, np.uint8).reshape(-1, *frames.shape[-3:])]
    beside = path.with_name(f".{path.name[:100]}.part")
    try:
        if moves:
            palette = pictures[len(pictures) // 2].quantize(64)  # one for all: colours do not flicker
            first, *others = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
            first.save(
                beside, "GIF", save_all=True, append_images=others, duration=round(1000 / rate), loop=0, optimize=True
            )
        else:
            pictures[-1].save(beside, "PNG", optimize=True)
        beside.replace(path)
    except OSError as problem:
        raise FormatError(f"{path}: cannot write there: {problem.strerror or problem}") from None
    finally:
        beside.unlink(missing_ok=True)
