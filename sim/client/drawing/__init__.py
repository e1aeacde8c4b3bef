"""What the game draws: from one moment's view to the pixels of its window."""
