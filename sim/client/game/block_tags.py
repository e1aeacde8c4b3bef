"""The tags of blocks as the debug screen lists them, by version (FACTS: The F3 debug screen)."""

from sim.client.game.edition import Edition

_PICKAXE = "minecraft:mineable/pickaxe"


def tags_of(block: str, edition: Edition) -> tuple[str, ...]:
    """A block's tags, without #. The game's order may be another one each time that it starts; here it is fixed."""
    if not edition.since(1, 13):
        return ()
    tags = _TAGS.get(block, ())
    return tuple(tag for since, tag in tags if edition.since(*since))


_TAGS: dict[str, tuple[tuple[tuple[int, ...], str], ...]] = {
    "oak_planks": (((1, 13), "minecraft:planks"), ((1, 17), "minecraft:mineable/axe")),
    "stone": (
        ((1, 17), _PICKAXE),
        ((1, 18), "minecraft:base_stone_overworld"),
        ((1, 18), "minecraft:lush_ground_replaceable"),
    ),
    "obsidian": (((1, 17), _PICKAXE), ((1, 20, 5), "minecraft:incorrect_for_wooden_tool")),
}
"""Each tag with the first version that has it. The long ones meet the left column in a narrow window."""
