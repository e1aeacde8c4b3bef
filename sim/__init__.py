"""Test doubles: the headless simulator, and what a real game would show on its screen."""
