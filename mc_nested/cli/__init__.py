"""The command line, one verb a file: train, evaluate, play, scenarios, read, calibrate."""

from mc_nested.cli.app import main

__all__ = ["main"]
