"""A LeRobotDataset is what its files are said to be, and LeRobot's own reader gives each frame as it was."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from mc_nested.live.recording.demonstrations import RecordedPlay, played_in
from mc_nested.live.recording.frames import frames_of
from mc_nested.report.lerobot_dataset import WINDOW, task_of, write_lerobot
from scripts.programs import ROOT
from tests.live.recording.recorded_play import record_play
from tests.made_once import made_once
from tests.recordings.test_recordings import VIRTUAL
from tests.report.films import pictures_of

FPS = 10
FIRST = "chunk-000/file-000"


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> list[RecordedPlay]:
    """Return two recordings: of two episodes of the diamond, and of one of the line."""
    folder = tmp_path_factory.mktemp("play") / "play"
    record_play(folder, 28, seed=5)
    return [played_in(folder), played_in(VIRTUAL / "rehearsal-window.mcap")]


@pytest.fixture(scope="module")
def dataset(played: list[RecordedPlay], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dataset")
    write_lerobot(folder, played, FPS)
    return folder


def test_files_are_those_of_version_3(dataset: Path) -> None:
    files = {file.relative_to(dataset).as_posix() for file in dataset.rglob("*") if file.is_file()}
    meta = {"meta/info.json", "meta/stats.json", "meta/tasks.parquet", f"meta/episodes/{FIRST}.parquet"}
    assert files == {*meta, f"data/{FIRST}.parquet", f"videos/{WINDOW}/{FIRST}.mp4"}
    info = json.loads((dataset / "meta/info.json").read_text())
    assert (info["codebase_version"], info["fps"], info["total_episodes"]) == ("v3.0", FPS, 3)
    table = pq.read_table(dataset / f"data/{FIRST}.parquet")
    assert (
        {*table.column_names, WINDOW}
        == info["features"].keys()
        == json.loads((dataset / "meta/stats.json").read_text()).keys()
    )
    assert table.num_rows == info["total_frames"] == len(pictures_of(dataset / f"videos/{WINDOW}/{FIRST}.mp4"))


def test_episodes_follow_each_other_without_a_gap(dataset: Path) -> None:
    episodes = pq.read_table(dataset / f"meta/episodes/{FIRST}.parquet").to_pylist()
    assert [each["tasks"][0].split(",")[0] for each in episodes] == ["Build diamond", "Build diamond", "Build line"]
    end = 0
    for each in episodes:
        assert (each["dataset_from_index"], each["length"]) == (end, each["dataset_to_index"] - end)
        assert each[f"videos/{WINDOW}/from_timestamp"] == end / FPS
        end = each["dataset_to_index"]
    assert end == pq.read_table(dataset / f"data/{FIRST}.parquet").num_rows


def test_each_row_is_the_recordings_frame(dataset: Path, played: list[RecordedPlay]) -> None:
    keys = json.loads((dataset / "meta/info.json").read_text())["features"]["action"]["names"]
    rows = pq.read_table(dataset / f"data/{FIRST}.parquet").to_pylist()
    frames = [frame for each in played for frame in frames_of(each, FPS)]
    for row, frame in zip(rows, frames, strict=True):
        assert {key for key, down in zip(keys, row["action"], strict=True) if down} == frame.held
        assert np.allclose(row["observation.state"], frame.pose, rtol=1e-6)
        assert row["arena.action"] == frame.step.action
        assert tuple(row["arena.cell"]) == frame.step.outcome.cell
        assert tuple(row["arena.placed"]) == (frame.step.outcome.placed or (-1, -1))
    assert {key for key in keys if "mouse" in key} == {"mouse.right"}


def install(folder: Path) -> None:
    """Install LeRobot's reader into a folder, without what the rest of LeRobot needs."""
    words = ("-m", "pip", "install", "--quiet", "--no-deps", "--target", folder)
    subprocess.run([sys.executable, *words, "-r", ROOT / "tests/report/lerobot.txt"], check=True)


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="its environment is locked as on Linux")
def test_lerobot_itself_reads_it(
    dataset: Path, played: list[RecordedPlay], tmp_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    packages = made_once("lerobot", install, tmp_path_factory)
    frames = [frame for each in played for frame in frames_of(each, FPS)]
    indices = [0, 7, len(frames) // 2, len(frames) - 1]
    paths = os.pathsep.join([str(packages), os.environ.get("PYTHONPATH", "")])
    hub = {"HF_HUB_OFFLINE": "1", "HF_HOME": str(tmp_path / "hub")}
    said = subprocess.run(
        [sys.executable, "-W", "ignore", ROOT / "tests/report/read_lerobot.py", dataset, *map(str, indices)],
        env={**os.environ, **hub, "PYTHONPATH": paths},
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    found = json.loads(said.stdout)
    assert (found["frames"], found["episodes"], found["fps"]) == (len(frames), 3, FPS)
    for item, index in zip(found["items"], indices, strict=True):
        frame = frames[index]
        assert item["shape"] == [3, 480, 854]
        assert np.allclose(item["colours"], frame.picture.mean(axis=(0, 1)), atol=2)
        assert {key for key, down in zip(found["keys"], item["action"], strict=True) if down} == frame.held
        assert item["arena.action"] == frame.step.action
        assert np.allclose(item["observation.state"], frame.pose, rtol=1e-6)
    assert [found["items"][at]["task"] for at in (0, -1)] == [task_of(each.scenario) for each in played]
    held = np.mean([[key in frame.held for key in found["keys"]] for frame in frames], axis=0)
    assert np.allclose(found["means"], held)
