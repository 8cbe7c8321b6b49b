"""Journal files to Parquet: a part for every device and method of one file, and the parts of all files joined."""

from __future__ import annotations

import io
from collections import defaultdict
from pathlib import Path

import numpy as np

from poise.data import arrow
from poise.data.attitude import Attitude, Provenance
from poise.data.recording import Recording
from poise.formats import write
from poise.formats.saving import replacing
from poise.formats.writing import body
from poise.live import journal
from poise.live.methods import Choice

_KEY = "@"  # between a part's device, method and number: no device has it in its name


def convert(path: Path, number: int, folder: Path, only: str | None = None) -> int:
    """Parts, in *folder*, of journal file *path*, the *number*-th; how many samples there were. Doing it again does no harm.

    *only* is the one device that is wanted.
    """
    samples = defaultdict(list)
    attitudes = defaultdict(list)
    for block in journal.read(path):
        if isinstance(block, journal.Unreadable) or block.kind != journal.SAMPLES:
            continue
        taken: set[str] = set()
        for name, _, start, stop, out, method in block.head["spans"]:
            if only not in (None, name):
                continue
            kind, settings, heading = block.head["methods"][method]
            rows = block.rows[start:stop] if only is None else block.rows[start:stop].copy()
            if name not in taken:
                samples[name].append(rows)
                taken.add(name)
            end = out + stop - start
            made = (rows[:, 0], block.table[out:end], block.flags[out:end])
            if only is not None:  # the rest of the block need not be kept
                made = (made[0], made[1].copy(), made[2].copy())
            attitudes[name, kind, settings].append((*made, heading))
    for name, pieces in samples.items():
        rows = np.concatenate(pieces)
        recording = Recording.at_rate(100.0, np.empty((0, 3)), np.empty((0, 3)), name=name).with_samples(
            time=rows[:, 0],
            gyr=rows[:, 1:4],
            acc=rows[:, 4:7],
            mag=rows[:, 7:10],
            acc_age=rows[:, 10],
            mag_age=rows[:, 11],
        )
        write(recording, folder / f"{name}{_KEY}{_KEY}{number:06d}.parquet")
    order: dict[tuple[str, str], list[str]] = defaultdict(list)
    for (name, kind, settings), found in attitudes.items():
        order[name, kind].append(settings)
        times, tables, flags, headings = zip(*found, strict=True)
        facts = Provenance(type(Choice(kind, settings).method()).__name__, Choice(kind, settings).stream().parameters)
        attitude = Attitude(
            np.concatenate(times), np.concatenate(tables), np.concatenate(flags), headings[-1], "enu", facts
        )
        write(attitude, folder / f"{name}{_KEY}{named(kind, settings)}{_KEY}{number:06d}.parquet")
    return sum(len(rows) for pieces in samples.values() for rows in pieces)


def join(folder: Path, target: Path) -> list[Path]:
    """The parts in *folder* as one file a device and method in *target*; returns their names."""
    kinds = defaultdict(list)
    for path in sorted(folder.glob(f"*{_KEY}*{_KEY}*.parquet")):
        name, kind, _ = path.name.split(_KEY)
        kinds[name, kind].append(path)
    made = []
    for (name, kind), paths in kinds.items():
        made.append(target / (f"{name}.{kind}.attitude.parquet" if kind else f"{name}.parquet"))
        _joined(paths, made[-1])
    return made


def those_of(device: str, folder: Path) -> list[tuple[int, Path]]:
    """The parts of *device* in *folder*, each with its number."""
    found = [(path.stem.split(_KEY), path) for path in folder.glob("*.parquet")]
    return [(int(key[2]), path) for key, path in found if len(key) == 3 and key[0] == device]


def _joined(paths: list[Path], target: Path) -> None:
    from poise.formats.parquet import metadata, opened

    names: dict[str, None] = {}
    for path in paths:
        with opened(str(path), path) as file:
            names |= dict.fromkeys(file.schema_arrow.names)
            facts = metadata(file)
    with replacing(target) as out:
        rows = body("parquet", out, io.BytesIO(), tuple(names))
        for path in paths:
            with opened(str(path), path) as file:
                for group in range(file.metadata.num_row_groups):
                    table = file.read_row_group(group, use_threads=False).replace_schema_metadata(None)
                    absent = arrow.table(
                        {name: np.zeros(len(table)) for name in names if name not in table.column_names}
                    )
                    for i, name in enumerate(absent.column_names):  # ages that are all 0 are left out of a part
                        table = table.append_column(name, absent.column(i))
                    rows.add(table)
        out.write(rows.tail({key: text for key, text in facts.items() if key.startswith("poise.")}))


def named(kind: str, settings: str) -> str:
    """A method in a file's name; where parameters differ from the defaults, with a few letters that tell them apart."""
    import hashlib

    return kind if settings == "{}" else f"{kind}-{hashlib.sha256(settings.encode()).hexdigest()[:6]}"
