import json
import shutil
from pathlib import Path

import pytest

from calibration.font.sources import font_of_recording
from calibration.installation.folders import System
from mc_nested.errors import RecordingError
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.recording_file import PartWriter, TimedCall, facts_of, overview_of, read_recording
from mc_nested.live.recording.replayed_run import replay
from mc_nested.live.recording.text_pixels import OUTSIDE
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.mishaps import DRAWN, Kind
from tests.live.recording.recorded_play import record_play
from tests.sim.client.playing import FONT


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Record sixty actions in three episodes, on a virtual client."""
    folder = tmp_path_factory.mktemp("recordings") / "play"
    assert record_play(folder, 60, seed=5) == []
    return folder


def calls_of(path: Path) -> list[TimedCall]:
    return [each for each in read_recording(path) if isinstance(each, TimedCall)]


def written(path: Path, calls: list[TimedCall], facts: dict[str, str]) -> Path:
    writer = PartWriter(path, facts)
    writer.write(calls)
    writer.close()
    return path


def test_a_replay_of_an_unchanged_recording_differs_in_nothing(recording: Path) -> None:
    seen = replay(recording, FONT)
    assert (seen.actions, seen.followed, seen.differences, seen.damaged) == (60, 60, [], [])
    assert seen.read_anew > 5 * seen.actions


def test_every_reading_with_a_target_block_is_recorded_with_its_text_pixels(recording: Path) -> None:
    looks = [each.call for each in calls_of(recording) if each.call[:2] == ["screen", "read"]]
    with_target = [call for call in looks if call[3].get("target")]
    assert len(with_target) > 100
    assert all("text" in call[4] for call in with_target)


def test_a_replay_with_a_changed_glyph_reports_differing_readings(recording: Path) -> None:
    atlas = drawn_atlas().copy()
    cell = atlas.shape[0] // 16
    seven = (slice(3 * cell, 4 * cell), slice(7 * cell, 8 * cell))
    atlas[seven] = atlas[seven][::-1]
    seen = replay(recording, font_of(atlas))
    assert {each.kind for each in seen.differences} == {"reading"}
    assert all("7" in each.then for each in seen.differences)
    assert all(each.picture is not None and each.picture.max() == OUTSIDE for each in seen.differences)
    assert seen.followed == 60  # play is followed on as it was read then


def test_a_replay_reports_a_recorded_press_of_another_key_as_a_differing_decision(
    recording: Path, tmp_path: Path
) -> None:
    calls = calls_of(recording)
    second = [at for at, each in enumerate(calls) if each.call[:2] == ["note", "resets"]][1]
    changed = next(at for at, each in enumerate(calls[:second]) if at > 300 and each.call[:3] == ["key", "press", "a"])
    calls[changed] = TimedCall(calls[changed].at, ["key", "press", "d"])
    seen = replay(written(tmp_path / "changed.mcap", calls, dict(facts_of(recording))), FONT)
    (difference,) = seen.differences
    assert (difference.kind, difference.then, difference.now) == ("decision", "key press d", "key press a")
    # The other two episodes are followed to their end.
    assert 35 <= seen.followed < 60


def test_a_cut_part_begins_at_a_reset_and_can_be_replayed_by_itself(recording: Path, tmp_path: Path) -> None:
    calls = calls_of(recording)
    resets = [each.at for each in calls if each.call[:2] == ["note", "resets"]]
    out = tmp_path / "part.mcap"
    cut(recording, out, (resets[0] + 1 - calls[0].at) / 1e9)
    assert calls_of(out)[0].at == resets[1]
    seen = replay(out, FONT)
    assert (seen.actions, seen.followed, seen.differences) == (35, 35, [])


def test_cutting_removes_names_from_calls_and_title(recording: Path, tmp_path: Path) -> None:
    out = tmp_path / "part.mcap"
    cut(recording, out, clean=lambda text: text.replace("Singleplayer", "<world>"))
    assert "Singleplayer" not in json.dumps([each.call for each in calls_of(out)])
    assert facts_of(out)["title"].endswith("<world>")


def test_cutting_a_time_without_calls_is_an_error_and_leaves_no_file(recording: Path, tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="nothing was recorded then"):
        cut(recording, tmp_path / "none.mcap", 7200)
    assert list(tmp_path.iterdir()) == []


def test_trimming_leaves_one_file_with_the_end_of_the_recording(recording: Path, tmp_path: Path) -> None:
    folder = tmp_path / "play"
    shutil.copytree(recording, folder)
    before = overview_of(folder)
    trim(folder, 3600)
    after = overview_of(folder)
    assert (after.calls, after.actions, after.damage) == (before.calls, 60, ())
    assert [path.name for path in folder.iterdir()] == ["00001.mcap"]


def test_a_replay_follows_a_run_with_two_materials(tmp_path: Path) -> None:
    record_play(tmp_path / "flag", 12, scenario_name="flag")
    taken = [call.call[2]["material"] for call in calls_of(tmp_path / "flag") if call.call[:2] == ["note", "acts"]]
    assert set(taken) == {0, 1}
    seen = replay(tmp_path / "flag", FONT)
    assert (seen.actions, seen.followed, seen.differences) == (12, 12, [])


def test_a_replay_follows_a_run_in_which_each_action_was_announced(tmp_path: Path) -> None:
    folder = tmp_path / "play"
    assert record_play(folder, 60, seed=5, is_told=True) == []
    acts = [call.call[2] for call in calls_of(folder) if call.call[:2] == ["note", "acts"]]
    assert sum("following" in facts for facts in acts) == 57  # all but the last one of each episode
    seen = replay(folder, FONT)
    assert (seen.actions, seen.followed, seen.differences, seen.damaged) == (60, 60, [], [])


def test_a_replay_that_forgets_what_was_announced_differs(tmp_path: Path) -> None:
    record_play(tmp_path / "play", 25, seed=5, is_told=True)
    calls = calls_of(tmp_path / "play")
    for each in calls:
        if each.call[:2] == ["note", "acts"]:
            each.call[2].pop("following", None)
    facts = dict(facts_of(tmp_path / "play"))
    seen = replay(written(tmp_path / "forgets.mcap", calls, facts), FONT)
    assert [each.kind for each in seen.differences] == ["decision"]


def test_a_replay_follows_a_told_run_with_two_materials(tmp_path: Path) -> None:
    record_play(tmp_path / "flag", 24, scenario_name="flag", is_told=True)
    seen = replay(tmp_path / "flag", FONT)
    assert (seen.actions, seen.followed, seen.differences) == (24, 24, [])


@pytest.mark.parametrize("kind", DRAWN)
def test_a_replay_follows_a_run_with_a_mishap_during_its_first_reset(kind: Kind, tmp_path: Path) -> None:
    client = VirtualClient(seed=2)
    client.mishaps.plan(kind, 0.9)
    record_play(tmp_path / "play", 12, client)
    seen = replay(tmp_path / "play", FONT)
    assert client.mishaps.happened
    assert (seen.differences, seen.followed) == ([], seen.actions)


def test_a_replay_follows_an_episode_with_mishaps(tmp_path: Path) -> None:
    client = VirtualClient(seed=2)
    client.mishaps.plan("pause", 1.5)
    failed = record_play(tmp_path / "play", 12, client)
    seen = replay(tmp_path / "play", FONT)
    assert client.mishaps.happened
    assert (seen.differences, len(failed)) == ([], seen.actions - 12)


@pytest.mark.parametrize("is_told", [False, True])
def test_a_replay_follows_a_run_in_which_the_watchdog_released_keys(is_told: bool, tmp_path: Path) -> None:
    record_play(tmp_path / "play", 40, seed=3, is_told=is_told, stalls_every=11)
    elsewhere = [call.call[1:] for call in calls_of(tmp_path / "play") if call.call[0] == "elsewhere"]
    assert sum(call[:2] == ["key", "release"] for call in elsewhere) > 5
    seen = replay(tmp_path / "play", FONT)
    assert (seen.differences, seen.followed) == ([], seen.actions)


@pytest.mark.parametrize("is_told", [False, True])
@pytest.mark.parametrize("switches", [(2.0, 6.0), (0.5, 2.5), (3.37, 5.0, 8.01, 30.0)])
def test_a_replay_follows_a_run_in_which_a_player_took_over(
    is_told: bool, switches: tuple[float, ...], tmp_path: Path
) -> None:
    record_play(tmp_path / "play", 40, seed=3, is_told=is_told, switches=switches)
    calls = [call.call for call in calls_of(tmp_path / "play")]
    assert ["hands", "yielded"] in calls
    assert ["hands", "given back"] in calls
    seen = replay(tmp_path / "play", FONT)
    assert (seen.differences, seen.followed) == ([], seen.actions)


def test_a_recording_that_breaks_off_is_read_up_to_the_break(recording: Path, tmp_path: Path) -> None:
    calls = calls_of(recording)
    file = tmp_path / "whole.mcap"
    writer = PartWriter(file, facts_of(recording))
    ends = []
    for first in range(0, len(calls), 100):
        writer.write([TimedCall(each.at, each.call) for each in calls[first : first + 100]])
        ends.append(file.stat().st_size)
    writer.close()
    content = file.read_bytes()
    for batches in (1, 10, len(ends) // 2):
        early = tmp_path / f"{batches}.mcap"
        early.write_bytes(content[: ends[batches] - 5])
        seen = overview_of(early)
        assert seen.calls == 100 * (batches + 1)
        assert seen.damage == (f"{early.name}: it ends early, as after a crash",)


def test_a_damaged_byte_in_a_recording_is_reported(recording: Path, tmp_path: Path) -> None:
    (part,) = recording.iterdir()
    content = bytearray(part.read_bytes())
    content[len(content) // 2] ^= 0xFF
    file = tmp_path / "damaged.mcap"
    file.write_bytes(content)
    (damage,) = overview_of(file).damage
    assert "damaged" in damage or "ends early" in damage


@pytest.mark.parametrize("content", [b"", b"no recording at all", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n" + b"\xff" * 40])
def test_replaying_a_foreign_file_is_a_one_line_error(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "foreign.mcap"
    file.write_bytes(content)
    with pytest.raises(RecordingError, match="is no recording of mc-nested"):
        replay(file, FONT)


@pytest.mark.parametrize("facts", [{}, {"format": "1"}, {"format": str(FORMAT + 1)}])
def test_recording_of_another_format_is_refused_in_one_line(facts: dict[str, str], tmp_path: Path) -> None:
    file = tmp_path / "other.mcap"
    writer = PartWriter(file, facts)
    writer.close()
    for refused in (lambda: replay(file, FONT), lambda: font_of_recording(file, System("linux", tmp_path, {}))):
        with pytest.raises(RecordingError, match=r"other\.mcap: is of another version of mc-nested: .* record the run"):
            refused()


PRESSED = ["key", "press"]


@pytest.mark.parametrize(
    "ending",
    [
        [["error", "run", "KeyboardInterrupt", ""]],
        [["error", "front", "DesktopError", "it has closed"], ["error", "run", "DesktopError", "it has closed"]],
    ],
    ids=["Ctrl+C", "window closed"],
)
def test_a_run_that_ended_in_the_middle_of_an_action_differs_in_nothing(
    ending: list[list[str]], recording: Path, tmp_path: Path
) -> None:
    calls = calls_of(recording)
    last = max(at for at, each in enumerate(calls) if each.call[:2] == PRESSED and each.call[2] == "w")
    front = next(at for at in range(last, len(calls)) if calls[at].call[0] == "front")
    released = ["key", "release", "w"]
    at_end = [released, *ending] if ending[0][1] == "run" else [ending[0], released, ending[1]]
    ended = [*calls[:front], *(TimedCall(calls[front].at, call) for call in at_end)]
    seen = replay(written(tmp_path / "ended.mcap", ended, dict(facts_of(recording))), FONT)
    assert seen.differences == []
    assert seen.actions > 40


def test_a_run_that_goes_on_after_another_decision_differs(recording: Path, tmp_path: Path) -> None:
    calls = calls_of(recording)
    last = max(at for at, each in enumerate(calls) if each.call[:2] == PRESSED and each.call[2] == "w")
    front = next(at for at in range(last, len(calls)) if calls[at].call[0] == "front")
    released = TimedCall(calls[front].at, ["key", "release", "w"])
    changed = written(tmp_path / "changed.mcap", [*calls[:front], released, *calls[front:]], dict(facts_of(recording)))
    assert [each.kind for each in replay(changed, FONT).differences] == ["decision"]
