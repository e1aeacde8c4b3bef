"""A virtual Minecraft client behind the same device protocols as a desktop, on a virtual clock. Nothing sleeps.

client.py    VirtualClient: the game, its window and its devices, put together    settings.py  how one is set up
mishaps.py   what goes wrong: lost focus, lag, lost keys, death and so on

game/        the game, a tick at a time; it knows no pixels
    game.py  realm.py  world.py                     a tick; what is saved; the blocks, and what is looked at
    physics.py                                      walking, sprinting, falling, bumping
    controls.py  keys.py                            what keys, buttons and the mouse do on each screen
    chat.py  commands/                              messages, and chat commands of each version (edition.py)
    screens.py  widgets.py  debug_options.py        menus: their texts and buttons
    options.py                                      the lines of options.txt that change how it looks or acts
    f3_screen.py  f3_text.py                        what the debug screen is about, and its lines to 1.21.8
    debug_entries.py  entry_lines.py                which entries are on, from 1.21.9 on; their lines to 26.3
    entry_boxes.py                                  their boxes from 26.4 on, and where each of them stands
    view.py                                         what is seen at one moment, before it is drawn
drawing/     from a view to pixels: only what changed, only what is grabbed
    painter.py  layers.py                           a view as layers, and layers as a picture
    f3_layers.py  gui_layers.py                     what lies over the world
    block_faces.py  world_shapes.py  world_layer.py the world behind
    letters.py                                      texts in any font, and a font drawn for this project
desktop/     clock.py  window.py (focus, latency, clipboard)  display.py  keyboard.py  pointer.py
"""
