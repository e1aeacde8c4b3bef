"""Menus and the chat are never taken for the world, nor it for them, in any version, window and pair of scales."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import LiveError
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.menus.screens import identify_screen
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing import gui_layers
from sim.client.game.options import GameOptions
from sim.client.game.screens import IN_WORLD, ScreenName
from tests.sim.client.playing import connection_to, screen_of

PACK = {0: 20, 1: 0x70, 2: 0x40, 19: 0x60, 20: 0x50, 21: 20}
"""The greys of a hotbar's rows as a resource pack may draw them."""

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
def test_no_other_screen_is_taken_for_the_world(
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
def test_the_gui_scale_and_the_debug_scale_are_found(
    version: str, size: tuple[int, int], scale: int, debug_scale: int
) -> None:
    client = _client(version, size, scale, debug_scale, "noise")
    assert screen_of(client).seen_scales() == client.scales


@pytest.mark.parametrize("world", ["bright", "dark"])
@pytest.mark.parametrize("words", ["Game Paused", "Spiel pausiert"])
@pytest.mark.parametrize("version", VERSIONS)
def test_recovery_ends_a_pause_without_a_menu_in_any_language(version: str, words: str, world: str) -> None:
    translated = {"Game Paused": words, "Game paused": words}
    client = VirtualClient(version=version, scale=0, world=world, words=translated)
    client.clock.sleep(0.2)
    way = Recovery(Profile(), connection_to(client))
    assert way.screen_name() == "world"
    client.game.open("paused")
    client.clock.sleep(0.2)
    assert way.recover() == ("menu",)
    assert client.game.screen == "world"


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1", "1.21.8"])
def test_a_changed_gui_scale_is_noticed_even_with_a_resource_packs_hotbar(
    version: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gui_layers, "_HOTBAR_FRAME", PACK)
    client = _client(version, (1280, 720), 3, 0, "noise")
    screen = screen_of(client)
    assert screen.read().problem is None
    assert screen.seen_scales() == Scales(3, 3)
    client.settings = dataclasses.replace(client.settings, scale=2)
    client.resize(client.window.size)
    client.clock.sleep(0.2)
    assert screen.read().problem is None
    assert screen.seen_scales() == Scales(2, 2)
    client.game.open("chat")
    client.clock.sleep(0.2)
    assert screen.is_chat_open()
    assert not screen.shows_world()


@pytest.mark.parametrize("opacity", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("version", ["1.20.1", "1.21.9", "26.4"])
def test_an_empty_chat_without_its_cursor_is_not_taken_for_the_world(
    version: str, opacity: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = gui_layers.HudLayers._drawn_input
    monkeypatch.setattr(gui_layers.HudLayers, "_drawn_input", lambda layers, typed: drawn(layers, typed)[:1])
    options = GameOptions(text_background_opacity=opacity, background_for_chat_only=False)
    client = VirtualClient(version=version, options=options)
    client.clock.sleep(0.2)
    client.game.open("chat")
    client.clock.sleep(0.2)
    assert not screen_of(client).shows_world()


@pytest.mark.parametrize("version", VERSIONS[4:])
def test_recovery_soon_names_a_resource_packs_hotbar_as_the_cause(
    version: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gui_layers, "_HOTBAR_FRAME", PACK)
    client = _client(version, (854, 480), 0, 0, "noise")
    began = client.clock.now()
    with pytest.raises(LiveError, match=r"hotbar isn't seen .* take off a resource pack"):
        Recovery(Profile(), connection_to(client)).recover()
    assert client.clock.now() - began < 5.0
    assert client.game.screen == "world"


@pytest.mark.parametrize("version", VERSIONS[4:])
def test_a_world_with_a_hidden_hud_does_not_count_as_seen(version: str) -> None:
    client = _client(version, (854, 480), 0, 0, "noise")
    client.game.hides_hud = True
    client.clock.sleep(0.2)
    assert not screen_of(client).shows_world()
