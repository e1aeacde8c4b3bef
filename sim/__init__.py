"""The worlds that an agent can play in without the real game, and what opens any of them.

worlds.py          opens a backend: the simulator, the virtual client, or a running game
grid.py            the headless simulator: one arena, or many at once, compiled (grid_step.py)
team_grid.py       the simulator for several builders; cooperative_env.py makes it a PettingZoo environment
client/            a virtual Minecraft client: its window, its devices and what goes wrong
virtual_games.py   games on virtual clients, for training
window/            the rehearsal window: the virtual client in a real window
"""
