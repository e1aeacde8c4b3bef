"""Measures how a held key walks in this game: which key goes which way, how far, and with what latency."""
