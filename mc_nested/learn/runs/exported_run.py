"""A training as hubs have models: model.safetensors in place of the checkpoint, config.toml and a card, README.md.

It is the folder of a training all the same, which can be played, but not resumed.
"""

import json
import re
from collections.abc import Callable
from pathlib import Path

from mc_nested.arena.scenario_file import draw_grid
from mc_nested.learn.runs.run_folder import RunFolder


def export_run(run: RunFolder, folder: Path, name: str, clean: Callable[[str], str]) -> None:
    """Write a run into an empty folder, whose name will be another; RunError if nothing is trained yet.

    ``clean`` takes names of persons out of what its design and its preset are called.
    """
    scenario, preset = run.config.scenario, Path(run.config.preset_name).stem
    names = {"preset_name": clean(preset), "scenario": scenario.model_copy(update={"name": clean(scenario.name)})}
    exported = RunFolder(folder, run.config.model_copy(update={"profile": None, **names}))
    exported.begin()
    run.checkpoint.export_to(exported.checkpoint)
    (folder / "README.md").write_text(_card(exported, name), "utf-8")


def _card(run: RunFolder, name: str) -> str:
    config, scenario = run.config, run.scenario
    done, scores = run.how_far()
    finals = [score for score in scores if score is not None]
    value = sum(finals) / len(finals) if finals else None
    result = {
        "task": {"type": "reinforcement-learning"},
        "dataset": {"type": "mc-nested", "name": scenario.name},
        "metrics": [{"type": "mean_reward", "value": value}],
    }
    front = {
        "license": "mit",
        "library_name": "mc-nested",
        "pipeline_tag": "reinforcement-learning",
        "tags": ["reinforcement-learning", "deep-q-learning", "hierarchical", "minecraft", "gymnasium"],
        **({"model-index": [{"name": config.title, "results": [result]}]} if finals else {}),
    }
    facts = {
        "design": _escaped(f"{scenario.name}, {scenario.blocks} blocks, {scenario.size} x {scenario.size} cells"),
        "materials, with what each adds": _escaped(
            ", ".join(f"{each.name} ({each.p:g})" for each in scenario.materials)
        ),
        "agent, preset": f"{config.agent}, {_escaped(config.preset_name)}",
        "learnt in": {"sim": "the simulator", "virtual": "the virtual client", "live": "a running game"}[
            config.backend
        ],
        "trials, seed": f"{config.trials}, {config.seed}",
        "training episodes, all trials": f"{done:,} of at most {config.preset.episodes * config.trials:,}",
        "final score of each trial": ", ".join("not finished" if each is None else f"{each:g}" for each in scores),
        "optimum": f"{scenario.optimum:g}",
    }
    lines = [
        "---",
        *(f"{key}: {json.dumps(value)}" for key, value in front.items()),
        "---",
        "",
        f"# {_escaped(config.title)}",
        "",
        "Learnt with mc-nested: an agent that builds in Minecraft Java Edition through keyboard, mouse and screen.",
        "",
        "| | |",
        "| --- | --- |",
        *(f"| {key} | {value} |" for key, value in facts.items()),
        "",
        "```text",
        draw_grid(scenario.design, scenario.size) + "```",
        "",
        "With mc-nested installed, this plays it, in the simulator or in your game:",
        "",
        "```bash",
        f"mc-nested play {name}",
        f"mc-nested play {name} --backend live",
        "```",
        "",
    ]
    return "\n".join(lines)


def _escaped(text: str) -> str:
    """Return a text as Markdown shows it as it is."""
    return re.sub(r"([\\`*_{}\[\]()<>#+!|&~$])", r"\\\1", text)
