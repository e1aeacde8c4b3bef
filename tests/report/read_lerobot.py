"""Reads a dataset with LeRobot itself: ``python read_lerobot.py FOLDER INDEX...`` prints what it says of frames."""

import json
import sys
from typing import Any

import torch

# The compiled part of torchvision is that of another torch. The rest of it runs without, once this operator has a name.
OPERATORS: Any = torch.library.Library("torchvision", "DEF")  # type: ignore[no-untyped-call]
OPERATORS.define("nms(Tensor dets, Tensor scores, float iou_threshold) -> Tensor")


def said_of(item: dict[str, Any], picture: str) -> dict[str, Any]:
    frame = item.pop(picture)
    values = {name: value if isinstance(value, str) else value.tolist() for name, value in item.items()}
    return {**values, "shape": list(frame.shape), "colours": (frame.mean(dim=(1, 2)) * 255).tolist()}


def main() -> None:
    from lerobot.datasets.lerobot_dataset import LeRobotDataset  # type: ignore[import-not-found]

    folder, *indices = sys.argv[1:]
    dataset = LeRobotDataset("local/played", root=folder, video_backend="pyav")
    (picture,) = dataset.meta.video_keys
    found = {
        "frames": len(dataset),
        "episodes": dataset.num_episodes,
        "fps": dataset.fps,
        "keys": dataset.features["action"]["names"],
        "means": dataset.meta.stats["action"]["mean"].tolist(),
        "items": [said_of(dataset[int(index)], picture) for index in indices],
    }
    print(json.dumps(found))


if __name__ == "__main__":
    main()
