"""``mc-nested rehearse``: its options and refusals; tests of the window itself are in tests/sim/window."""

import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from mc_nested.errors import with_extra
from sim.client.game.debug_entries import GAME_DEFAULT
from sim.client.game.options import GameOptions
from tests.cli.running import run

if TYPE_CHECKING:
    from sim.window.rehearsal import Rehearsal


@pytest.fixture(autouse=True)
def a_lock_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Use a lock for this test alone: other tests, and people, may rehearse at the same time."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))


def refused(capsys: pytest.CaptureFixture[str], *words: str | Path) -> str:
    """Return the one line that says why it isn't rehearsed."""
    assert run("rehearse", *words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    return printed.err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--size", "200x100"], "200x100 has no room for the game: at least 320x240"),
        (["--size", "wide"], "no window has the size 'wide': write width x height in pixels, such as 854x480"),
        (["--version", "1.7.10"], "no version '1.7.10' can be rehearsed: name one from 1.12 to 26.4"),
        (["--size", "99999x99999"], "no screen is as large as 99999x99999: at most 7680x4320"),
        (["--version", "29.9"], "no version '29.9' can be rehearsed"),
        (["--version", "1.21.99"], "no version '1.21.99' can be rehearsed"),
        (["--version", "26.3.99"], "no version '26.3.99' can be rehearsed"),
        (["--truth", "missing/truth.json"], "truth.json can't be written: name a file in a folder that exists"),
        (["--truth", "."], ". can't be written: name a file in a folder that exists"),
        (["--version", "newest"], "no version 'newest' can be rehearsed"),
        (["--gui-scale", "-1"], "--gui-scale"),
        (["--option", "toggleUse"], "'toggleUse' is no option: write NAME=VALUE"),
        (["--version", "26.1", "--option", "toggleUse=on"], "toggleUse can't be 'on': give true or false"),
        (["--option", "toggleUse=true"], "Minecraft 1.20.1 has no option toggleUse: it came with 1.21.9"),
        (["--debug-profile", "missing.json"], "Minecraft 1.20.1 has no debug-profile.json: it came with 1.21.9"),
        (["--version", "26.1", "--debug-profile", "missing.json"], "missing.json can't be read"),
        (["--option", "fov=70"], "no option 'fov' is known: name one of guiScale, "),
        (["--fps", "1"], "--fps"),
        (["--lag", "-1"], "--lag"),
        (["--seed", "-1"], "--seed"),
        (["--font", "nothing.png"], "nothing.png"),
    ],
)
def test_mistake_is_refused_in_one_line(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert says in refused(capsys, *words)


@pytest.mark.parametrize("package", ["glfw", "moderngl"])
def test_a_missing_package_is_named_with_how_to_get_it(
    package: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name.startswith("sim.window")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)
    said = refused(capsys)
    assert package in said
    assert with_extra("rehearse") in said


if sys.platform.startswith("linux"):

    def test_rehearse_without_a_display_says_where_to_run(
        capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):
            monkeypatch.delenv(name, raising=False)
        said = refused(capsys)
        assert "no window can be opened (X11: " in said
        assert "on Wayland with Xwayland" in said

    @pytest.fixture
    def opened(monkeypatch: pytest.MonkeyPatch) -> list["Rehearsal"]:
        """Return what was opened; in place of the window it says at once that it is there."""
        from sim.window import rehearsal

        found: list[rehearsal.Rehearsal] = []

        def open_window(wanted: rehearsal.Rehearsal, on_open: Callable[[], None]) -> None:
            found.append(wanted)
            on_open()

        monkeypatch.setattr(rehearsal, "rehearse", open_window)
        monkeypatch.delenv("DISPLAY", raising=False)
        return found

    def test_mishaps_use_the_given_seed_or_a_new_one_and_the_seed_is_printed(
        opened: list["Rehearsal"], capsys: pytest.CaptureFixture[str]
    ) -> None:
        said = []
        for words in (["--seed", "7"], [], []):
            assert run("rehearse", "--mishaps", "6", *words) == 0
            said += re.findall(
                r"^To draw the same mishaps again: --mishaps 6 --seed ([0-9]+)$", capsys.readouterr().out, re.MULTILINE
            )
        assert [str(each.settings.seed) for each in opened] == said
        assert said[0] == "7"
        assert len(set(said)) == 3

    @pytest.mark.parametrize(
        ("words", "scale"),
        [
            ([], 0),
            (["--gui-scale", "3"], 3),
            (["--option", "guiScale=1"], 1),
            (["--option", "guiScale=1", "--gui-scale", "0"], 0),
            (["--gui-scale", "99"], 99),
        ],
    )
    def test_the_gui_scale_is_the_games_own_unless_an_option_says_otherwise(
        words: list[str], scale: int, opened: list["Rehearsal"]
    ) -> None:
        assert run("rehearse", *words) == 0
        assert opened[0].settings.scale == scale

    def test_the_debug_screen_shows_the_games_own_entries_or_those_of_the_profile(
        opened: list["Rehearsal"], tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        profile = tmp_path / "debug-profile.json"
        profile.write_text('{"DataVersion":4671,"custom":{"minecraft:looking_at_block":"inOverlay"}}', "utf-8")
        assert run("rehearse", "--version", "1.21.11") == 0
        assert opened[0].settings.debug_entries == GAME_DEFAULT
        assert "press F3+F6 there" in capsys.readouterr().out
        assert run("rehearse", "--version", "1.21.11", "--debug-profile", profile) == 0
        assert opened[1].settings.debug_entries == {"looking_at_block": "inOverlay"}
        assert "F3+F6" not in capsys.readouterr().out

    @pytest.mark.parametrize("text", ["", "{", "[]", '{"custom":{"minecraft:fps":"sometimes"}}', '{"profile":"mine"}'])
    def test_damaged_debug_profile_is_refused_in_one_line(
        text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        profile = tmp_path / "debug-profile.json"
        profile.write_text(text, "utf-8")
        said = refused(capsys, "--version", "26.1", "--debug-profile", profile)
        problem = "an entry or a value is unknown there" if text.startswith(('{"', "[")) else "it is no JSON"
        assert f"{profile}: no debug-profile.json of Minecraft 26.1, {problem}" in said

    def test_option_words_set_the_games_options(opened: list["Rehearsal"], capsys: pytest.CaptureFixture[str]) -> None:
        words = ["--option", "toggleUse=true", "--option", "pauseOnLostFocus=false"]
        assert run("rehearse", "--version", "26.3", *words) == 0
        settings = opened[0].settings
        assert settings.options == GameOptions(toggle_use=True, pause_on_lost_focus=False)
        assert capsys.readouterr().out.startswith("Rehearsing Minecraft 26.3.\n")

    def test_without_mishaps_no_seed_is_printed(opened: list["Rehearsal"], capsys: pytest.CaptureFixture[str]) -> None:
        assert run("rehearse") == 0
        assert opened[0].mishaps_a_minute == 0
        assert "--seed" not in capsys.readouterr().out
