"""A virtual Minecraft client behind the same device protocols as the desktop, on a virtual clock. Nothing sleeps.

client.py  settings.py  devices.py        VirtualClient, what it is like, and its five devices
clock.py  window.py  controls.py  keys.py when, to whom and to what end keys and buttons go
game.py  realm.py  world.py               a tick of the game; the player and the rules; the blocks
physics.py  ray.py                        walking, falling, bumping; what is looked at
chat.py  chat_commands.py  screens.py     what is said, typed and clicked, in each version (edition.py)
mishaps.py  save.py                       what goes wrong; the world as a folder
view.py                                   what is to be seen at one moment, before it is drawn
painter.py  picture.py  layers.py         from a view to pixels: only what changed, only what is grabbed
f3.py  f3_text.py  f3_groups.py           the debug screen      hud_layers.py  menu_layers.py  scenery.py  the rest
font.py  letters.py                       a font drawn for this project, and texts in any font
f3_cases.py                               random debug screens, to try a reader on
"""
