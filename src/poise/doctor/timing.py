"""Timing: rate, jitter, gaps, drops and stamps that do not rise."""

from __future__ import annotations

import numpy as np

from poise.data.recording import Recording
from poise.data.stamps import Packed, packed
from poise.doctor.findings import Finding

_GAP = 3.0  # usual steps
_JITTER = 0.02  # of the usual step
_PACKET = 1.5  # times the rows of a long packet
_PAUSE = 2.0  # s: a longer gap is a pause, not lost samples
_DROP = 1.5  # usual steps: a sample is missing


def findings(recording: Recording) -> list[Finding]:
    """What there is to say of the stamps."""
    steps = np.diff(recording.time)
    known = steps[np.isfinite(steps)]
    rising = known[known > 0]
    if not len(rising):
        return []
    packets = packed(recording.time)
    usual = float(np.median(rising)) if packets is None else packets.step
    found = [_rate(recording, rising, usual) if packets is None else _in_packets(packets)]
    unknown = int(np.sum(~np.isfinite(recording.time)))
    backward, same = int(np.sum(known < 0)), int(np.sum(known == 0))
    if unknown:
        found.append(Finding("stamps", "likely", f"{unknown} rows have no time"))
    if backward or (same and packets is None):
        text = f"{backward} stamps lie before the one above and {same} repeat it; their rows predict nothing"
        found.append(Finding("stamps", "likely", text))
    most = _GAP if packets is None else max(_GAP, _PACKET * packets.most)
    gaps = known[known > most * usual]
    if len(gaps):
        text = (
            f"{len(gaps)} gap{'s' * (len(gaps) > 1)} of more than {most:.0f} usual steps, the longest {gaps.max():.3f} s, "
            f"together {gaps.sum():.2f} s"
        )
        found.append(Finding("gaps", "note", text))
    if packets is not None:  # whose rows between two stamps are many: that none is missing cannot be told
        return found
    short = known[(known > _DROP * usual) & (known < _PAUSE)]
    missing = int(np.sum(np.round(short / usual) - 1))
    if missing:
        share = missing / (len(recording) + missing)
        text = f"about {missing} samples ({share:.2%}) are missing, by steps of two usual ones or more"
        found.append(Finding("drops", "likely" if share > 0.05 else "note", text))
    return found


def _in_packets(packets: Packed) -> Finding:
    text = (
        f"the rows come in packets of {packets.words}: stamps of when they arrived, not of when they were measured; "
        f"{1.0 / packets.step:.2f} Hz in the mean. poise takes the rows of a packet to be evenly apart; stamps of the device "
        "itself would be better"
    )
    return Finding("packets", "likely", text)


def _rate(recording: Recording, rising: np.ndarray[tuple[int], np.dtype[np.float64]], usual: float) -> Finding:
    near = rising[rising < _DROP * usual]
    jitter = float(np.std(near)) / usual
    text = f"{1.0 / usual:.2f} Hz by the median step of {1e3 * usual:.3f} ms"
    if jitter > _JITTER:
        text += f", uneven by {jitter:.0%} (standard deviation); the stamps are used as they are"
    for sensor in ("acc", "mag"):
        share = float(np.mean(np.isfinite(getattr(recording, sensor)).all(axis=1)))
        if 0.0 < share < 0.98:
            text += f"; {sensor} in {share:.1%} of the rows, {share / usual:.1f} Hz"
    return Finding("rate", "note", text)
