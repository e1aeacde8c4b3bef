"""The steps of a calibration on the command line: their words, files, questions and refusals."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import pytest

from calibration.context import CalibrationContext, OpenContext, StepResult
from mc_nested.cli import calibrate
from mc_nested.cli.view import Viewed
from mc_nested.errors import UserError
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.session import Opening
from mc_nested.view.board import Board
from mc_nested.view.publisher import Publisher
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_on, font_file_in, kept_profile, profile_in, started
from tests.cli.running import run

if TYPE_CHECKING:
    from mc_nested.live.journal import Journal


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """Return the game on this desktop."""
    client = started(VirtualClient(pitch=65.0))
    monkeypatch.setattr(calibrate, "context_opener", lambda opening, ask: context_on(client, opening.say, ask))
    return client


@pytest.fixture
def shared(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """Return the game on this desktop, shared with others."""
    client = VirtualClient(pitch=65.0)
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")

    def opener(opening: Opening, _ask: object) -> OpenContext:
        return context_on(client, opening.say, is_server_allowed=opening.is_server_allowed)

    monkeypatch.setattr(calibrate, "context_opener", opener)
    return client


@pytest.fixture
def file(shared: VirtualClient, tmp_path: Path) -> Path:
    """Return a profile that can read the shared game."""
    return kept_profile(shared, tmp_path)


def test_font_step_prints_its_findings_and_writes_the_font_into_a_new_profile(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, font = tmp_path / "mine.toml", font_file_in(tmp_path)
    assert run("calibrate", "font", "--profile", file, "--font", font) == 0
    printed = capsys.readouterr().out.splitlines()
    scale = f"GUI scale {client.scale}, text (224, 224, 224), a line every 9 dots, dots from the corner on"
    assert scale in printed
    picture = tmp_path / "mine-font.png"
    assert printed[-1] == f"compare what is seen with what is read: {picture}"
    assert picture.is_file()
    assert load_profile(file).screen.font == str(font)


@pytest.mark.parametrize(
    ("font", "message"),
    [("nowhere.jar", "there is no nowhere.jar"), ("notes.png", "notes.png")],
    ids=["no file", "no font"],
)
def test_unusable_font_is_refused_in_one_line_and_nothing_is_written(
    font: str,
    message: str,
    client: VirtualClient,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "notes.png").write_text("no picture", "utf-8")
    assert run("calibrate", "font", "--profile", "new.toml", "--font", font) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["notes.png"]
    assert client.window.strays == []


def test_arena_step_builds_and_undoes_in_a_shared_game_if_allowed_and_names_the_file(
    shared: VirtualClient, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("calibrate", "arena", "--yes", "--server-allowed", "--profile", file) == 0
    assert load_profile(file).arena is not None
    assert capsys.readouterr().out.splitlines()[-1] == f"written to {file}"
    assert run("calibrate", "arena", "--undo", "--server-allowed", "--profile", file) == 0
    assert shared.built == {}
    assert capsys.readouterr().out.splitlines()[-1] == f"written to {file}"


def test_arena_has_the_size_asked_for_and_an_impossible_size_is_refused_in_one_line(
    shared: VirtualClient, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = file.read_bytes()
    assert run("calibrate", "arena", "--yes", "--server-allowed", "--profile", file, "--size", "33") == 2
    assert capsys.readouterr().err == (
        "mc-nested: an arena of 33 x 33 cells: choose 15 to 32 cells along each side; a smaller scenario is played in "
        "a part of it\n"
    )
    assert (file.read_bytes(), shared.built) == (before, {})
    assert run("calibrate", "arena", "--yes", "--server-allowed", "--profile", file, "--size", "20") == 0
    assert load_profile(file).marked_arena().size == 20


def test_mark_only_with_undo_is_refused_in_one_line_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("calibrate", "arena", "--mark-only", "--undo", "--profile", tmp_path / "new.toml") == 2
    error = "mc-nested: --mark-only and --undo do different things: choose one of them\n"
    assert capsys.readouterr().err == error
    assert list(tmp_path.iterdir()) == []


def test_font_and_clicks_steps_make_a_new_profile_and_show_its_points(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    assert run("calibrate", "font", "--profile", file, "--font", font_file_in(tmp_path)) == 0
    assert str(tmp_path / "mine-font.png") in capsys.readouterr().out
    assert run("calibrate", "clicks", "--profile", file, "--yes") == 0
    assert str(tmp_path / "mine-clicks.png") in capsys.readouterr().out
    assert len(load_profile(file).points) == 5
    client.game.open("pause")
    assert run("calibrate", "clicks", "--profile", file, "--show") == 0
    assert (tmp_path / "mine-clicks-now.png").is_file()
    assert run("calibrate", "clicks", "--profile", file, "--dry-run") == 0
    assert "back_to_game: here, and the mouse over it" in capsys.readouterr().out
    assert client.game.screen == "pause"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("clicks",), "run mc-nested calibrate font first"),
        (("walk",), "run mc-nested calibrate font first"),
        (("clicks", "--show", "--dry-run"), "choose one of them"),
        (("clicks", "--show"), "has no points with pictures"),
        (("clicks", "--hotkey", "f9"), "can't both record and skip"),
    ],
)
def test_mistake_is_refused_in_one_line_and_nothing_is_written(
    words: tuple[str, ...],
    message: str,
    client: VirtualClient,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run("calibrate", *words, "--profile", tmp_path / "new.toml") == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
    assert client.window.strays == []


@pytest.mark.slow
def test_walk_step_prints_and_writes_the_measured_walk(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = kept_profile(client, tmp_path)
    assert run("calibrate", "walk", "--profile", file) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("Measuring how you walk")
    assert [line for line in printed if line.startswith("Walking 4.3")]
    assert printed[-1] == f"written to {file}; look at the curve in {tmp_path / 'mine-walk.png'}"
    assert (tmp_path / "mine-walk.png").is_file()
    assert load_profile(file).walk.inertia == pytest.approx(0.546, abs=0.002)


@pytest.mark.parametrize("step", ["arena", "walk"])
def test_arena_and_walk_steps_are_refused_in_a_shared_game(
    step: str, shared: VirtualClient, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = file.read_bytes()
    assert run("calibrate", step, "--profile", file) == 2
    assert capsys.readouterr().err.endswith("or allow it with --server-allowed\n")
    assert shared.built == {}
    assert shared.realm.player.feet == (0.5, 64.0, 0.5)
    assert file.read_bytes() == before


@pytest.mark.usefixtures("shared")
def test_walk_step_runs_in_a_shared_game_only_with_server_allowed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:

    def measure(profile_name: str, context_of: OpenContext) -> tuple[StepResult, Path]:
        assert profile_name == "mine"
        with context_of(Profile()) as context:
            context.connection.check_single_player()
        return StepResult("walk", Profile(), ("one cell is 4 ticks", "sneaking is slower"), 1), tmp_path / "curve.png"

    monkeypatch.setattr(calibrate, "calibrate_walk", measure)
    assert run("calibrate", "walk", "--server-allowed", "--profile", "mine") == 0
    assert capsys.readouterr().out.splitlines() == [
        "one cell is 4 ticks",
        "sneaking is slower",
        f"written to mine; look at the curve in {tmp_path / 'curve.png'}",
    ]
    assert run("calibrate", "walk", "--profile", "mine") == 2


class OnlyQuestion:
    """A calibration's view, and its window, which asks one question and then ends the calibration."""

    def __init__(self) -> None:
        self.board = Board("", "")
        self.is_viewed: bool | None = None
        self.asked: list[tuple[str, Callable[[str], bool]]] = []
        self.answer: bool | None = None
        self.journal: Journal | None = None

    @contextmanager
    def viewed(self, is_viewed: bool, what: str, title: str) -> Iterator[Viewed]:
        self.is_viewed, self.board = is_viewed, Board(what, title)
        yield cast("Viewed", self)

    @property
    def publisher(self) -> Publisher:
        return Publisher(self.board, Path())

    def ask(self, question: str, otherwise: Callable[[str], bool]) -> bool:
        self.asked.append((question, otherwise))
        return False

    def context_opener(self, opening: Opening, ask: Callable[[str], bool]) -> OpenContext:
        @contextmanager
        def opened(_profile: Profile) -> Iterator[CalibrationContext]:
            self.journal, self.answer = opening.journal, ask("Clear it?")
            raise UserError("that is all")
            yield

        return opened


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> OnlyQuestion:
    only = OnlyQuestion()
    monkeypatch.setattr(calibrate, "viewed", only.viewed)
    monkeypatch.setattr(calibrate, "context_opener", only.context_opener)
    return only


