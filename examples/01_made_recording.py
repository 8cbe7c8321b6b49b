"""Make a small recording of a forearm with an inexpensive sensor and write it as a CSV file.

python examples/01_made_recording.py forearm.csv
"""

import sys
from pathlib import Path

import poise
from poise.simulation import Sensor, forearm, measure

target = Path(sys.argv[1] if len(sys.argv) > 1 else "forearm.csv")
target.parent.mkdir(parents=True, exist_ok=True)
recording = measure(forearm(duration=60.0, rate=100.0, seed=1), Sensor(), seed=1, name="forearm")
print(f"{recording} written to {poise.write(recording, target)}")
