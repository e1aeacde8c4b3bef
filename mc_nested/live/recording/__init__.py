"""Recordings of live runs: every call that crosses the devices, kept so that it can be played again."""