@pytest.mark.parametrize("is_viewed", [True, False])
@pytest.mark.parametrize("yes", [True, False])
def test_calibration_asks_its_questions_through_the_view_and_notes_its_journal_there(
    asked: OnlyQuestion, is_viewed: bool, yes: bool
) -> None:
    def in_the_terminal(_question: str) -> bool:
        return True

    opening = Opening("mine", print)
    opened = calibrate.calibrating("walk", opening, is_viewed=is_viewed, ask=in_the_terminal, yes=yes)
    with pytest.raises(UserError, match="that is all"), opened as calibration, calibration.context_of(Profile()):
        pass
    assert asked.is_viewed is is_viewed
    assert asked.answer is yes
    assert asked.asked == ([] if yes else [("Clear it?", in_the_terminal)])
    assert asked.journal is asked.board
    status = asked.board.status()
    assert (status.what, status.title, status.doing) == ("calibrate walk", "profile mine", "Walk")


@pytest.mark.parametrize(
    ("words", "doing"),
    [
        (("font",), "Font and screen"),
        (("arena",), "Arena"),
        (("arena", "--mark-only"), "Arena"),
        (("walk",), "Walk"),
        (("clicks",), "Click points"),
        (("clicks", "one"), "Click points"),
    ],
)
def test_every_step_has_a_view(
    words: tuple[str, ...], doing: str, asked: OnlyQuestion, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), file)
    assert run("calibrate", *words, "--profile", file, "--record", "off", "--view") == 2
    assert capsys.readouterr().err == "mc-nested: that is all\n"
    status = asked.board.status()
    assert (asked.is_viewed, status.doing, status.can_pause) == (True, doing, False)


def test_the_guided_run_has_a_view_that_can_pause_it(
    asked: OnlyQuestion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(calibrate, "examined", lambda *_: SimpleNamespace(checks=[]))
    words = ("--profile", tmp_path / "mine.toml", "--record", "off", "--view")
    assert run("calibrate", "all", *words) == 2
    assert capsys.readouterr().err == "mc-nested: that is all\n"
    status = asked.board.status()
    assert (asked.is_viewed, status.can_pause) == (True, True)
    assert status.doing == "looks at this computer and at the game, as mc-nested doctor does"
