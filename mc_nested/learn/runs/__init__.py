"""A training on disk: its folder and its checkpoint."""
