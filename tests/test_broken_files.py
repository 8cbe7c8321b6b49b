"""The matrix of texts that `benchmarks/files.py` prints: every one is read right, or refused for its reason."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

import broken_files
import files


@pytest.mark.parametrize("name", broken_files.written())
def test_every_way_to_write_a_table(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    case = broken_files.written()[name]
    monkeypatch.setattr(broken_files, "written", lambda: {name: case})
    (row,) = files.f2(tmp_path)
    assert row.met, row


@pytest.mark.parametrize("kind", ["csv", "csv, UTF-16", "parquet", "npz, packed"])
def test_cut_off_anywhere_in_chunks(tmp_path: Path, kind: str) -> None:
    """What is left of a file holds no row that the whole does not."""
    import numpy as np

    import poise

    content, path = broken_files.whole(tmp_path)[kind].read_bytes(), tmp_path / "cut"
    want = broken_files.samples()
    for cut in range(1, len(content), 211):
        path.write_bytes(content[:cut])
        try:
            found = poise.Recording.joined(poise.read_chunks(path, 50))
        except poise.PoiseError:
            continue
        whole = len(found) - 1  # the last may end in the middle of a number
        np.testing.assert_array_equal(found.gyr[:whole], want[:whole, 1:4])
        np.testing.assert_array_equal(found.mag[:whole], want[:whole, 7:])
