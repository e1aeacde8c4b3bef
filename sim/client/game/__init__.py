"""The game itself: its world, its player, its rules, its screens and what they say. It knows no pixels."""
