"""Results for people: learning curves, maps of the arena, films, terminal views, and TensorBoard events."""
