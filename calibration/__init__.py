"""Calibration: a player runs it once, so that the agent knows their game. It reads devices and writes a Profile."""
