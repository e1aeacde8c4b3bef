"""Everything known about one user's game: a profile's tables, its file, and whether it still fits the window."""
