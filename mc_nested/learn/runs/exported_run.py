"""A training as hubs have models: model.safetensors in place of the checkpoint, config.toml and a card, README.md.

It is the folder of a training all the same, which can be played, but not resumed.
"""

import importlib.metadata
import json
import re
import shlex
from collections.abc import Callable
from pathlib import Path

from mc_nested.arena.scenario_file import draw_grid
from mc_nested.learn.runs.run_folder import RunFolder

_CARD = """---
license: mit
library_name: mc-nested
pipeline_tag: reinforcement-learning
tags: [reinforcement-learning, deep-q-learning, hierarchical, minecraft, gymnasium]
model-index: {index}
---

# {title}

Learnt with mc-nested {version}, which teaches an agent to build in Minecraft Java Edition through keyboard, mouse and
screen. It implements *Hierarchical Reinforcement Learning with Deep Nested Agents* (Brittain and Wei, 2018), and has
never been tried in the real game, only in what stands in for it.

| | |
| --- | --- |
| learnt in | {backend} |
| trials | {trials} |
| seed of all random choices | {seed} |
| training episodes, all trials | {done:,} of at most {most:,} |
| of these, shown by a person | {demonstrated:,} |
| training ends | {ends} |
| score of each trial's greedy episode | {scores} |
| highest score possible | {optimum:g} |

The design, seen from above, the far edge on top:

```text
{design}```

Where mc-nested is installed, this plays it, in the simulator or with `--backend live` in your game:

```bash
mc-nested play {name}
```
"""


def export_run(run: RunFolder, folder: Path, name: str, clean: Callable[[str], str]) -> None:
    """Write a run into an empty folder, whose name will be another; RunError if nothing is trained yet.

    ``clean`` takes names of persons out of what its design and its preset are called.
    """
    scenario, preset = run.config.scenario, Path(run.config.preset_name).stem
    names = {"preset_name": clean(preset), "scenario": scenario.model_copy(update={"name": clean(scenario.name)})}
    exported = RunFolder(folder, run.config.model_copy(update={"profile": None, **names}))
    exported.begin()
    run.checkpoint.export_to(exported.checkpoint)
    (folder / "README.md").write_text(_card_of(exported, name), "utf-8")


def _card_of(run: RunFolder, name: str) -> str:
    config, (done, demonstrated, scores) = run.config, run.how_far()
    finals = [score for score in scores if score is not None]
    metrics = [{"type": "mean_reward", "value": sum(finals) / len(finals)}] if finals else []
    task, design = {"type": "reinforcement-learning"}, {"type": "mc-nested", "name": config.scenario.name}
    index = [{"name": config.title, "results": [{"task": task, "dataset": design, "metrics": metrics}]}]
    return _CARD.format(
        index=json.dumps(index),
        title=re.sub(r"([\\`*_{}\[\]()<>#+!|&~$])", r"\\\1", config.title),
        backend={"sim": "the simulator", "virtual": "the virtual client", "live": "a running game"}[config.backend],
        trials=config.trials,
        seed=config.seed,
        done=done,
        most=config.preset.episodes * config.trials,
        demonstrated=demonstrated,
        ends="at the first greedy episode at the optimum" if config.stop_at_optimum else "after all episodes",
        version=importlib.metadata.version("mc-nested"),
        scores=", ".join("not finished" if score is None else f"{score:g}" for score in scores),
        optimum=run.scenario.optimum,
        design=draw_grid(run.scenario.design, run.scenario.size),
        name=shlex.quote(name),
    )
