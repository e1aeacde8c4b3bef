"""Draw the game: from one moment's view to the pixels of its window."""
