"""Many games, in processes of their own, that feed one learner: it plans their episodes, and takes what they played."""
