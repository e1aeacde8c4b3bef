from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.reading import Block
from sim.client.game.world import AIR, VirtualWorld

blocks = st.tuples(st.integers(-3, 3), st.integers(61, 67), st.integers(-3, 3))
names = st.sampled_from([AIR, "stone", "dirt"])


@given(st.lists(st.tuples(blocks, blocks, names), max_size=8))
def test_a_fill_is_the_same_as_putting_every_block(fills: list[tuple[Block, Block, str]]) -> None:
    world, expected = VirtualWorld(64, "dirt"), dict[Block, str]()
    for low, high, name in fills:
        changed = 0
        for x in range(min(low[0], high[0]), max(low[0], high[0]) + 1):
            for y in range(min(low[1], high[1]), max(low[1], high[1]) + 1):
                for z in range(min(low[2], high[2]), max(low[2], high[2]) + 1):
                    before = expected.get((x, y, z), "dirt" if y < 64 else AIR)
                    changed += before != name
                    expected[x, y, z] = name
        assert world.fill(low, high, name) == changed
    for block, name in expected.items():
        assert world.block_at(block) == name
        assert world.is_solid(*block) == (name != AIR)


def test_only_what_differs_from_the_floor_is_built() -> None:
    world = VirtualWorld(64, "dirt")
    assert world.put((0, 64, 0), "stone")
    assert not world.put((0, 64, 0), "stone")
    assert world.put((0, 63, 0), AIR)
    assert world.built() == {(0, 64, 0): "stone", (0, 63, 0): AIR}
    assert world.put((0, 63, 0), "dirt")
    assert world.put((0, 64, 0), AIR)
    assert world.built() == {}
    assert world.revision == 4
