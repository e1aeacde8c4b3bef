"""What people look at: curves, terminal views, tables."""
