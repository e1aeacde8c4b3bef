"""Double deep Q-learning over numbered states: the networks, the update, the replay."""
