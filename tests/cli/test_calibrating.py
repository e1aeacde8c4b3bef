"""``--view`` of every ``mc-nested calibrate`` verb: what is published, and who is asked."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import cast

import pytest

from calibration.context import CalibrationContext, OpenContext
from mc_nested.cli import calibrate_all, calibrating
from mc_nested.cli.viewing import Viewed
from mc_nested.errors import UserError
from mc_nested.live.journal import Journal
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.view.board import Board
from mc_nested.view.publisher import Publisher
from tests.calibration.contexts import profile_in
from tests.cli.running import run


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

    def context_opener(self, _say: object, ask: Callable[[str], bool], *, journal: Journal, **_: object) -> OpenContext:
        @contextmanager
        def opened(_profile: Profile) -> Iterator[CalibrationContext]:
            self.journal, self.answer = journal, ask("Clear it?")
            raise UserError("that is all")
            yield

        return opened


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> OnlyQuestion:
    only = OnlyQuestion()
    monkeypatch.setattr(calibrating, "viewed", only.viewed)
    monkeypatch.setattr(calibrating, "context_opener", only.context_opener)
    return only


@pytest.mark.parametrize("is_viewed", [True, False])
@pytest.mark.parametrize("yes", [True, False])
def test_its_questions_and_its_journal_go_to_the_view(asked: OnlyQuestion, is_viewed: bool, yes: bool) -> None:
    def in_the_terminal(_question: str) -> bool:
        return True

    opened = calibrating.calibrating("walk", "mine", is_viewed=is_viewed, record="off", ask=in_the_terminal, yes=yes)
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
    monkeypatch.setattr(calibrate_all, "_examined", lambda *_: [])
    words = ("--profile", tmp_path / "mine.toml", "--record", "off", "--view")
    assert run("calibrate", "all", *words) == 2
    assert capsys.readouterr().err == "mc-nested: that is all\n"
    status = asked.board.status()
    assert (asked.is_viewed, status.can_pause) == (True, True)
    assert status.doing == "looks at this computer and at the game, as mc-nested doctor does"
