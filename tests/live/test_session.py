"""Opening a live game: what can't be played is refused before anything is pressed; what can leaves no key down."""

import dataclasses
import re
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import replace
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, FontError, LiveError, NotInFrontError, ProfileError, StoppedError
from mc_nested.live.input.stops import Stop, Switch, Takeover
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable, WindowTable
from mc_nested.live.session import Opening, fingerprint_of, open_live_game
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing import gui_layers
from sim.client.game.debug_entries import GAME_DEFAULT
from sim.client.settings import ClientSettings
from tests.live.virtual_session import ARENA, font_in, opener, opening_on, profile_in, saved

LINE = load_scenario("line")
CALIBRATED = CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)


@pytest.mark.parametrize(
    ("settings", "complaint"),
    [
        (ClientSettings(version="1.19.4"), "this is 1.19.4"),
        (ClientSettings(size=(1024, 768)), "this one has 1024 x 768"),
        (ClientSettings(scale=1), "this is 1: set Video Settings"),
    ],
)
def test_a_game_that_does_not_fit_its_profile_is_refused_and_no_key_is_pressed(
    settings: ClientSettings, complaint: str, tmp_path: Path
) -> None:
    client = VirtualClient(settings)
    profile = saved(Profile(screen=font_in(tmp_path), arena=ARENA, calibrated=CALIBRATED), tmp_path)
    with (
        pytest.raises(ProfileError, match=complaint) as caught,
        open_live_game(LINE, opening_on(client, profile)),
    ):
        pass
    assert f"mc-nested calibrate all --profile {profile}" in str(caught.value)
    assert not client.window.down
    assert not client.window.strays
    assert not client.built


def test_opening_a_version_later_than_all_known_ones_says_so(tmp_path: Path) -> None:
    profile, said = saved(Profile(screen=font_in(tmp_path), arena=ARENA), tmp_path), list[str]()
    client = VirtualClient(ClientSettings(version="27.1"))
    opened = open_live_game(LINE, opening_on(client, profile, said.append))
    with suppress(LiveError, DesktopError), opened:
        pass
    assert said[0].startswith("Minecraft 27.1 is later than 26.4")


