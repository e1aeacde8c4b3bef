"""Everything outside the game's world: chat, commands, menus, world folders, and waiting for the player."""
