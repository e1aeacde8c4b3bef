"""Write recorded play as a LeRobotDataset of version 3.0: frames, their video, and the design in words as the task.

``action`` is what the keyboard and the mouse did. What the agent had decided, and what came of it, is in ``arena.*``:
the action that was under way, or came next. The extra ``share`` has the packages.
"""

import json
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import draw_grid
from mc_nested.arrays import Arrays, Float64s
from mc_nested.errors import RecordingError
from mc_nested.live.recording.frames import Played, frames_of
from mc_nested.report.film_file import Mp4Encoder

WINDOW = "observation.images.window"

NOWHERE = (-1, -1)
"""Where a block landed, if none did."""

TYPES = {
    **dict.fromkeys(("observation.state", "action", "timestamp"), "float32"),
    **dict.fromkeys(("arena.action", "arena.material", "arena.cell", "arena.placed"), "int64"),
    **dict.fromkeys(("frame_index", "episode_index", "index", "task_index"), "int64"),
}
"""Each column, and its type."""

NAMES = {"observation.state": ["x", "y", "z", "yaw", "pitch"], "arena.cell": ["x", "y"], "arena.placed": ["x", "y"]}
"""The names of what is in a column; those of ``action`` are the keys and buttons that were ever down."""

_PLACE, _FIRST = "chunk-{chunk_index:03d}/file-{file_index:03d}", "chunk-000/file-000"

_KEYFRAME_EVERY = 10
"""Frames: who reads one decodes no more than so many."""


def task_of(scenario: Scenario) -> str:
    """Return a design in words: its name and its drawing."""
    return f"Build {scenario.name}, seen from above, the far edge on top:\n{draw_grid(scenario.design, scenario.size)}"


def write_lerobot(folder: Path, recordings: Sequence[Played], fps: int) -> int:
    """Write recordings into an empty folder, so many frames a second; return how many frames that is.

    Raise RecordingError if their windows have different sizes, FilmError or OSError if they can't be written.
    """
    sizes = {each.size for each in recordings}
    if len(sizes) > 1:
        raise RecordingError("the windows of these recordings have different sizes: export each by itself")
    for name in ("meta/episodes", "data", f"videos/{WINDOW}"):
        (folder / name / _FIRST).parent.mkdir(parents=True)
    tasks = list(dict.fromkeys(task_of(each.scenario) for played in recordings for each in played.episodes))
    rows, colours = _filmed(folder / f"videos/{WINDOW}/{_FIRST}.mp4", recordings, fps, tasks)
    keys = sorted(frozenset().union(*rows["action"]))
    rows["action"] = [[key in held for key in keys] for held in rows["action"]]
    lengths = np.bincount(rows["episode_index"])
    rows["index"] = list(range(lengths.sum()))
    rows["frame_index"] = [at for length in lengths for at in range(length)]
    rows["timestamp"] = [at / fps for at in rows["frame_index"]]
    table = {name: np.array(rows[name], kind).reshape(len(rows["index"]), -1) for name, kind in TYPES.items()}
    pq.write_table(pa.table({name: _column(each) for name, each in table.items()}), folder / f"data/{_FIRST}.parquet")
    episodes = _episodes(lengths, [tasks[at] for at in table["task_index"][lengths.cumsum() - 1, 0]], fps)
    pq.write_table(pa.table(episodes), folder / f"meta/episodes/{_FIRST}.parquet")
    pq.write_table(_indexed_by_task(tasks), folder / "meta/tasks.parquet")
    names = {**NAMES, "action": keys}
    features = {
        name: {"dtype": TYPES[name], "shape": each.shape[1:], "names": names.get(name)} for name, each in table.items()
    }
    info = _info(features, sizes.pop(), fps, len(lengths), len(rows["index"]), len(tasks))
    (folder / "meta/info.json").write_text(json.dumps(info, indent=4), "utf-8")
    stats = {**{name: _stats(each) for name, each in table.items()}, WINDOW: _stats_of_pictures(colours)}
    (folder / "meta/stats.json").write_text(json.dumps(stats, indent=4), "utf-8")
    return len(rows["index"])


