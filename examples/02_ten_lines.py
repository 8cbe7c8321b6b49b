"""The Python API in ten lines: your arrays in, attitude, angles, validity and reasons out."""

import numpy as np

import poise
from poise.simulation import Sensor, forearm, measure

made = measure(forearm(), Sensor())  # or poise.read("walk.csv"), or your own arrays:
recording = poise.Recording(time=made.time, gyr=made.gyr, acc=made.acc, mag=made.mag)  # rad/s, m/s², µT

attitude = poise.estimate(poise.TwoStage(), recording)
print(attitude)
print("quaternion w x y z:", attitude.quat[-1])
print("heading, tilt:", np.degrees(attitude.heading()[-1]), np.degrees(attitude.tilt()[-1]))
print("one sigma about east, north, up:", np.degrees(attitude.sigma[-1]))
print("acceleration without gravity:", attitude.linear_acceleration(recording)[-1])
for reason in attitude.reasons()[:3]:
    print(reason)
print("error against the reference:", poise.evaluate(attitude, made).rmse_deg())
