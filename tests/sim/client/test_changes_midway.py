"""Changes in the middle of a run: the window's size, a scale, a screen that opens. Nothing wrong is done then."""

import dataclasses
from collections.abc import Callable
from pathlib import Path

import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, UnreadableError, WrongScreenError
from mc_nested.live.connection import GameConnection, overlay_of
from mc_nested.live.devices import Button
from mc_nested.live.input.input_controller import FRESH_S, PressTarget
from mc_nested.live.live_game import LiveGame
from mc_nested.live.motion.key_hold import KeyHold
from mc_nested.live.motion.pose_observer import PoseFrame, PoseObserver
from mc_nested.live.profile.tables import GameVersion, Profile, ScreenTable
from mc_nested.live.recording.replayed_run import replay
from mc_nested.live.vision.game_screen import WindowScreen
from scripts.benches.into_screens import ScreenPresses
from sim.client.client import VirtualClient
from sim.client.game.screens import ScreenName
from tests.live.recording.recorded_play import record_play
from tests.sim.client.playing import FONT, arena_of, connection_to

LINE = load_scenario("line")
VERSIONS = ["1.20.1", "1.21.10", "26.3", "26.4"]
WINDOW, SCALE = (1760, 1200), 3


@dataclasses.dataclass
class Run:
    """A game that was reset, in a window where scales 1 to 4 fit, and every press into it watched."""

    client: VirtualClient
    game: LiveGame
    presses: ScreenPresses

    def change(self, scale: int = SCALE, debug: int = 0, size: tuple[int, int] = WINDOW) -> None:
        """Change the scale or the size, as the game's options or the window's edge do."""
        settings = self.client.settings
        options = dataclasses.replace(settings.options, debug_gui_scale=debug)
        self.client.settings = dataclasses.replace(settings, scale=scale, options=options)
        self.client.resize(size)

    def in_s(self, seconds: float, event: Callable[[], None]) -> None:
        self.client.clock.call_at(self.client.clock.now() + seconds, event)

    def build(self) -> None:
        """Build three blocks, and check each outcome against what the world holds."""
        arena = arena_of(self.client)
        built = set()
        for action in (Action.BD, Action.BD, Action.BD):
            outcome = self.game.act(action)
            built.add(outcome.placed)
            assert outcome.cell == self.client.cell(arena)
        assert self.client.placed(arena) == built

    def check_it_goes_on(self) -> None:
        """Check that the next episode begins where it should, and that all is built."""
        assert self.game.reset(LINE.best_material) == LINE.start == self.client.cell(arena_of(self.client))
        self.build()
        self.check_nothing_went_astray()

    def check_nothing_went_astray(self) -> None:
        """Check that every key is up, and that none was pressed into a screen or into another window."""
        assert (self.presses.into_screens, self.presses.too_late) == (0, 0)
        assert (self.client.window.down, self.client.window.strays) == (set(), [])


def running(version: str, *, is_scale_named: bool = False) -> Run:
    client = VirtualClient(version=version, size=WINDOW, scale=SCALE, seed=3)
    presses = ScreenPresses(client)
    layout = ScreenTable(debug_scale=client.scales.debug, layout="boxes" if version == "26.4" else "vanilla")
    drawn = layout if is_scale_named else ScreenTable()
    profile = Profile(game=GameVersion(version=version), arena=arena_of(client), screen=drawn)
    screen = WindowScreen(client.display, FONT, overlay_of(profile), version)
    game = LiveGame(LINE, profile, GameConnection(client.devices, presses.controller(), screen))
    game.reset(LINE.best_material)
    return Run(client, game, presses)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("in_s", [0.05, 0.4])