def _filmed(
    file: Path, recordings: Sequence[Played], fps: int, tasks: Sequence[str]
) -> tuple[dict[str, list[Any]], Float64s]:
    """Write the video; return each frame's values by column, and its pictures' lowest, highest, mean and mean square.

    Those are (frames, 4, 3), red green blue from 0 to 1.
    """
    encoder = Mp4Encoder(file, fps, _KEYFRAME_EVERY)
    rows: dict[str, list[Any]] = defaultdict(list)
    colours = []
    before = 0
    try:
        for played in recordings:
            for frame in frames_of(played, fps):
                episode = played.episodes[frame.episode]
                step = episode.steps[frame.step]
                rows["episode_index"].append(before + frame.episode)
                rows["task_index"].append(tasks.index(task_of(episode.scenario)))
                rows["action"].append(frame.held)
                rows["observation.state"].append(frame.pose)
                rows["arena.action"].append(step.action)
                rows["arena.material"].append(step.material)
                rows["arena.cell"].append(step.outcome.cell)
                rows["arena.placed"].append(step.outcome.placed or NOWHERE)
                dots = frame.picture[::4, ::4].reshape(-1, 3) / 255
                colours.append([dots.min(0), dots.max(0), dots.mean(0), (dots**2).mean(0)])
                encoder.add(frame.picture, 1)
            before += len(played.episodes)
        encoder.finish()
    finally:
        encoder.stop()
    return rows, np.array(colours)


def _column(values: Any) -> Any:
    """Return (frames, values) as a column: of lists, where there are several values."""
    flat = pa.array(values.reshape(-1))
    return flat if values.shape[1] == 1 else pa.FixedSizeListArray.from_arrays(flat, values.shape[1])


def _episodes(lengths: Any, tasks: Sequence[str], fps: int) -> Mapping[str, Any]:
    ends, first = lengths.cumsum(), [0] * len(lengths)
    files = ("data", "meta/episodes", f"videos/{WINDOW}")
    return {
        "episode_index": range(len(lengths)),
        "tasks": [[task] for task in tasks],
        "length": lengths,
        "dataset_from_index": ends - lengths,
        "dataset_to_index": ends,
        **{f"{of}/{what}_index": first for of in files for what in ("chunk", "file")},
        f"videos/{WINDOW}/from_timestamp": (ends - lengths) / fps,
        f"videos/{WINDOW}/to_timestamp": ends / fps,
    }


def _indexed_by_task(tasks: Sequence[str]) -> Any:
    """Return the tasks as pandas reads them: their text is the index."""
    kinds = {"task_index": ("int64", "int64"), "task": ("unicode", "object")}
    columns = [
        {"name": name, "field_name": name, "pandas_type": kind, "numpy_type": dtype, "metadata": None}
        for name, (kind, dtype) in kinds.items()
    ]
    about = {"index_columns": ["task"], "column_indexes": [], "columns": columns, "pandas_version": "2.2.0"}
    table = pa.table({"task_index": range(len(tasks)), "task": tasks})
    return table.replace_schema_metadata({"pandas": json.dumps(about)})


def _info(
    features: Mapping[str, Any], size: tuple[int, int], fps: int, episodes: int, frames: int, tasks: int
) -> Mapping[str, Any]:
    width, height = (side + side % 2 for side in size)
    video = {"video.height": height, "video.width": width, "video.channels": 3, "video.fps": fps}
    video |= {"video.codec": "h264", "video.pix_fmt": "yuv420p", "video.is_depth_map": False, "has_audio": False}
    names = ["height", "width", "channels"]
    return {
        "codebase_version": "v3.0",
        "robot_type": "mc-nested",
        "total_episodes": episodes,
        "total_frames": frames,
        "total_tasks": tasks,
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "fps": fps,
        "splits": {"train": f"0:{episodes}"},
        "data_path": f"data/{_PLACE}.parquet",
        "video_path": f"videos/{{video_key}}/{_PLACE}.mp4",
        "features": {
            WINDOW: {"dtype": "video", "shape": [height, width, 3], "names": names, "info": video},
            **features,
        },
    }


def _stats(values: Any) -> Mapping[str, Any]:
    stats = {"min": values.min(0), "max": values.max(0), "mean": values.mean(0), "std": values.std(0)}
    return {**{name: each.tolist() for name, each in stats.items()}, "count": [len(values)]}


def _stats_of_pictures(colours: Float64s) -> Mapping[str, Any]:
    mean = colours[:, 2].mean(0)
    deviation = np.sqrt(np.maximum(colours[:, 3].mean(0) - mean**2, 0))
    stats = {"min": colours[:, 0].min(0), "max": colours[:, 1].max(0), "mean": mean, "std": deviation}
    return {**{name: each.reshape(3, 1, 1).tolist() for name, each in stats.items()}, "count": [len(colours)]}
