import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mc_nested.live.model.reading import Block
from sim.client.game.world import AIR, VirtualWorld, block_of, cast_ray, direction

blocks = st.tuples(st.integers(-3, 3), st.integers(61, 67), st.integers(-3, 3))
names = st.sampled_from([AIR, "stone", "dirt"])


@given(st.lists(st.tuples(blocks, blocks, names), max_size=8))
def test_a_fill_does_the_same_as_putting_every_block(fills: list[tuple[Block, Block, str]]) -> None:
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


def test_only_blocks_that_differ_from_the_bare_floor_count_as_built() -> None:
    world = VirtualWorld(64, "dirt")
    assert world.put((0, 64, 0), "stone")
    assert not world.put((0, 64, 0), "stone")
    assert world.put((0, 63, 0), AIR)
    assert world.built() == {(0, 64, 0): "stone", (0, 63, 0): AIR}
    assert world.put((0, 63, 0), "dirt")
    assert world.put((0, 64, 0), AIR)
    assert world.built() == {}
    assert world.revision == 4


EYE = (0.5, 65.62, 0.5)


def is_floor(_x: int, y: int, _z: int) -> bool:
    return y < 64


@pytest.mark.parametrize(
    ("pitch", "cell"), [(72.8, 1), (65.0, 1), (47.3, 1), (47.1, 2), (73.0, 0), (33.0, 2), (90.0, 0)]
)
def test_the_pitch_decides_which_cells_floor_the_ray_hits(pitch: float, cell: int) -> None:
    hit = cast_ray(EYE, 0.0, pitch, 5.0, is_floor)
    assert hit is not None
    assert (hit.block, hit.before) == ((0, 63, cell), (0, 64, cell))
    assert hit.distance == pytest.approx(1.62 / math.sin(math.radians(pitch)))


@pytest.mark.parametrize(("pitch", "before"), [(72.8, (0, 64, 0)), (51.2, (0, 64, 0)), (51.0, (0, 65, 1))])
def test_a_block_ahead_is_hit_on_its_near_face_or_on_its_top(pitch: float, before: tuple[int, int, int]) -> None:
    hit = cast_ray(EYE, 0.0, pitch, 5.0, lambda x, y, z: y < 64 or (x, y, z) == (0, 64, 1))
    assert hit is not None
    assert (hit.block, hit.before) == ((0, 64, 1), before)


@pytest.mark.parametrize(
    ("yaw", "ahead"), [(0.0, (0, 63, 1)), (90.0, (-1, 63, 0)), (180.0, (0, 63, -1)), (-90.0, (1, 63, 0))]
)
def test_yaw_turns_from_south_over_west_and_north_to_east(yaw: float, ahead: tuple[int, int, int]) -> None:
    hit = cast_ray(EYE, yaw, 65.0, 5.0, is_floor)
    assert hit is not None
    assert hit.block == ahead


def test_the_ray_hits_nothing_beyond_the_reach() -> None:
    length = 1.62 / math.sin(math.radians(30))
    assert cast_ray(EYE, 0.0, 30.0, length - 0.01, is_floor) is None
    assert cast_ray(EYE, 0.0, 30.0, length + 0.01, is_floor) is not None
    assert cast_ray(EYE, 0.0, -10.0, 100.0, is_floor) is None


@given(st.floats(-180, 180), st.floats(-89, 89), st.floats(-3, 3), st.floats(-3, 3))
def test_no_point_of_the_ray_before_the_hit_lies_in_a_block(yaw: float, pitch: float, x: float, z: float) -> None:
    def is_solid(block_x: int, y: int, block_z: int) -> bool:
        return (block_x * 31 + y * 17 + block_z * 7) % 4 == 0

    eye = (x, 65.62, z)
    assume(not is_solid(*block_of(eye)))
    hit = cast_ray(eye, yaw, pitch, 12.0, is_solid)
    way = direction(yaw, pitch)
    reached = hit.distance if hit else 12.0
    for step in range(int(reached * 50)):
        point = [start + part * step / 50 for start, part in zip(eye, way, strict=True)]
        # A point on a border lies in either block, by the last bit.
        if step / 50 < reached - 1e-6 and all(abs(part - round(part)) > 1e-9 for part in point):
            assert not is_solid(*block_of((point[0], point[1], point[2])))
    if hit:
        assert is_solid(*hit.block)
        assert sum(abs(one - other) for one, other in zip(hit.block, hit.before, strict=True)) == 1
