"""How the task is learned: agents, DDQN, exploration, a learnt game, trainers, and trainings on disk.

It knows observations and actions, never Minecraft.
"""
