"""What was recorded, to be downloaded: the files of finished sessions, and those of the one that runs as far as it is."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any
from urllib.parse import quote

from poise.errors import PoiseError
from poise.live import parts

if TYPE_CHECKING:
    from collections.abc import Iterable

    from poise.live.device import Device
    from poise.live.session import Session

CURRENT = "current"
_TRIES = 5  # a journal file may become a Parquet part while it is read


class NoRecording(PoiseError):
    """A file that is not among the recordings."""


def finished(root: Path) -> dict[str, Path]:
    """The files of the finished sessions below *root* by name: ``SESSION/FILE``."""
    found = {}
    for folder in sorted(root.iterdir()) if root.is_dir() else ():
        if folder.is_symlink() or not folder.is_dir() or (folder / "journal").exists() or folder.name == CURRENT:
            continue
        for path in sorted(folder.glob("*.parquet")):
            if path.is_file() and not path.is_symlink():
                found[f"{folder.name}/{path.name}"] = path
    return found


def running(devices: Iterable[Device]) -> dict[str, str]:
    """The files that the running session has so far, each with its device."""
    found = {}
    for device in devices:
        found[f"{CURRENT}/{device.name}.parquet"] = device.name
        for run in device.runs:
            kind = parts.named(run.choice.name, run.choice.settings)
            found[f"{CURRENT}/{device.name}.{kind}.attitude.parquet"] = device.name
    return found


def listed(session: Session, devices: Iterable[Device]) -> list[dict[str, Any]]:
    """All of them, for pages; how many bytes one of the running session has is not known before it is made."""
    ready = [(name, path.stat().st_size) for name, path in finished(session.root).items()]
    both = [*ready, *((name, None) for name in running(devices))]
    return [{"name": name, "bytes": size, "url": f"/recordings/{quote(name)}"} for name, size in both]


def snapshot(session: Session, device: str, file: str) -> IO[bytes]:
    """What is on the disk of *device* by now, as the Parquet file *file*; it is gone once it is closed.

    Nothing of the recording is touched. Raises :class:`NoRecording` where nothing is there yet.
    """
    for _ in range(_TRIES):
        with tempfile.TemporaryDirectory(prefix="poise-") as name:
            work, made = Path(name) / "parts", Path(name) / "made"
            work.mkdir()
            made.mkdir()
            try:
                numbers = set()
                for number, path in session.files():
                    parts.convert(path, number, work, only=device)
                    numbers.add(number)
            except FileNotFoundError:
                continue  # it has become a part
            for number, path in parts.those_of(device, session.journal):
                if number not in numbers:
                    (work / path.name).symlink_to(path.resolve())
            parts.join(work, made)
            if (made / file).is_file():
                return (made / file).open("rb")
            break
    raise NoRecording(f"{file}: nothing of it is on the disk yet")
