"""Pressing keys and buttons, and releasing every one of them on every way out."""
