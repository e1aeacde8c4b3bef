"""Results for people: curves, terminal views, tables, the report."""
