"""How training episodes explore: epsilon schedules, and returning along the best episode before exploring."""
