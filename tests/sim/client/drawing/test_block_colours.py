from sim.client.drawing.block_colours import block_colour


def test_a_known_block_has_its_own_colour_and_an_unknown_one_always_the_same() -> None:
    assert block_colour("grass_block")[1] > block_colour("grass_block")[0]
    assert block_colour("copper_bulb") == block_colour("copper_bulb") != block_colour("tuff")
    assert all(60 <= part < 180 for part in block_colour("copper_bulb"))
