"""F3+C against the reader: tapped, compared, and the clipboard as it was before."""

import dataclasses
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.context import CalibrationContext
from calibration.cross_check import cross_check
from mc_nested.errors import ClipboardError, LiveError, NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_over, profile_in, started


@pytest.fixture(scope="module")
def profile(tmp_path_factory: pytest.TempPathFactory) -> Profile:
    return profile_in(tmp_path_factory.mktemp("font"))


@given(
    st.floats(-3000, 3000),
    st.floats(-3000, 3000),
    st.floats(-700, 700),
    st.floats(-90, 90),
    st.sampled_from(["1.13.2", "1.16.5", "1.20.1", "1.21.11", "26.1"]),
)
def test_f3_c_agrees_with_the_reader_for_any_position_and_view(
    profile: Profile, x: float, z: float, yaw: float, pitch: float, version: str
) -> None:
    client = started(VirtualClient(version=version, feet=(x, 64.0, z), yaw=yaw, pitch=pitch))
    client.clipboard.write("mine")
    found = cross_check(context_over(client), profile)
    assert found.samples == 1
    assert found.lines[0].startswith("F3+C agrees")
    assert found.profile == profile
    assert client.clipboard.read() == "mine"
    assert client.game.has_f3


def test_f3_and_c_are_up_again_within_two_ticks(profile: Profile) -> None:
    client = started(VirtualClient())
    downs: dict[str, float] = {}
    longest: list[float] = []
    press, release = client.keyboard.press, client.keyboard.release

    def pressed(key: str) -> None:
        downs[key] = client.clock.now()
        press(key)

    def released(key: str) -> None:
        if key in downs:
            longest.append(client.clock.now() - downs.pop(key))
        release(key)

    client.keyboard.press, client.keyboard.release = pressed, released  # type: ignore[method-assign]
    cross_check(context_over(client), profile)
    assert len(longest) == 2
    assert 0.05 < max(longest) <= 0.1


def test_cross_check_in_1_12_compares_nothing_and_presses_nothing(profile: Profile) -> None:
    client = started(VirtualClient(version="1.12.2"))
    client.clipboard.write("mine")
    found = cross_check(context_over(client), profile)
    assert found.samples == 0
    assert found.lines == ("F3+C is not in Minecraft 1.12.2, it came with 1.13: not compared",)
    assert client.game.chat.lines(client.game.ticks) == ()


@pytest.mark.parametrize("lost", range(1, 7))
def test_lost_key_events_leave_no_key_down_and_the_debug_screen_on(profile: Profile, lost: int) -> None:
    client = started(VirtualClient())
    client.clipboard.write("mine")
    context = context_over(client)
    client.window.to_drop = lost
    cross_check(context, profile)
    client.clock.sleep(0.5)
    assert client.clipboard.read() == "mine"
    assert client.game.has_f3
    assert not client.game.keys.physical & {"f3", "c"}, "held for ten seconds, they would end the game"


def test_lost_key_releases_are_repeated(profile: Profile) -> None:
    client = started(VirtualClient())
    lost: list[str] = []
    release = client.keyboard.release

    def lose_the_first_two(key: str) -> None:
        if len(lost) < 2:
            lost.append(key)
            client.window.to_drop += 1
        release(key)

    client.keyboard.release = lose_the_first_two  # type: ignore[method-assign]
    cross_check(context_over(client), profile)
    client.clock.sleep(0.5)
    assert set(lost) == {"f3", "c"}
    assert not client.game.keys.physical & {"f3", "c"}


class Liar:
    """A clipboard on which F3+C comes out a block farther."""

    def __init__(self) -> None:
        self.text = "mine"

    def read(self) -> str:
        return self.text

    def write(self, text: str) -> None:
        self.text = text.replace("tp @s 0.50", "tp @s 1.50")


def with_clipboard(client: VirtualClient, clipboard: Liar) -> CalibrationContext:
    context = context_over(client)
    client.controls._write_clipboard, client.controls._read_clipboard = clipboard.write, clipboard.read
    devices = dataclasses.replace(context.devices, clipboard=clipboard)
    return dataclasses.replace(context, connection=GameConnection(devices, context.controller))


def test_reading_that_f3_c_contradicts_is_an_error_and_the_clipboard_is_restored(profile: Profile) -> None:
    liar = Liar()
    with pytest.raises(UnreadableError, match=r"reads 0\.500 .* F3\+C says \(1\.5, .*calibrate font --font"):
        cross_check(with_clipboard(started(VirtualClient()), liar), profile)
    assert liar.text == "mine"


class Picture(Liar):
    """A clipboard that holds a picture."""

    def read(self) -> str:
        raise ClipboardError("the clipboard holds something else than text")


def test_picture_on_the_clipboard_is_left_there_and_nothing_is_pressed(profile: Profile) -> None:
    client, clipboard = started(VirtualClient()), Picture()
    with pytest.raises(ClipboardError, match="something else"):
        cross_check(with_clipboard(client, clipboard), profile)
    assert clipboard.text == "mine"
    assert client.game.chat.lines(client.game.ticks) == ()


def test_game_that_copies_nothing_is_an_error_and_the_clipboard_is_restored(
    profile: Profile, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = started(VirtualClient())
    client.clipboard.write("mine")
    monkeypatch.setattr(client.controls, "_write_clipboard", lambda _: None)
    with pytest.raises(NotConfirmedError, match="copied nothing"):
        cross_check(context_over(client), profile)
    assert client.clipboard.read() == "mine"


def test_text_that_somebody_else_copies_meanwhile_stays_on_the_clipboard(
    profile: Profile, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = started(VirtualClient())
    client.clipboard.write("mine")
    monkeypatch.setattr(client.controls, "_write_clipboard", lambda _: client.clipboard.write("theirs"))
    with pytest.raises(NotConfirmedError):
        cross_check(context_over(client), profile)
    assert client.clipboard.read() == "theirs"


def test_player_who_is_moved_during_the_cross_check_is_an_error(profile: Profile) -> None:
    client = started(VirtualClient())
    context = context_over(client)
    write = client.controls._write_clipboard

    def copied(text: str) -> None:
        write(text)
        client.realm.player.go_to((5.5, 64.0, 0.5))

    client.controls._write_clipboard = copied
    with pytest.raises(LiveError, match="was moved while"):
        cross_check(context, profile)


@pytest.mark.parametrize("after_s", [0.1, 0.2, 0.25, 0.3, 0.35])
def test_ctrl_c_at_any_moment_restores_the_clipboard_and_releases_the_keys(profile: Profile, after_s: float) -> None:
    client = started(VirtualClient())
    client.clipboard.write("mine")

    def interrupt() -> None:
        raise KeyboardInterrupt

    client.clock.call_at(client.clock.now() + after_s, interrupt)
    context = context_over(client)
    with pytest.raises(KeyboardInterrupt), context.controller:
        cross_check(context, profile)
    assert client.clipboard.read() == "mine"
    assert client.window.down == set()


def test_the_cross_check_writes_no_profile(profile: Profile, tmp_path: Path) -> None:
    cross_check(context_over(started(VirtualClient())), profile)
    assert list(tmp_path.iterdir()) == []
