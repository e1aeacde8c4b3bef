"""A training on disk: its folder, its checkpoint, and the lock that lets one process write there."""
