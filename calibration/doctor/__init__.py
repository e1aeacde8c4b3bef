"""What keeps an agent from playing on this computer, one row each: looked at, and where it is harmless tried out."""
