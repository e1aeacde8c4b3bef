"""A virtual Minecraft client behind the same device protocols as the desktop."""