@pytest.mark.parametrize(
    "change",
    [{"scale": 1}, {"scale": 4}, {"debug": 1}, {"debug": -1}, {"size": (1366, 900)}, {"size": (1024, 640)}],
    ids=str,
)
def test_play_goes_on_after_a_change_of_scale_or_window_size(version: str, in_s: float, change: dict[str, int]) -> None:
    run = running(version)
    before = run.client.scales, run.client.window.size
    run.in_s(in_s, lambda: run.change(**change))  # type: ignore[arg-type]  # each by its name
    run.build()
    assert (run.client.scales, run.client.window.size) != before or (version < "2" and "debug" in change)
    # A reset types commands: the chat's line is looked for where it is now.
    assert run.game.reset(LINE.best_material) == LINE.start == run.client.cell(arena_of(run.client))
    run.build()
    assert (run.game.log.failed_actions, run.game.log.failed_resets, run.game.log.recoveries) == (0, 0, 0)
    run.check_nothing_went_astray()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_scale_that_differs_from_the_profiles_is_an_error_that_says_how_to_correct_it(version: str) -> None:
    run = running(version, is_scale_named=True)
    debug = run.client.scales.debug
    run.in_s(0.1, lambda: run.change(scale=1))
    with pytest.raises(UnreadableError, match=rf"set it to GUI scale {debug} or correct the profile's debug_scale"):
        run.build()
    run.check_nothing_went_astray()
    run.change()
    run.check_it_goes_on()


@pytest.mark.parametrize("version", ["1.20.1", "26.4"])
def test_a_recording_with_a_resized_window_is_replayed_without_differences(version: str, tmp_path: Path) -> None:
    client = VirtualClient(version=version, seed=2)
    client.mishaps.plan("resized_window", 2.5)
    size = client.window.size
    assert record_play(tmp_path / "play", 12, client) == []
    assert client.window.size != size
    seen = replay(tmp_path / "play", FONT)
    assert (seen.actions, seen.followed, seen.differences, seen.damaged) == (12, 12, [], [])
    assert seen.read_anew > 5 * seen.actions


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("screen", ["inventory", "chat", "pause"])
def test_a_screen_that_opens_just_after_the_confirming_look_gets_no_press(
    version: str, screen: ScreenName, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = running(version)
    client, controller = run.client, run.game.connection.controller
    confirm, looked = controller.confirm_screen, list[str]()

    def stalled(on: PressTarget, look_again: Callable[[], None] | None = None) -> None:
        def look_then_open() -> None:
            assert look_again is not None
            looked.append(screen)
            look_again()
            if len(looked) == 1:
                client.game.open(screen)
                client.clock.sleep(0.1)

        confirm(on, look_then_open if look_again else None)
        if not looked:
            client.clock.sleep(FRESH_S + 0.05)

    with monkeypatch.context() as patched:
        patched.setattr(controller, "confirm_screen", stalled)
        with pytest.raises((WrongScreenError, UnreadableError)):
            run.build()
    assert looked
    assert client.game.screen == screen
    assert client.placed(arena_of(client)) == set()
    run.check_nothing_went_astray()
    run.check_it_goes_on()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("screen", ["inventory", "chat", "pause"])
def test_a_screen_that_opens_while_the_body_waits_for_a_block_gets_no_click(
    version: str, screen: ScreenName, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = running(version)
    client, controller = run.client, run.game.connection.controller
    click, clicks = controller.click, list[Button]()

    def then_open(button: Button) -> None:
        click(button)
        clicks.append(button)
        run.in_s(0.1, lambda: client.game.open(screen))

    client.game.refuse_next()
    with monkeypatch.context() as patched:
        patched.setattr(controller, "click", then_open)
        with pytest.raises(LiveError):
            run.build()
    assert clicks == ["right"]
    assert client.game.screen == screen
    run.check_nothing_went_astray()
    run.check_it_goes_on()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("look_s", [0.1, 1.5])
def test_a_player_at_an_edge_keeps_sneaking_during_a_slow_look(version: str, look_s: float) -> None:
    client = VirtualClient(version=version, seed=1, feet=(0.5, 64.0, 0.9))
    for z in range(1, 5):
        client.realm.world.put((0, 63, z), "air")
    client.clock.sleep(0.3)
    profile = Profile(game=GameVersion(version=version), arena=arena_of(client))
    connection = connection_to(client)
    controller, clock = connection.controller, client.clock
    key_hold = KeyHold(connection, PoseObserver(profile, connection, PoseFrame.of_arena(profile)), 5.0)

    def look_again() -> None:
        controller.wait(look_s)
        controller.confirm_screen("world")

    controller.confirm_screen("world", look_again)
    key_hold.begin_sneaking("left.shift")
    clock.sleep(FRESH_S)  # so that all is looked at again
    key_hold.hold(clock.now() + 0.6, "w", sneak="left.shift")
    clock.sleep(0.5)
    assert client.realm.player.feet[1] == 64.0
    assert client.realm.player.feet[2] > 1.2
    assert client.window.down == set()
