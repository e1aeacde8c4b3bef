"""Marking the arena: its corner for every position and facing, the question, and refusals that write nothing.

The debug screen's own reading is tested in tests/live; here one is drawn with a made-up font, as a game would show it.
"""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.arena.mark import arena_from_reading, mark_arena, mark_question
from calibration.context import CalibrationContext, OpenContext
from mc_nested.arena.action import Cell
from mc_nested.errors import DesktopError, ProfileError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Devices, Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.coordinates import Facing, centre_of, yaw_of
from mc_nested.live.model.reading import Block, Reading
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import load_font
from scripts.benches.painted_screen import paint
from sim.client.desktop.window import VirtualClipboard
from sim.client.game.f3_screen import F3Screen
from tests.calibration.contexts import NoKeys

FACINGS: list[Facing] = ["north", "south", "west", "east"]
CELLS = st.tuples(st.integers(0, 14), st.integers(0, 14))
BLOCKS = st.tuples(st.integers(-30000, 30000), st.integers(-60, 300), st.integers(-30000, 30000))
WITHIN = st.floats(-0.45, 0.45)


@given(BLOCKS, st.sampled_from(FACINGS), CELLS, WITHIN, WITHIN, st.floats(-19.9, 19.9), st.integers(15, 32))
def test_arena_is_found_from_the_players_pose_and_cell(
    origin: Block, facing: Facing, standing: Cell, east: float, south: float, turned: float, size: int
) -> None:
    x, y, z = centre_of(origin, facing, standing)
    yaw = (yaw_of(facing) + turned + 180) % 360 - 180
    arena = arena_from_reading(Reading((x + east, y, z + south), yaw, 30.0), standing, size)
    assert arena == Arena.around(origin, facing, size=size)


def test_arena_lies_ahead_of_and_beside_a_player_at_the_middle_of_its_near_edge() -> None:
    # Facing south, +Z is ahead and west, -X, to the right (FACTS: The F3 debug screen).
    arena = arena_from_reading(Reading((100.5, 64.0, 200.5), 0.0, 30.0), (7, 0), 15)
    assert arena.region == ((93, 64, 200), (107, 65, 214))


@pytest.mark.parametrize(
    ("yaw", "message"),
    [
        (40.0, "turn 40 degrees to the left to face south"),
        (50.0, "turn 40 degrees to the right to face west"),
        (-150.0, "turn 30 degrees to the left to face north"),
        (-60.0, "turn 30 degrees to the left to face east"),
        (-120.0, "turn 30 degrees to the right to face east"),
    ],
)
def test_a_view_between_two_axes_is_refused_with_how_to_turn(yaw: float, message: str) -> None:
    with pytest.raises(UserError, match=message):
        arena_from_reading(Reading((0.5, 64.0, 0.5), yaw, 30.0), (7, 0), 15)


@pytest.mark.parametrize("height", [64.5, 63.9375, 64.42])
def test_no_arena_is_marked_if_the_feet_are_not_on_top_of_a_whole_block(height: float) -> None:
    with pytest.raises(UserError, match="top of a whole block"):
        arena_from_reading(Reading((0.5, height, 0.5), 0.0, 30.0), (7, 0), 15)


def test_mark_question_names_the_corners_and_says_that_the_blocks_there_are_unknown() -> None:
    question = mark_question(Arena.around((10, 64, -20), "north"))
    assert "(10, 64, -34) to (24, 65, -20)" in question
    assert "15 x 15 x 2 high" in question
    assert "not known" in question


class SkippingClock:
    """Time that passes only when somebody waits."""

    def __init__(self) -> None:
        self.time = 50.0

    def now(self) -> float:
        return self.time

    def sleep_until(self, at: float) -> None:
        self.time = max(self.time, at)


class DrawnDisplay:
    """A window that shows one picture, and is in front."""

    def __init__(self, frame: Frame, title: str) -> None:
        self.frame = frame
        self.name = title

    def size(self) -> tuple[int, int]:
        return self.frame.shape[1], self.frame.shape[0]

    def title(self) -> str:
        return self.name

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        return self.frame


