"""SelfCalibrating: the flagship."""
