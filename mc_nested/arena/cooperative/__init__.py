"""Several builders in one arena, one main agent for all of them (paper, section 6: nested agents that cooperate)."""
