"""The view's screens, as text, at the usual terminal sizes; and its keys."""

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import NamedTuple

import pytest
from syrupy.assertion import SnapshotAssertion
from textual.pilot import Pilot

from mc_nested.view import app as looking
from mc_nested.view.app import ViewApp
from mc_nested.view.files import FOLDER, PAUSE, TAKEOVER, Requests, StatusFiles, ask
from mc_nested.view.status import FORMAT, ArenaSeen, Learning, Standing, Status
from mc_nested.view.words import FRESH_S
from tests.view.shown import LIVE, screen_text

Act = Callable[[ViewApp, Pilot[None]], Awaitable[None]]

CROWD = LIVE.model_copy(
    update={
        "reading": None,
        "actions": (),
        "lines": (),
        "title": "corner, nested agent, preset paper, in the simulator",
        "doing": "trains in the simulator",
        "detail": "61,204 steps a second",
        "learning": Learning(
            trials=90,
            episodes=12_345,
            episodes_at_most=270_000,
            score=3.5,
            best=4.25,
            optimum=8.0,
            at_optimum=7,
            scores=tuple(number / 20 for number in range(100)),
            exploring="ε 0.31, 0.12 (main agent, nested agent)",
        ),
        "arena": ArenaSeen(
            size=4,
            design=((1, 1), (2, 1), (2, 2)),
            stands=(Standing(1, 1, 81), Standing(2, 1, 60), Standing(0, 3, 12)),
            agents=(Standing(0, 0, 77), Standing(1, 2, 9), Standing(3, 0, 4)),
        ),
    }
)

STATUSES: dict[str, Status] = {
    "a live training": LIVE,
    "ninety trials": CROWD,
    "waiting for the player": LIVE.model_copy(
        update={"doing": "waits for the game's window to come to the front", "detail": "", "mood": "waits"}
    ),
    "taken over": LIVE.model_copy(
        update={
            "doing": "the player plays, and gives back with the same key",
            "detail": "",
            "mood": "player",
            "can_take_over": True,
        }
    ),
    "set back": LIVE.model_copy(
        update={"doing": "was set back: no block was seen at (2, 2)", "detail": "", "mood": "fails"}
    ),
    "a question": LIVE.model_copy(update={"question": "The arena's region is cleared. Go on?", "question_number": 41}),
    "paused": LIVE.model_copy(update={"paused": True}),
    "ended": LIVE.model_copy(update={"ended": "finished"}),
    "calibration": Status(
        format=FORMAT,
        at=LIVE.at,
        what="calibrate all",
        title="profile default",
        doing="step 3 of 6: Walking",
        since=LIVE.at - 1,
    ),
}


