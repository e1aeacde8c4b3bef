"""Everything in one go on virtual clients: what is written, and that nothing is where anything goes wrong."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from calibration.all import GATES, Whole, calibrate_all
from calibration.arena.build import build_arena
from calibration.arena.undo import undo_built_arena
from calibration.doctor.check import NAMES, Check
from calibration.report.chat_region import without_chat
from calibration.report.kept import kept_folder, load_kept
from calibration.run_steps import Run, Step
from calibration.step import Bench, Found, Picture
from calibration.steps import guided_steps
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotConfirmedError, ProfileError, UserError
from mc_nested.live.profile import Profile, earlier_path, load_profile, save_profile
from mc_nested.live.profile_tables import Calibrated, Keys, Screen
from scripts.bench_calibration import bench_of, examined_by, font_in
from sim.client.client import VirtualClient
from tests.calibration.benches import SPANISH

DAY = "2026-11-21"


class Watcher:
    """Notes what was begun and passed over."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.passed: list[str] = []
        self.rows: Sequence[Check] = ()

    def checked(self, checks: Sequence[Check]) -> None:
        self.rows = checks

    def begin(self, name: str, number: int, of: int) -> None:
        self.begun.append(f"{name} {number}/{of}")

    def end(self, found: Found, seconds: float) -> None:
        assert found
        assert seconds >= 0

    def passed_over(self, reason: str, seconds: float) -> None:
        assert seconds >= 0
        self.passed.append(reason)


def all_pass(_name: str) -> list[Check]:
    return [Check(name, "pass", "") for name in NAMES]


def swapped(bench: Bench, profile: Profile) -> Found:
    frame = bench.desktop.display.grab()
    keys = Keys(left="d", right="a")
    return Found("walk", profile.model_copy(update={"keys": keys}), ("swapped",), 8, (Picture("seen", frame),))


def broken(bench: Bench, _profile: Profile) -> Found:
    bench.hands.saw("world")
    bench.hands.press(bench.desktop.clock.now() + 2, "w")
    raise NotConfirmedError("it did not go as it should")


def stopped(bench: Bench, profile: Profile) -> Found:
    with pytest.raises(NotConfirmedError):
        broken(bench, profile)
    raise KeyboardInterrupt


@pytest.fixture
def client() -> VirtualClient:
    client = VirtualClient(pitch=40.0)
    client.clock.sleep(0.3)
    return client


@pytest.fixture
def profile(tmp_path: Path) -> Path:
    """A profile that was there before."""
    path = tmp_path / "mine.toml"
    save_profile(Profile(screen=Screen(font=str(font_in(tmp_path)))), path)
    return path


def run(client: VirtualClient, profile: Path, *steps: Step, watcher: Watcher | None = None) -> Whole:
    return calibrate_all(str(profile), bench_of(client), all_pass, steps, watcher or Watcher(), DAY)


def test_the_profile_is_written_with_what_it_was_calibrated_on(client: VirtualClient, profile: Path) -> None:
    before = profile.read_bytes()
    whole = run(client, profile, Step("walk", swapped))
    written = load_profile(profile)
    assert written == whole.guided.profile
    assert written.keys.left == "d"
    assert written.game.version == "1.20.1"
    assert written.calibrated == Calibrated(
        date=DAY, version="1.20.1", window=(854, 480), gui_scale=2, samples={"walk": 8}
    )
    assert earlier_path(profile).read_bytes() == before


def test_what_was_seen_lies_beside_it(client: VirtualClient, profile: Path) -> None:
    run(client, profile, Step("walk", swapped))
    kept = load_kept(profile)
    assert [(step.step, step.lines, step.date) for step in kept.steps] == [("walk", ("swapped",), DAY)]
    assert [check.name for check in kept.checks] == list(NAMES)
    assert kept.steps[0].pictures[0].frame.shape == (480, 854, 3)


@pytest.mark.parametrize("row", sorted(GATES))
def test_a_row_that_all_the_rest_needs_ends_it_with_its_own_remedy(
    row: str, client: VirtualClient, profile: Path
) -> None:
    before = profile.read_bytes()
    rows = [
        Check(row, "fail", "this is wrong", "do that") if name == row else Check(name, "pass", "") for name in NAMES
    ]
    watcher = Watcher()
    with pytest.raises(DesktopError, match=f"^{row}: this is wrong: do that$"):
        calibrate_all(str(profile), bench_of(client), lambda _: rows, [Step("walk", swapped)], watcher, DAY)
    assert watcher.rows == (), "what fails is said once, by the error"
    assert watcher.begun == []
    assert profile.read_bytes() == before


