"""Write recorded play as a LeRobotDataset of version 3.0: frames, their video, and the design in words as the task.

``action`` is what the keyboard and the mouse did. What the agent had decided, and what came of it, is in ``arena.*``:
the action that was under way, or came next. A block that didn't land lies in (-1, -1).
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import draw_grid
from mc_nested.errors import RecordingError
from mc_nested.live.recording.frames import Played, frames_of
from mc_nested.report.film_file import Mp4Encoder

WINDOW = "observation.images.window"

NAMES = {"observation.state": ["x", "y", "z", "yaw", "pitch"], "arena.cell": ["x", "y"], "arena.placed": ["x", "y"]}
"""Names of a column's values; those of ``action`` are the keys and buttons that were ever down, and right button."""

_PLACE, _FIRST = "chunk-{chunk_index:03d}/file-{file_index:03d}", "chunk-000/file-000"


def task_of(scenario: Scenario) -> str:
    """Return a design in words: its name and its drawing."""
    return f"Build {scenario.name}, seen from above, the far edge on top:\n{draw_grid(scenario.design, scenario.size)}"


def write_lerobot(folder: Path, recordings: Sequence[Played], fps: int) -> str:
    """Write recordings into an empty folder, so many frames a second; return how many frames that is, in words.

    Raise RecordingError if their windows have different sizes, FilmError or OSError if they can't be written.
    """
    if len({each.size for each in recordings}) > 1:
        raise RecordingError("the windows of these recordings have different sizes: export each by itself")
    for name in ("meta/episodes", "data", f"videos/{WINDOW}"):
        (folder / name / _FIRST).parent.mkdir(parents=True)
    tasks = list(dict.fromkeys(task_of(each.scenario) for each in recordings))
    rows, dots = _filmed(folder / f"videos/{WINDOW}/{_FIRST}.mp4", recordings, fps, tasks)
    keys = sorted({"mouse.right", *(key for row in rows for key in row["action"])})
    for index, row in enumerate(rows):
        row |= {"action": np.array([key in row["action"] for key in keys], np.float32), "index": index}
    table = {name: np.array([row[name] for row in rows]).reshape(len(rows), -1) for name in rows[0]}
    columns = {
        name: pa.array(list(each)) if each.shape[1] > 1 else pa.array(each[:, 0]) for name, each in table.items()
    }
    features: dict[str, Any] = {
        name: {"dtype": f"{each.dtype}", "shape": each.shape[1:], "names": {**NAMES, "action": keys}.get(name)}
        for name, each in table.items()
    }
    width, height = (side + side % 2 for side in recordings[0].size)
    features[WINDOW] = {
        "dtype": "video",
        "shape": (height, width, 3),
        "names": ("height", "width", "channels"),
        "info": {"video.fps": fps, "video.codec": "h264", "video.pix_fmt": "yuv420p", "has_audio": False},
    }
    lengths = np.bincount(table["episode_index"][:, 0])
    ends, parts = lengths.cumsum(), ("data", "meta/episodes", f"videos/{WINDOW}")
    episodes = {
        "episode_index": range(len(lengths)),
        "tasks": [[tasks[at]] for at in table["task_index"][ends - 1, 0]],
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
        "total_frames": len(rows),
        "total_tasks": len(tasks),
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "splits": {"train": f"0:{len(lengths)}"},
        "data_path": f"data/{_PLACE}.parquet",
        "video_path": f"videos/{{video_key}}/{_PLACE}.mp4",
        "features": features,
    }
    pq.write_table(pa.table(columns), folder / f"data/{_FIRST}.parquet")
    pq.write_table(pa.table(episodes), folder / f"meta/episodes/{_FIRST}.parquet")
    pq.write_table(_indexed(tasks), folder / "meta/tasks.parquet")
    stats = {name: _stats(each) for name, each in {**table, WINDOW: dots}.items()}
    for name, said in (("info", info), ("stats", stats)):
        (folder / f"meta/{name}.json").write_text(json.dumps(said, indent=2), "utf-8")
    return f"{len(rows):,} frames"


def _filmed(
    file: Path, recordings: Sequence[Played], fps: int, tasks: Sequence[str]
) -> tuple[list[dict[str, Any]], Any]:
    """Write the video; return each frame's values by column, and some of its dots, (dots, 3, 1, 1), from 0 to 1."""
    encoder = Mp4Encoder(file, fps, whole_every=10)
    rows: list[dict[str, Any]] = []
    dots, before = [], 0
    try:
        for played in recordings:
            for frame in frames_of(played, fps):
                episode, outcome = before + frame.episode, frame.step.outcome
                number = rows[-1]["frame_index"] + 1 if rows and rows[-1]["episode_index"] == episode else 0
                rows.append(
                    {
                        "observation.state": np.array(frame.pose, np.float32),
                        "action": frame.held,
                        "arena.action": int(frame.step.action),
                        "arena.material": frame.step.material,
                        "arena.cell": outcome.cell,
                        "arena.placed": outcome.placed or (-1, -1),
                        "timestamp": np.float32(number / fps),
                        "frame_index": number,
                        "episode_index": episode,
                        "task_index": tasks.index(task_of(played.scenario)),
                    }
                )
                dots.append(frame.picture[8::64, 8::64].reshape(-1, 3, 1, 1))
                encoder.add(frame.picture, 1)
            before += len(played.episodes)
        encoder.finish()
    finally:
        encoder.stop()
    return rows, np.concatenate(dots) / 255


def _indexed(tasks: Sequence[str]) -> Any:
    """Return the table of tasks as pandas reads it, their texts its index."""
    kinds = (("task_index", "int64", "int64"), ("task", "unicode", "object"))
    columns = [{"name": name, "field_name": name, "pandas_type": kind, "numpy_type": of} for name, kind, of in kinds]
    about = {"index_columns": ["task"], "column_indexes": [], "columns": columns}
    table = pa.table({"task_index": range(len(tasks)), "task": tasks})
    return table.replace_schema_metadata({"pandas": json.dumps(about)})


def _stats(values: Any) -> Mapping[str, Any]:
    stats = {"min": values.min(0), "max": values.max(0), "mean": values.mean(0), "std": values.std(0)}
    return {**{name: each.tolist() for name, each in stats.items()}, "count": [len(values)]}
