"""Double deep Q-learning: two engines for the networks and their updates, the states, replay and self-imitation."""
