"""The game as it is installed: the launchers' folders, its options, and whether it runs."""
