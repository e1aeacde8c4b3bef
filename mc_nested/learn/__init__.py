"""How the task is learned: networks, DDQN, replay, agents, trainer. Knows observations and actions, never Minecraft."""
