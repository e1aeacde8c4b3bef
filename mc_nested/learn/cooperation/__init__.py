"""Nested agents that cooperate (paper, section 6): k builders in one arena, trained together."""