@pytest.fixture(autouse=True)
def often(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the view look more often, and close soon, so that no test waits long; each look costs milliseconds."""
    monkeypatch.setattr(looking, "LOOK_EVERY_S", 0.1)
    monkeypatch.setattr(looking, "CLOSES_AFTER_S", 0.05)


class CountedApp(ViewApp):
    """The view, which counts how often it has looked."""

    looks = 0

    def _look(self) -> None:
        super()._look()
        self.looks += 1


async def until_it_looks(app: ViewApp, pilot: Pilot[None]) -> None:
    """Wait until it has looked twice more: a look may be going on."""
    assert isinstance(app, CountedApp)
    before = app.looks
    while app.looks < before + 2:
        await pilot.pause(0.02)


SIZES = {"80x24": (80, 24), "200x60": (200, 60), "40x24": (40, 24)}


def shown(
    folder: Path,
    status: Status,
    size: tuple[int, int],
    act: Act,
    *,
    closes_at_end: bool = False,
    after: float = 0.0,
) -> str:
    """Return the screen after ``act``, so many seconds after the status was written: the run goes on, or is gone."""
    StatusFiles(folder).write(status)

    async def look() -> str:
        app = CountedApp(folder, closes_at_end=closes_at_end, clock=lambda: status.at + after)
        async with app.run_test(size=size, notifications=True) as pilot:
            await pilot.pause()
            await act(app, pilot)
            await pilot.pause()
            return screen_text(app.export_screenshot())

    return asyncio.run(look())


async def nothing(_app: ViewApp, _pilot: Pilot[None]) -> None:
    """Only look."""


@pytest.fixture
def live(tmp_path: Path) -> Path:
    """Return a run's folder; what is written there is of just now, so that it goes on."""
    return tmp_path


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", STATUSES)
def test_screen_of_each_status_matches_its_snapshot(
    live: Path, name: str, size: str, snapshot: SnapshotAssertion
) -> None:
    assert shown(live, STATUSES[name], SIZES[size], nothing) == snapshot


@pytest.mark.parametrize("name", STATUSES)
def test_resized_screen_equals_one_opened_at_that_size(tmp_path: Path, live: Path, name: str) -> None:
    async def resize(_app: ViewApp, pilot: Pilot[None]) -> None:
        await pilot.resize_terminal(*SIZES["200x60"])

    small = shown(live, STATUSES[name], SIZES["80x24"], resize)

    assert small == shown(tmp_path / "another", STATUSES[name], SIZES["200x60"], nothing)


def test_view_says_so_if_the_runs_process_is_gone(tmp_path: Path) -> None:
    screen = shown(tmp_path, LIVE, SIZES["80x24"], nothing, after=FRESH_S)

    assert "✗ the run's process is gone; it was last seen at 01:48:20" in screen


def test_view_shows_a_status_that_is_published_while_it_is_open(live: Path) -> None:
    async def go_on(app: ViewApp, pilot: Pilot[None]) -> None:
        StatusFiles(live).write(LIVE.model_copy(update={"doing": "resets the arena"}))
        await until_it_looks(app, pilot)

    assert "resets the arena" in shown(live, LIVE, SIZES["80x24"], go_on)


class Heard(NamedTuple):
    """The requests that a run has received."""

    pause: bool
    stop: bool


def pressed(folder: Path, *keys: str, status: Status = LIVE, closes_at_end: bool = False) -> tuple[str, Heard]:
    """Return the screen after these keys, and what the run was asked before the view was left."""
    (folder / FOLDER).mkdir(exist_ok=True)
    requests = Requests(folder)
    heard: list[Heard] = []

    async def press(app: ViewApp, pilot: Pilot[None]) -> None:
        await pilot.press(*keys)
        if not app._exit:
            await until_it_looks(app, pilot)
        heard.append(Heard(requests.is_pause_asked(), requests.is_stop_asked()))

    return shown(folder, status, SIZES["80x24"], press, closes_at_end=closes_at_end), heard[0]


@pytest.mark.parametrize(
    ("keys", "wanted"),
    [
        (["p"], Heard(pause=True, stop=False)),
        (["p", "p"], Heard(pause=False, stop=False)),
        (["s"], Heard(pause=False, stop=True)),
        (["p", "s"], Heard(pause=True, stop=True)),
        (["y"], Heard(pause=False, stop=False)),
        (["p", "q"], Heard(pause=False, stop=False)),
        (["ctrl+c"], Heard(pause=False, stop=False)),
    ],
)
def test_keys_send_requests_to_the_run(live: Path, keys: list[str], wanted: Heard) -> None:
    assert pressed(live, *keys)[1] == wanted


def test_p_is_no_longer_offered_once_the_run_says_that_it_can_not_pause(live: Path) -> None:
    async def learn(app: ViewApp, pilot: Pilot[None]) -> None:
        StatusFiles(live).write(LIVE.model_copy(update={"can_pause": False}))
        await until_it_looks(app, pilot)

    assert "pause" not in shown(live, LIVE, SIZES["80x24"], learn)


def test_run_that_cannot_pause_is_not_asked_for_a_pause_and_p_is_not_offered(live: Path) -> None:
    screen, heard = pressed(live, "p", status=LIVE.model_copy(update={"can_pause": False}))

    assert not heard.pause
    assert "pause" not in screen
    assert " s stop" in screen


@pytest.mark.parametrize("may", [True, False])
def test_t_asks_to_take_over_where_the_run_offers_that(live: Path, may: bool) -> None:
    screen, _ = pressed(live, "t", status=LIVE.model_copy(update={"can_take_over": may}))
    assert (live / FOLDER / TAKEOVER).exists() == may == ("t take over, give back" in screen)


def test_ctrl_c_in_the_runs_own_view_stops_the_run(live: Path) -> None:
    assert pressed(live, "ctrl+c", closes_at_end=True)[1].stop


def pressing(*keys: str) -> Act:
    async def press(_app: ViewApp, pilot: Pilot[None]) -> None:
        await pilot.press(*keys)

    return press


def test_p_resumes_a_run_that_another_view_paused(live: Path) -> None:
    (live / FOLDER).mkdir()
    requests = Requests(live)
    ask(PAUSE, live)

    shown(live, STATUSES["paused"], SIZES["80x24"], pressing("p"))

    assert not requests.is_pause_asked()


@pytest.mark.parametrize(
    ("keys", "answer"), [(["y"], True), (["n"], False), (["left", "y"], None)], ids=["yes", "no", "not on the screen"]
)
def test_y_and_n_answer_a_question_only_while_it_is_on_the_screen(
    live: Path, keys: list[str], answer: bool | None
) -> None:
    (live / FOLDER).mkdir()
    requests = Requests(live)

    shown(live, STATUSES["a question"], SIZES["80x24"], pressing(*keys))

    assert requests.answer_to(41) is answer


@pytest.mark.parametrize("keys", [["s"], ["p"], ["left", "s"]])
def test_keys_ask_nothing_of_a_run_that_has_ended(live: Path, keys: list[str]) -> None:
    screen, heard = pressed(live, *keys, status=STATUSES["ended"])

    assert "s stop" not in screen
    assert heard == Heard(pause=False, stop=False)


def test_a_long_question_is_shown_whole_with_its_keys(live: Path) -> None:
    question = "Build the arena here? " + "Every reset will remove all blocks in it. " * 8
    asks = LIVE.model_copy(update={"question": question, "question_number": 41})

    screen = shown(live, asks, SIZES["80x24"], nothing)

    assert " ".join(screen.split()).count("remove all blocks") == 8
    assert "Press y for yes, n for no." in " ".join(screen.split())
    assert "y yes  n no" in screen


@pytest.mark.parametrize("size", SIZES)
def test_arena_that_is_published_later_is_shown_like_one_from_the_start(tmp_path: Path, live: Path, size: str) -> None:
    async def come(app: ViewApp, pilot: Pilot[None]) -> None:
        StatusFiles(live).write(LIVE)
        await until_it_looks(app, pilot)

    later = shown(live, LIVE.model_copy(update={"arena": None}), SIZES[size], come)

    assert later == shown(tmp_path / "another", LIVE, SIZES[size], nothing)


@pytest.mark.parametrize(
    ("keys", "at"),
    [
        (["left"], "01:48:39"),
        (["left", "left", "right"], "01:48:39"),
        (["pageup"], "01:48:38"),
        (["home"], "01:48:20"),
        (["home", "pagedown"], "01:48:22"),
        (["home", "left"], "01:48:20"),
    ],
)
def test_keys_move_through_the_past_moment_by_moment(live: Path, keys: list[str], at: str) -> None:
    files = StatusFiles(live)
    for second in range(20):
        files.write(LIVE.model_copy(update={"at": LIVE.at + second, "doing": f"does something at {second}"}))
    last = LIVE.model_copy(update={"at": LIVE.at + 20})

    async def press(app: ViewApp, pilot: Pilot[None]) -> None:
        await pilot.press(*keys)
        assert app.shown.is_past

    screen = shown(live, last, SIZES["80x24"], press)

    second = int(at[-2:]) - 20
    assert f"does something at {second}:" in screen
    assert "01:48:20 " in screen
    assert " 01:48:40" in screen


def test_the_end_key_leads_back_to_now(live: Path) -> None:
    async def press(app: ViewApp, pilot: Pilot[None]) -> None:
        await pilot.press("left", "end")
        assert not app.shown.is_past

    assert "now, 01:48:20" in shown(live, LIVE, SIZES["80x24"], press)


def test_view_closes_by_itself_once_the_run_has_ended(live: Path) -> None:
    async def end(app: ViewApp, pilot: Pilot[None]) -> None:
        await until_it_looks(app, pilot)
        assert app.is_running
        StatusFiles(live).write(STATUSES["ended"])
        for _ in range(2000):
            await pilot.pause(0.01)
            if not app.is_running or app._exit:
                return
        pytest.fail("it stays open")

    shown(live, LIVE, SIZES["80x24"], end, closes_at_end=True)


def test_the_view_keeps_what_it_shows_if_the_folder_disappears(live: Path) -> None:
    async def lose(app: ViewApp, pilot: Pilot[None]) -> None:
        (live / "view" / "now.json").unlink()
        await until_it_looks(app, pilot)

    assert "moves back and places a block" in shown(live, LIVE, SIZES["80x24"], lose)


def test_without_colours_the_screen_says_the_same(live: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with_colours = shown(live, LIVE, SIZES["80x24"], nothing)
    monkeypatch.setenv("NO_COLOR", "1")

    assert shown(live, LIVE, SIZES["80x24"], nothing) == with_colours
