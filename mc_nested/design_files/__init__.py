"""Designs from elsewhere: schematics of other programs, and pictures. One layer of a file becomes a scenario.

    .schem        Sponge schematic 1, 2 and 3       schematic.py
    .schematic    MCEdit                            schematic.py
    .litematic    Litematica                        litematic.py
    .nbt          the game's structure block        structure.py
    .png          a drawing                         png.py

Each format becomes a Volume (volume.py). load.py reads any of them, layer_scenario.py makes the scenario.
"""
