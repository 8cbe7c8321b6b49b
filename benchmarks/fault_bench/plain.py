"""A method over samples in a file, for a process in which numba is switched off: METHOD SAMPLES.npz ATTITUDE.npy"""

from __future__ import annotations

import sys

import numpy as np

from poise import METHODS, Recording, estimate

if __name__ == "__main__":
    name, given, answer = sys.argv[1:]
    with np.load(given) as samples:
        recording = Recording(**samples)
    np.save(answer, estimate(METHODS[name](), recording).quat)