class NoInput(NoKeys):
    """A keyboard and mouse that this calibration must not touch."""

    def position(self) -> tuple[int, int]:
        raise AssertionError

    def move(self, x: int, y: int) -> None:
        raise AssertionError((x, y))


@pytest.fixture
def font_file(tmp_path: Path) -> Path:
    """Return a made-up font: each character's code drawn as two columns of dots beside a stroke."""
    atlas = np.zeros((128, 128, 4), np.uint8)
    for code in range(ord("!"), ord("~") + 1):
        top, left = code // 16 * 8, code % 16 * 8
        for column, bits in enumerate((0b1111111, (code & 15) << 1 | 1, (code >> 4) << 1 | 0b1000001)):
            for row in range(7):
                atlas[top + row, left + column] = 255 * (bits >> row & 1)
    file = tmp_path / "ascii.png"
    file.write_bytes(cv2.imencode(".png", atlas)[1].tobytes())
    return file


SCREEN = F3Screen("1.19.3-1.21.8", 2, (-3.412, 64.0, 118.633), 97.3, 12.0, version="1.20.1")


def window_titled(name: str, font_file: Path) -> OpenContext:
    @contextmanager
    def open_context(profile: Profile) -> Iterator[CalibrationContext]:
        frame = paint(np.full((480, 854, 3), 120, np.uint8), SCREEN, load_font(font_file))
        devices = Devices(DrawnDisplay(frame, name), NoInput(), NoInput(), SkippingClock(), VirtualClipboard())
        connection = GameConnection(devices, InputController(devices, profile.input))
        yield CalibrationContext(connection, lambda _: None, lambda _: False)

    return open_context


@pytest.fixture
def opened(font_file: Path) -> OpenContext:
    return window_titled("Minecraft 1.20.1 - Singleplayer", font_file)


def test_arena_read_from_the_screen_is_written_into_a_new_profile(
    tmp_path: Path, font_file: Path, opened: OpenContext
) -> None:
    file = tmp_path / "mine.toml"
    questions: list[str] = []
    told: list[str] = []

    def agree(question: str) -> bool:
        questions.append(question)
        return True

    assert mark_arena(file, opened, ask=agree, say=told.append, font=font_file) == file
    profile = load_profile(file)
    # Facing west from block (-4, 64, 118): the right hand is north, so cell (0, 0) is 7 to the south.
    assert profile.marked_arena() == Arena.around((-4, 64, 125), "west")
    assert profile.screen.font_path() == font_file
    assert profile.body.pitch == 65.0
    assert len(questions) == 1
    assert "near edge" in told[0]


OLD = """# my own notes
[keys]
forward = "z"

[arena]
origin = [1, 2, 3]
facing = "east"
marked = [[1, 2, 3], [15, 3, 17]]
"""


@pytest.fixture
def old_profile(tmp_path: Path, font_file: Path) -> Path:
    file = tmp_path / "old.toml"
    file.write_text(OLD + f'[screen]\nfont = "{font_file.as_posix()}"\n', "utf-8")
    return file


def test_old_profile_keeps_its_other_values_and_its_comments(old_profile: Path, opened: OpenContext) -> None:
    mark_arena(old_profile, opened, ask=lambda _: True, say=lambda _: None)
    profile = load_profile(old_profile)
    assert (profile.marked_arena().facing, profile.keys.forward) == ("west", "z")
    assert old_profile.read_text("utf-8").startswith("# my own notes")


def test_player_may_stand_on_another_cell_than_the_default(old_profile: Path, opened: OpenContext) -> None:
    mark_arena(old_profile, opened, ask=lambda _: True, say=lambda _: None, standing=(7, 14))
    assert load_profile(old_profile).marked_arena().block_of((7, 14)) == (-4, 64, 118)


