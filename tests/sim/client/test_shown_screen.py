"""What lies over the world is never taken for it, in any version, window and pair of scales; nor the world for that."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.menus.screens import identify_screen
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from sim.client.game.screens import IN_WORLD, ScreenName
from tests.sim.client.playing import screen_of

VERSIONS = ("1.12.2", "1.16.5", "1.20.1", "1.21.8", "1.21.9", "1.21.11", "26.1.2", "26.2", "26.3", "26.4")
SIZES = st.one_of(
    st.sampled_from([(854, 480), (1280, 720), (1920, 1080), (2560, 1440)]),
    st.tuples(st.integers(640, 2000), st.integers(480, 1200)),
)
WORLDS = st.sampled_from(["noise", "bright", "dark", "seen"])


def _client(version: str, size: tuple[int, int], scale: int, debug_scale: int, world: str) -> VirtualClient:
    options = GameOptions(debug_gui_scale=debug_scale)
    client = VirtualClient(version=version, size=size, scale=scale, world=world, pitch=65.0, options=options)
    client.clock.sleep(0.2)
    return client


@given(
    st.sampled_from(VERSIONS),
    SIZES,
    st.integers(0, 6),
    st.integers(-1, 4),
    WORLDS,
    st.sampled_from(sorted(IN_WORLD)),
)
def test_only_the_world_is_taken_for_the_world(
    version: str, size: tuple[int, int], scale: int, debug_scale: int, world: str, name: ScreenName
) -> None:
    client = _client(version, size, scale, debug_scale, world)
    screen = screen_of(client)
    assert screen.shows_world()
    if name == "death":
        client.game.die()
    else:
        client.game.open(name)
    client.clock.sleep(0.2)
    seen, _ = identify_screen(screen, client.display, {})
    is_readable = screen.read().problem is None
    assert (seen == "world") == (name == "world" and is_readable)
    if version not in ("1.12.2", "1.16.5", "1.20.1", "1.21.8"):
        assert screen.shows_world() == (name == "world")
        assert screen_of(client).shows_world() == (name == "world"), "without having seen the world before"
    client.game.open("world")
    client.clock.sleep(0.2)
    assert screen.shows_world()


@given(st.sampled_from(VERSIONS), SIZES, st.integers(0, 6), st.integers(-1, 4))
def test_both_scales_are_found(version: str, size: tuple[int, int], scale: int, debug_scale: int) -> None:
    client = _client(version, size, scale, debug_scale, "noise")
    assert screen_of(client).seen_scales() == client.scales


@pytest.mark.parametrize("version", VERSIONS[4:])
def test_a_hidden_hud_is_not_the_world(version: str) -> None:
    client = _client(version, (854, 480), 0, 0, "noise")
    client.game.hides_hud = True
    client.clock.sleep(0.2)
    assert not screen_of(client).shows_world()
