"""Chat commands in the syntax of each version, with the game's answers (FACTS: Commands; Answers)."""
