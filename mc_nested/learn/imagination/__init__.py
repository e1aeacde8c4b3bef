"""The learnt game: rules and beliefs made of the agent's own transitions, and practice in it."""
