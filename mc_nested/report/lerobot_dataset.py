"""Write recorded play as a LeRobotDataset of version 3.0: frames, their video, and the design in words as the task.

``action`` is what the keyboard and the mouse did. What the agent had decided, and what came of it, is in ``arena.*``:
the action that was under way, or came next. A block that didn't land lies in (-1, -1).
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import draw_grid
from mc_nested.errors import RecordingError
from mc_nested.live.profile.tables import KeysTable
from mc_nested.live.recording.demonstrations import RecordedPlay
from mc_nested.live.recording.frames import PlayedFrame, frames_of
from mc_nested.report.film_file import Mp4Encoder

WINDOW = "observation.images.window"

NAMES = {"observation.state": ["x", "y", "z", "yaw", "pitch"], "arena.cell": ["x", "y"], "arena.placed": ["x", "y"]}
"""Names of a column's values."""

_USUAL = KeysTable()
KEYS = (_USUAL.forward, _USUAL.left, _USUAL.back, _USUAL.right, _USUAL.sneak, *_USUAL.hotbar, "mouse.right")
"""Keys and buttons that ``action`` has a value for in every dataset; of others, those that were ever down."""

_PLACE, _FIRST = "chunk-{chunk_index:03d}/file-{file_index:03d}", "chunk-000/file-000"


def task_of(scenario: Scenario) -> str:
    """Return a design in words: its name and its drawing."""
    return f"Build {scenario.name}, seen from above, the far edge on top:\n{draw_grid(scenario.design, scenario.size)}"


def write_lerobot(folder: Path, recordings: Sequence[RecordedPlay], fps: int) -> str:
    """Write recordings into an empty folder, so many frames a second; return how many frames that is, in words.

    Raise RecordingError if their windows have different sizes, FilmError or OSError if they can't be written.
    """
    if len({each.size for each in recordings}) > 1:
        raise RecordingError("the windows of these recordings have different sizes: export each by itself")
    parts = ("data", "meta/episodes", f"videos/{WINDOW}")
    for part in parts:
        (folder / part / _FIRST).parent.mkdir(parents=True)
    frames = _filmed(folder / f"videos/{WINDOW}/{_FIRST}.mp4", recordings, fps)
    keys = sorted({*KEYS, *set().union(*(frame.held for frame in frames))})
    task_of_each = [task_of(played.scenario) for played in recordings for _ in played.episodes]
    tasks = list(dict.fromkeys(task_of_each))
    index, episode = np.arange(len(frames)), np.array([frame.episode for frame in frames])
    lengths = np.bincount(episode)
    ends = lengths.cumsum()
    numbers = index - (ends - lengths)[episode]
    table: dict[str, NDArray[Any]] = {
        "observation.state": np.array([frame.pose for frame in frames], np.float32),
        "action": np.array([[key in frame.held for key in keys] for frame in frames], np.float32),
        "arena.action": np.array([int(frame.step.action) for frame in frames]),
        "arena.material": np.array([frame.step.material for frame in frames]),
        "arena.cell": np.array([frame.step.outcome.cell for frame in frames]),
        "arena.placed": np.array([frame.step.outcome.placed or (-1, -1) for frame in frames]),
        "timestamp": (numbers / fps).astype(np.float32),
        "frame_index": numbers,
        "episode_index": episode,
        "index": index,
        "task_index": np.array([tasks.index(task) for task in task_of_each])[episode],
    }
    features: dict[str, Any] = {
        name: {"dtype": f"{each.dtype}", "shape": each.shape[1:] or (1,), "names": {**NAMES, "action": keys}.get(name)}
        for name, each in table.items()
    }
    width, height = (side + side % 2 for side in recordings[0].size)
    features[WINDOW] = {"dtype": "video", "shape": (height, width, 3), "names": ("height", "width", "channels")}
    episodes = {
        "episode_index": range(len(lengths)),
        "tasks": [[task] for task in task_of_each],
        "length": lengths,
        "dataset_from_index": ends - lengths,
        "dataset_to_index": ends,
        f"videos/{WINDOW}/from_timestamp": (ends - lengths) / fps,
        f"videos/{WINDOW}/to_timestamp": ends / fps,
        **{f"{part}/{number}_index": [0] * len(lengths) for part in parts for number in ("chunk", "file")},
    }
    info = {
        "codebase_version": "v3.0",
        "robot_type": "mc-nested",
        "fps": fps,
        "total_episodes": len(lengths),
        "total_frames": len(frames),
        "total_tasks": len(tasks),
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "splits": {"train": f"0:{len(lengths)}"},
        "data_path": f"data/{_PLACE}.parquet",
        "video_path": f"videos/{{video_key}}/{_PLACE}.mp4",
        "features": features,
    }
    columns = {name: pa.array(list(each) if each.ndim > 1 else each) for name, each in table.items()}
    pq.write_table(pa.table(columns), folder / f"data/{_FIRST}.parquet")
    pq.write_table(pa.table(episodes), folder / f"meta/episodes/{_FIRST}.parquet")
    pq.write_table(_indexed(tasks), folder / "meta/tasks.parquet")
    dots = np.concatenate([frame.picture.reshape(-1, 3, 1, 1) for frame in frames]) / 255
    stats = {name: _stats(each) for name, each in {**table, WINDOW: dots}.items()}
    for name, said in (("info", info), ("stats", stats)):
        (folder / f"meta/{name}.json").write_text(json.dumps(said, indent=2), "utf-8")
    return f"{len(frames):,} frames"


def _filmed(file: Path, recordings: Sequence[RecordedPlay], fps: int) -> list[PlayedFrame]:
    """Write the video; return its frames, of whose pictures some dots are left."""
    encoder = Mp4Encoder(file, fps, whole_every=10)
    frames: list[PlayedFrame] = []
    try:
        for played in recordings:
            before = frames[-1].episode + 1 if frames else 0
            for frame in frames_of(played, fps):
                encoder.add(frame.picture, 1)
                dots = frame.picture[8::64, 8::64].copy()
                frames.append(replace(frame, episode=before + frame.episode, picture=dots))
        encoder.finish()
    finally:
        encoder.stop()
    return frames


def _indexed(tasks: Sequence[str]) -> Any:
    """Return the table of tasks as pandas reads it, their texts its index."""
    task = {"name": "task", "field_name": "task", "pandas_type": "unicode", "numpy_type": "object"}
    about = {"index_columns": ["task"], "column_indexes": [], "columns": [task]}
    table = pa.table({"task_index": range(len(tasks)), "task": tasks})
    return table.replace_schema_metadata({"pandas": json.dumps(about)})


def _stats(values: NDArray[Any]) -> Mapping[str, Any]:
    rows = values if values.ndim > 1 else values[:, None]
    stats = {"min": rows.min(0), "max": rows.max(0), "mean": rows.mean(0), "std": rows.std(0)}
    return {**{name: each.tolist() for name, each in stats.items()}, "count": [len(rows)]}
