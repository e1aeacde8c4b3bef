"""Deep nested agents that learn to build in Minecraft Java Edition, through the keyboard, the mouse and the screen."""

import gymnasium

# Strings, resolved when an env is made: only here does the ground floor name what is above it.
gymnasium.register(
    id="mc_nested/Arena-v0",
    entry_point="mc_nested.entry_point:MadeArenaEnv",
    vector_entry_point="mc_nested.entry_point:made_vector_env",
)
