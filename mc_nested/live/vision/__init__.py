"""From pixels to what the screen says: glyphs, lines, the debug screen, menus, the chat."""
