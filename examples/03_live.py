"""A method running live: one sample in, one attitude out, saved and resumed, with a heading that the user sets."""

import numpy as np

import poise
from poise.simulation import Sensor, forearm, measure

recording = measure(forearm(duration=10.0), Sensor())
stream = poise.Stream(poise.AdaptiveGain())
for time, gyr, acc, mag in zip(recording.time, recording.gyr, recording.acc, recording.mag, strict=True):
    now = stream.update(poise.Packet(float(time), gyr, acc, mag))
    if not now.valid[0]:
        print(f"{now.time[0]:.2f} s: do not act on this attitude")

stream.reset_heading()  # "this way is forward"
saved = stream.save()  # bytes, to go on in another process
later = poise.Stream(poise.AdaptiveGain()).restore(saved)

step = 1.0 / recording.rate_hz
after = later.update(poise.Packet(recording.time[-1] + step, recording.gyr[-1], recording.acc[-1], recording.mag[-1]))
print("heading since the reset:", np.degrees(after.heading()[0] + np.pi) % 360 - 180, "degrees")
print("without a sample for a second:", later.check(after.time[0] + 1.0).reasons()[-1])