@pytest.mark.parametrize("version", ["1.21.9", "26.4"])
def test_a_game_with_an_unrecognised_hotbar_is_refused_within_5_seconds(
    version: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # As a resource pack may draw it.
    monkeypatch.setattr(gui_layers, "_HOTBAR_FRAME", {0: 20, 1: 0x70, 2: 0x40, 19: 0x60, 20: 0x50, 21: 20})
    client = VirtualClient(version=version)
    began = client.clock.now()
    with (
        pytest.raises(LiveError, match="the hotbar isn't seen"),
        open_live_game(LINE, opening_on(client, profile_in(tmp_path))),
    ):
        pass
    assert client.clock.now() - began < 5.0
    assert (client.game.screen, client.window.down, client.window.strays) == ("world", set(), [])


def test_a_game_whose_debug_screen_names_no_block_is_refused_and_no_key_is_pressed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(version="26.3", debug_entries=GAME_DEFAULT)
    monkeypatch.setattr(client.keyboard, "press", pytest.fail)
    says = r"^the debug screen names no block, .*: press F3\+F6 in the game"
    with pytest.raises(LiveError, match=says), open_live_game(LINE, opening_on(client, profile_in(tmp_path))):
        pass


def test_a_game_behind_its_pause_menu_is_opened_and_the_first_reset_leaves_the_menu(tmp_path: Path) -> None:
    client = VirtualClient(version="26.4")
    client.game.open("pause")
    with open_live_game(LINE, opening_on(client, profile_in(tmp_path))) as (game, _):
        game.reset(0)
    assert client.game.screen == "world"


def test_an_unusable_profile_is_refused_before_a_window_is_opened(tmp_path: Path) -> None:
    titles: list[str] = []
    screen = font_in(tmp_path)
    unusable: list[tuple[Profile, type[Exception]]] = [
        (Profile(screen=screen), ProfileError),
        (Profile(arena=ARENA), ProfileError),
        (Profile(arena=ARENA, screen=ScreenTable(font=str(tmp_path / "none.png"))), FontError),
    ]
    for profile, error in unusable:
        opening = Opening(saved(profile, tmp_path), print, open_devices=opener(VirtualClient(), titles))
        opened = open_live_game(LINE, opening)
        with pytest.raises(error), opened:
            pass
    assert titles == []


def test_a_scenario_larger_than_the_arena_is_refused_before_a_window_is_opened(
    tmp_path: Path,
) -> None:
    titles: list[str] = []
    profile = saved(Profile(screen=font_in(tmp_path), arena=ARENA), tmp_path)
    large = dataclasses.replace(LINE, size=20)
    opened = open_live_game(large, Opening(profile, print, open_devices=opener(VirtualClient(), titles)))
    with pytest.raises(ProfileError, match=rf"calibrate arena --size 20 --profile {re.escape(profile)}$"), opened:
        pass
    assert titles == []


@pytest.mark.parametrize("is_in_front", [True, False])
def test_the_player_is_asked_to_switch_only_if_another_window_is_in_front(is_in_front: bool, tmp_path: Path) -> None:
    client = VirtualClient(ClientSettings(scale=1))
    client.set_front(is_in_front=is_in_front)
    calibrated = CALIBRATED.model_copy(update={"version": None})
    window = WindowTable(title="Mine")
    profile = saved(Profile(window=window, screen=font_in(tmp_path), arena=ARENA, calibrated=calibrated), tmp_path)
    said: list[str] = []
    titles: list[str] = []
    error = ProfileError if is_in_front else NotInFrontError
    opening = Opening(profile, said.append, open_devices=opener(client, titles))
    with pytest.raises(error), open_live_game(LINE, opening):
        pass
    asked = (
        "Switch to the game now with Alt+Tab (Cmd+Tab on a Mac), not by a click, and have the debug screen on (F3). "
        "Switching away again stops the agent."
    )
    assert said == ([] if is_in_front else [asked])
    assert titles == ["Mine"]


def test_a_fingerprint_has_the_windows_present_title_size_and_scales() -> None:
    client = VirtualClient()
    known = Fingerprint("Minecraft 1.20.1 - Singleplayer", (854, 480), Scales(2, 2))
    assert fingerprint_of(client.display, Scales(2, 2)) == known
    assert fingerprint_of(client.display).scales is None


def test_a_fitting_game_is_opened_and_no_key_is_down_after_it_is_left(tmp_path: Path) -> None:
    client = VirtualClient()
    with open_live_game(LINE, opening_on(client, profile_in(tmp_path))) as (game, display):
        assert display is client.display
        assert game.reset(LINE.best_material) == LINE.start == client.cell(ARENA)
        game.connection.controller.press(client.clock.now() + 1.0, "s")
        assert client.window.down
    assert client.window.down == set()


def test_the_panic_switch_listens_to_the_profiles_key_and_stops_the_game(tmp_path: Path) -> None:
    client = VirtualClient()
    switches: list[tuple[str, Stop]] = []

    def noted(key: str, stop: Stop) -> AbstractContextManager[None]:
        switches.append((key, stop))
        return nullcontext()

    opening = replace(opening_on(client, profile_in(tmp_path)), open_panic_switch=noted)
    with open_live_game(LINE, opening) as (game, _):
        ((key, stop),) = switches
        assert key == "f12"
        stop("enough")
        with pytest.raises(StoppedError, match="enough"):
            game.reset(0)


def test_the_takeover_key_and_a_view_switch_over_and_the_player_is_told_the_key(tmp_path: Path) -> None:
    client, said = VirtualClient(), list[str]()
    keys: list[tuple[str, Switch]] = []
    offered: list[Switch] = []

    def noted(key: str, switch: Switch) -> AbstractContextManager[None]:
        keys.append((key, switch))
        return nullcontext()

    def offer(switch: Switch) -> AbstractContextManager[None]:
        offered.append(switch)
        return nullcontext()

    opening = opening_on(client, profile_in(tmp_path), said.append)
    with open_live_game(LINE, replace(opening, open_takeover_key=noted)):
        assert (keys, said) == ([], []), "nobody is to take over"
    opening = replace(opening, open_takeover_key=noted, takeover=Takeover(offer))
    with open_live_game(LINE, opening) as (game, _):
        ((key, switch),) = keys
        assert key == "f9"
        assert said == ["To take over, and to give back, press f9."]
        switch()
        assert game.connection.controller.has_yielded
        offered[0]()
        assert game.connection.controller.take_back()