def test_the_gates_are_rows_that_there_are() -> None:
    assert set(NAMES) >= GATES


def test_rows_that_a_step_may_mend_do_not_end_it(client: VirtualClient, profile: Path) -> None:
    rows = [Check(name, "pass" if name in GATES else "fail", "") for name in NAMES]
    calibrate_all(str(profile), bench_of(client), lambda _: rows, [Step("walk", swapped)], Watcher(), DAY)
    assert load_profile(profile).calibrated is not None


@pytest.mark.parametrize("last", [broken, stopped])
def test_however_it_ends_early_the_profile_is_as_it_was_and_no_key_is_down(
    last: object, client: VirtualClient, profile: Path
) -> None:
    before = profile.read_bytes()
    assert callable(last)
    with pytest.raises((LiveError, KeyboardInterrupt)):
        run(client, profile, Step("walk", swapped), Step("proof", last))
    assert profile.read_bytes() == before
    assert not kept_folder(profile).exists()
    assert not earlier_path(profile).exists()
    assert not client.window.down


def test_a_game_that_others_may_share_is_refused_before_any_step(
    client: VirtualClient, profile: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")
    watcher = Watcher()
    with pytest.raises(DesktopError, match=r"others may be playing there.*--server-allowed"):
        run(client, profile, Step("walk", swapped), watcher=watcher)
    assert watcher.begun == []
    assert client.built == {}


@pytest.mark.parametrize("name", ["dir.toml", "file/mine.toml"])
def test_a_place_that_no_profile_can_be_written_to_is_said_before_the_window_is_looked_for(
    name: str, client: VirtualClient, tmp_path: Path
) -> None:
    (tmp_path / "dir.toml").mkdir()
    (tmp_path / "file").write_text("", "utf-8")
    watcher = Watcher()
    with pytest.raises(ProfileError, match="--profile"):
        run(client, tmp_path / name, Step("walk", swapped), watcher=watcher)
    assert watcher.rows == (), "not even the doctor has looked"
    assert watcher.begun == []


def test_what_can_not_be_kept_for_the_report_does_not_end_it(client: VirtualClient, profile: Path) -> None:
    kept_folder(profile).write_text("no folder", "utf-8")
    run(client, profile, Step("walk", swapped))
    assert load_profile(profile).keys.left == "d"


@pytest.mark.parametrize("standing", [(99, 99), (-1, 0), (15, 0)])
def test_a_cell_outside_the_arena_is_refused_before_anything(standing: tuple[int, int]) -> None:
    with pytest.raises(UserError, match="outside the arena"):
        guided_steps(standing=standing)


@pytest.mark.parametrize("last", [broken, stopped])
def test_ended_after_the_arena_was_built_it_says_how_to_undo_that_and_can(last: Run, tmp_path: Path) -> None:
    client = VirtualClient()
    client.realm.world.put((3, 64, 6), "stone")
    before, file = client.built, tmp_path / "new.toml"
    arena = Step("arena", partial(build_arena, path=file))
    font = Profile(screen=Screen(font=str(font_in(tmp_path))))
    with pytest.raises((LiveError, KeyboardInterrupt)) as ended:
        run(client, file, Step("font", lambda _bench, _profile: Found("font", font, (), 0)), arena, Step("walk", last))
    if isinstance(ended.value, LiveError):
        assert str(ended.value).endswith(f"mc-nested calibrate arena --undo --profile {file}")
    assert not file.exists()
    assert client.built != before
    undo_built_arena(str(file), bench_of(client))
    assert client.built == before
    assert list(tmp_path.glob("new*")) == []


def test_a_window_made_another_size_midway_is_one_line(client: VirtualClient, profile: Path) -> None:
    def resized(bench: Bench, profile: Profile) -> Found:
        client.resize((1280, 720))
        return swapped(bench, profile)

    before = profile.read_bytes()
    with pytest.raises(DesktopError, match="walk: the window was 854 x 480 pixels and is 1280 x 720"):
        run(client, profile, Step("walk", resized))
    assert profile.read_bytes() == before


def test_a_step_that_was_passed_over_has_no_samples(client: VirtualClient, profile: Path) -> None:
    watcher = Watcher()
    whole = run(client, profile, Step("walk", swapped), Step("clicks", broken, is_needed=False), watcher=watcher)
    assert watcher.begun == ["walk 1/2", "clicks 2/2"]
    assert watcher.passed == ["it did not go as it should"]
    assert whole.guided.passed_over == {"clicks": "it did not go as it should"}
    assert whole.guided.profile.calibrated is not None
    assert whole.guided.profile.calibrated.samples == {"walk": 8}


def test_menus_in_another_language_cost_their_points_and_are_said_to(profile: Path) -> None:
    client = VirtualClient(words=SPANISH, pitch=40.0)
    client.clock.sleep(0.3)
    clicks = next(step for step in guided_steps() if step.name == "clicks")
    whole = run(client, profile, Step("walk", swapped), clicks)
    assert whole.guided.passed_over["clicks"].startswith("no button was found; the Game Menu: no English label")
    assert load_profile(profile).points == {}
    assert client.game.screen == "world"


def all_of_it(client: VirtualClient, folder: Path) -> Whole:
    font = font_in(folder)
    examined = examined_by(client, folder)
    return calibrate_all(str(folder / "new.toml"), bench_of(client), examined, guided_steps(font), Watcher(), DAY)


@pytest.mark.slow
def test_from_nothing_to_a_proven_profile_without_a_hand(tmp_path: Path) -> None:
    client = VirtualClient(seed=5, version="1.21.9", size=(1000, 700), scale=0, pitch=35.0, yaw=-86.0, swaps_sides=True)
    began = client.clock.now()
    whole = all_of_it(client, tmp_path)
    assert client.clock.now() - began < 300
    assert whole.guided.passed_over == {}
    written = load_profile(whole.path)
    assert (written.keys.left, written.keys.right) == ("d", "a")
    assert written.marked_arena().facing == "east"
    assert set(written.points) == {
        *("back_to_game", "save_and_quit_to_title", "singleplayer", "world", "play_selected_world")
    }
    assert [step.step for step in load_kept(whole.path).steps] == [
        *("font", "arena", "walk", "clicks", "cross-check", "proof")
    ]
    assert not [check for check in whole.checks if check.status == "fail"]
    pictures = [picture.frame for found in whole.guided.found for picture in found.pictures]
    whole_window = [frame for frame in pictures if frame.shape[:2] == (700, 1000)]
    assert len(whole_window) == 3
    for frame in whole_window:
        assert np.array_equal(frame, without_chat(frame, client.scale)), "nothing that was said is on a picture"
    assert not client.window.down
    assert not client.window.strays


class Troublemaker(Watcher):
    """Lets something happen soon after a step has begun."""

    def __init__(self, client: VirtualClient, step: str, what: str) -> None:
        super().__init__()
        self._client, self._step, self._what = client, step, what

    def begin(self, name: str, number: int, of: int) -> None:
        super().begin(name, number, of)
        if name == self._step:
            self._client.clock.call_at(self._client.clock.now() + 0.15, self._happen)

    def _happen(self) -> None:
        if self._what == "Ctrl+C":
            raise KeyboardInterrupt
        if self._what == "another window":
            self._client.set_front(is_in_front=False)
        else:
            self._client.resize((1024, 768))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("step", "what"),
    [
        *(("font", "Ctrl+C"), ("arena", "Ctrl+C"), ("walk", "Ctrl+C"), ("clicks", "Ctrl+C"), ("proof", "Ctrl+C")),
        *(
            ("walk", "another window"),
            ("proof", "another window"),
            ("font", "another size"),
            ("clicks", "another size"),
        ),
    ],
)
def test_whatever_happens_midway_nothing_is_written_and_no_key_stays_down(step: str, what: str, tmp_path: Path) -> None:
    client = VirtualClient(seed=7, pitch=35.0)
    watcher = Troublemaker(client, step, what)
    steps, examined = guided_steps(font_in(tmp_path)), examined_by(client, tmp_path)
    with pytest.raises((McNestedError, KeyboardInterrupt)) as ended:
        calibrate_all(str(tmp_path / "new.toml"), bench_of(client), examined, steps, watcher, DAY)
    assert "\n" not in str(ended.value)
    assert watcher.begun[-1].startswith(step), "it ended where that happened"
    assert list(tmp_path.glob("new*")) == []
    assert not client.window.down
    assert not client.window.strays
