"""Calibration: a player runs it once, so that the agent knows their game. It reads devices and writes a Profile.

calibrate_all.py    the guided run: every step in order, then the profile is written
font/  arena/  walk/  clicks/  cross_check.py  acceptance_test.py    the steps
context.py  step_profile.py  command_console.py                      what the steps share
doctor/             checks what may keep an agent from playing; installation/ reads the game's own files
report/             a page of what a calibration saw; bug_report.py packs all that a bug report needs
try_it.py           a volunteer's run through all of it, and the file that can be sent
profiles.py         the named profiles and all their files
"""
