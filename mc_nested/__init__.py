"""Deep nested agents that learn to build in Minecraft Java Edition, through the keyboard, the mouse and the screen."""

import gymnasium

# Strings, resolved when an env is made: only here do the lower packages name the simulator.
gymnasium.register(
    id="mc_nested/Arena-v0",
    entry_point="sim.grid:arena_env",
    vector_entry_point="sim.grid:arena_vector_env",
)
