"""Test doubles: the headless simulator, and a virtual Minecraft client with a window and devices."""