@pytest.mark.parametrize(
    ("title", "version"),
    [
        ("Minecraft 1.12.2", "1.12.2"),
        ("Minecraft 1.20.1 - Singleplayer", "1.20.1"),
        ("Minecraft* 26.1 - Multiplayer (LAN)", "26.1"),
        ("Minecraft 1.21.11-rc1", "1.21.11"),
        ("Prismarine Web Client - Chromium", "1.16.5"),
        ("Minecraft: All the Mods 9", "1.16.5"),
    ],
)
def test_profile_takes_the_version_from_the_window_title_or_keeps_its_own(
    title: str, version: str, old_profile: Path, font_file: Path
) -> None:
    old_profile.write_text(old_profile.read_text("utf-8") + '[game]\nversion = "1.16.5"\n', "utf-8")
    window = window_titled(title, font_file)
    mark_arena(old_profile, window, ask=lambda _: True, say=lambda _: None)
    assert load_profile(old_profile).game.version == version


def test_yes_option_marks_the_arena_without_a_question(old_profile: Path, opened: OpenContext) -> None:
    def ask(question: str) -> bool:
        raise AssertionError(question)

    assert mark_arena(old_profile, opened, ask=ask, say=lambda _: None, yes=True) == old_profile


def test_answering_no_leaves_the_profile_as_it_was(old_profile: Path, opened: OpenContext) -> None:
    before = old_profile.read_bytes()
    assert mark_arena(old_profile, opened, ask=lambda _: False, say=lambda _: None) is None
    assert old_profile.read_bytes() == before


@pytest.mark.parametrize("stage", ["say", "ask"])
def test_ctrl_c_leaves_the_profile_as_it_was(stage: str, old_profile: Path, opened: OpenContext) -> None:
    before = old_profile.read_bytes()

    def reached(at: str) -> bool:
        if at == stage:
            raise KeyboardInterrupt
        return True

    def say(_: str) -> None:
        reached("say")

    with pytest.raises(KeyboardInterrupt):
        mark_arena(old_profile, opened, ask=lambda _: reached("ask"), say=say)
    assert old_profile.read_bytes() == before
    assert list(old_profile.parent.glob("old.toml?*")) == []


def refused(profile: Profile) -> AbstractContextManager[CalibrationContext]:
    raise DesktopError(f"no window's title matches {profile.window.title!r}")


def test_mistakes_are_reported_before_a_window_is_looked_for(tmp_path: Path, font_file: Path) -> None:
    broken = tmp_path / "broken.toml"
    broken.write_text("[arena\n", "utf-8")
    for file, standing, font, error, message in (
        (broken, (7, 0), font_file, ProfileError, "not TOML"),
        (tmp_path / "new.toml", (15, 0), font_file, UserError, "outside the arena"),
        (tmp_path / "new.toml", (7, 0), None, ProfileError, "font"),
        (tmp_path / "new.toml", (7, 0), font_file, DesktopError, "no window"),
    ):
        with pytest.raises(error, match=message):
            mark_arena(file, refused, ask=lambda _: True, say=lambda _: None, standing=standing, font=font)
    assert broken.read_text("utf-8") == "[arena\n"
    assert not (tmp_path / "new.toml").exists()


@pytest.mark.parametrize("size", [14, 33])
def test_an_impossible_arena_size_is_refused_before_a_window_is_looked_for(
    size: int, tmp_path: Path, font_file: Path
) -> None:
    with pytest.raises(UserError, match=f"{size} x {size} cells: choose 15 to 32 cells along each side"):
        mark_arena(
            tmp_path / "new.toml",
            refused,
            ask=lambda _: True,
            say=lambda _: None,
            size=size,
            font=font_file,
        )


def test_a_larger_arena_is_marked_around_the_middle_of_its_near_edge(
    tmp_path: Path, font_file: Path, opened: OpenContext
) -> None:
    file, questions, told = tmp_path / "mine.toml", list[str](), list[str]()

    def agree(question: str) -> bool:
        questions.append(question)
        return True

    mark_arena(file, opened, ask=agree, say=told.append, size=20, font=font_file)
    # Facing west from block (-4, 64, 118): cell (0, 0) is 10 to the south.
    assert load_profile(file).marked_arena() == Arena.around((-4, 64, 128), "west", size=20)
    assert "size = 20" in file.read_text("utf-8")
    assert "20 x 20 x 2 high" in questions[0]
    assert "the middle of the arena's near edge" in told[0]
