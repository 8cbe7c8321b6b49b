"""E9 on recordings without a reference: other devices, rates and quantisations, where nothing is stuck."""

from __future__ import annotations

from pathlib import Path

from fault_bench.checked import Check
from fault_bench.judging import alarmed
from poise import METHODS, estimate, read

ALLOWED = 0.001  # of the rows: one of the recordings has a real gap


def other_devices(name: str, folder: Path) -> list[Check]:
    """The share of rows with an alarm, in the worst of the recordings in *folder*; nothing where there is none."""
    shares = {
        file.stem: float(alarmed(estimate(METHODS[name](), read(file))).mean()) for file in sorted(folder.glob("*.*"))
    }
    if not shares:
        return []
    worst = max(shares, key=lambda stem: shares[stem])
    found = f"{100 * shares[worst]:.3g} % ({worst})" if shares[worst] else "0 %"
    words = f"alarms on {len(shares)} recordings of other devices"
    return [Check("E9", words, f"≤ {100 * ALLOWED:g} % of rows", name, found, shares[worst] <= ALLOWED)]
