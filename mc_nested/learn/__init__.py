"""How the task is learnt: networks, DDQN, replay, agents, trainer. Knows observations and actions, never Minecraft."""
