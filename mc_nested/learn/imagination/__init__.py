"""A learnt game, made of the agent's own transitions, and practice in it."""
