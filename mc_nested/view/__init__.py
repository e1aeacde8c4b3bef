"""The live view: a run writes what it does to files (board, publisher), another process reads and shows it (app)."""
