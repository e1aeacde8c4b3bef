"""The end of a training: its pictures, and lines about its scores, its files and what to do next."""

import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from mc_nested.arena.cooperative.team_env import draw_team_picture
from mc_nested.arena.scenario_file import ScenarioTable, load_scenario, shipped_scenarios, table_of
from mc_nested.atomic_file import atomic_write
from mc_nested.cli.options import DEFAULT_PROFILE
from mc_nested.cli.output import Output
from mc_nested.learn.dqn.engines import SCREEN
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.preset import MOST, load_preset, shipped_presets
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.training import Training
from mc_nested.live.menus.click_points import picture_bytes
from mc_nested.report.arena_map import draw_map
from mc_nested.report.curve import align_trials, draw_curve, draw_played_curve, played_by
from sim.team_grid import team_arenas

CURVE, MAP, PICTURE = "curve.png", "map.png", "team.png"
"""The scores, what was learnt of the arena, and what several builders leave in it, in a run's folder."""

PICTURE_CELL_PX = 32
"""Side of a cell in that picture."""


def draw_results(folder: RunFolder, training: Training) -> None:
    """Draw the curve; what was learnt of the arena, if anything was; and what several builders build, once they can."""
    config, scenario = folder.config, folder.scenario
    with folder.writing(), atomic_write(folder.path / CURVE) as path:
        if training.practice.known:
            played = played_by(training.episode_rows, training.evaluation_rows, config.trials)
            draw_played_curve(path, config.title, played, scenario.optimum)
        else:
            rows = [(row.trial, row.episode, row.score) for row in training.evaluation_rows]
            episodes, scores = align_trials(rows, config.trials)
            draw_curve(path, config.title, episodes, scores, scenario.optimum)
    if training.practice.known:
        which = f", the first of {config.trials} trials" if config.trials > 1 else ""
        with folder.writing(), atomic_write(folder.path / MAP) as path:
            draw_map(path, config.title + which, training.practice.known.known_arena(0))
    if training.finished:
        _draw_team(folder, int(training.policy_scores.argmax()))


def _draw_team(folder: RunFolder, trial: int) -> None:
    """Draw what the policy of that trial leaves behind, if it has several builders: where they end, and the blocks."""
    if folder.team is None:
        return
    arena, agent = team_arenas(folder.team, 1), folder.new_agent(1)
    agent.load_online(folder.policy_of(trial))
    play_greedily(agent.view_of(arena, [folder.scenario]), [folder.scenario], agent)
    cells = [arena.cell(builder) for builder in range(arena.team.builders)]
    picture = draw_team_picture(arena.team, cells, arena.placed(0), PICTURE_CELL_PX)
    with folder.writing(), atomic_write(folder.path / PICTURE) as path:
        path.write_bytes(picture_bytes(picture[:, :, ::-1]))


@dataclass(frozen=True)
class TrainingResult:
    """What ``train`` prints."""

    folder: Annotated[Path, "the run's folder"]
    scenario: Annotated[str, "the design's name"]
    agent: Annotated[str, "who learnt"]
    preset: Annotated[str, "the hyper-parameters' name or file"]
    backend: Annotated[str, "sim, virtual or live"]
    trials: Annotated[int, "independent trainings"]
    seed: Annotated[int, "of all random numbers"]
    episodes: Annotated[int, "a trial's, at most"]
    optimum: Annotated[float, "the highest score possible"]
    final_scores: Annotated[Sequence[float], "of each trial's policy, played greedily"]
    episodes_to_optimum: Annotated[Sequence[int | None], "training episodes until each trial was at the optimum"]
    played_to_optimum: Annotated[Sequence[object], "episodes and steps until then, greedy ones too"]
    episodes_done: Annotated[Sequence[int], "of each trial"]
    demonstrated: Annotated[Sequence[int], "of these, in how many a person acted, or a recording was learnt from"]
    env_steps: Annotated[int, "of training episodes"]
    evaluation_steps: Annotated[int, "of greedy episodes"]
    updates: Annotated[int, "of all networks"]
    wall_s: Annotated[float, "seconds that it took"]
    networks: Annotated[int, "of a trial"]
    parameters: Annotated[int, "of a trial's networks"]
    builders: Annotated[int | None, "of several in one arena: how many"] = None
    networks_kind: Annotated[str | None, "of several builders: shared, own or single"] = None
    starts: Annotated[Sequence[object] | None, "of several builders: their cells at the start"] = None
    live: Annotated[Mapping[str, Any] | None, "of a live game, or of virtual ones: what playing took"] = None


def say_end(output: Output, path: Path, config: RunConfig, summary: Mapping[str, Any]) -> None:
    """Print the outcome of a finished training, with its folder, and what to do next."""
    lines = []
    if config.stop_at_optimum:
        reached = ", ".join("never" if done is None else f"{done}" for done in summary["episodes_to_optimum"])
        played = ", ".join("never" if each is None else f"{each['episodes']}" for each in summary["played_to_optimum"])
        lines.append(f"episodes to the optimum: {reached}; with the greedy ones: {played}")
    if any(summary["demonstrated"]):
        lines.append(f"demonstrated episodes among these: {', '.join(map(str, summary['demonstrated']))}")
    scores = ", ".join(f"{score:g}" for score in summary["final_scores"])
    if config.backend == "virtual":
        minutes = sum(summary["live"]["game_s"]) / 60
        lines.append(
            f"game time:  {minutes:.1f} minutes on the virtual client since the training was last begun or resumed"
        )
    lines += [f"final scores (optimum {summary['optimum']:g}): {scores}"]
    lines += [f"run:        {path}", f"curve:      {path / CURVE}"]
    if config.preset.imagination or config.design_unknown:
        lines.append(f"map:        {path / MAP}")
    if config.team:
        lines.append(f"picture:    {path / PICTURE}")
    lines.append(f"checkpoint: {path / 'checkpoint'}")
    output.result(TrainingResult(path, **summary), *lines)
    for line in next_steps(path, config, max(summary["final_scores"]) >= summary["optimum"]):
        output.hint(line)


def next_steps(path: Path, config: RunConfig, is_at_optimum: bool) -> list[str]:
    """Return what to do with a finished training, one line each."""
    lines = [] if is_at_optimum else [f"below the optimum; for more: {command_line(words_for_more(path, config))}"]
    evaluate = f"{command_line(['mc-nested', 'runs', 'evaluate', str(path)])} plays each of its trials"
    if config.team:
        return [*lines, f"next:       {evaluate}"]
    play = command_line(["mc-nested", "play", str(path), *_live(config)])
    if config.backend == "live":
        return [*lines, f"next:       {play} builds it again"]
    lines.append(f"next:       {play} shows what it builds; in your game: with --backend live")
    if config.trials > 1 and config.preset.states != SCREEN:
        lines.append(f"            {evaluate}")
    return lines


def words_for_more(path: Path, config: RunConfig) -> list[str]:
    """Return the words that train twice as many episodes, beginning with the best policy of this training."""
    words = ["mc-nested", "train", *([] if config.design_unknown else ["--from", str(path)])]
    words += ["--scenario", _named(config.scenario), *(["--design-unknown"] if config.design_unknown else [])]
    if config.team:
        words += ["--networks", config.team.networks]
        words += [word for x, y in config.team.starts for word in ("--start", f"{x},{y}")]
    elif config.agent != "nested":
        words += ["--agent", config.agent]
    words += ["--preset", config.preset_name, *_beside_preset(config)]
    words += ["--episodes", str(min(2 * config.preset.episodes, MOST))]
    if config.stop_at_optimum:
        words.append("--stop-at-optimum")
    return words + _live(config)


def _beside_preset(config: RunConfig) -> list[str]:
    """Return the options that said something else than the preset, as far as it is known.

    A preset that is a file may set an option itself.
    """
    usual = load_preset(config.preset_name if config.preset_name in shipped_presets() else "paper")
    keys = ("engine", "device", "states")
    changed = [key for key in keys if getattr(config.preset, key) != getattr(usual, key)]
    return [word for key in changed for word in (f"--{key}", getattr(config.preset, key))]


def command_line(words: Sequence[str]) -> str:
    """Return the words as they are typed into this system's shell."""
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def _live(config: RunConfig) -> list[str]:
    if config.backend == "virtual":
        return ["--backend", "virtual"]
    if config.backend != "live":
        return []
    profile = [] if config.profile in (None, DEFAULT_PROFILE) else ["--profile", str(config.profile)]
    return ["--backend", "live", *profile]


def _named(table: ScenarioTable) -> str:
    """Return a shipped design's name; FILE for one whose file isn't known any more."""
    shipped = table.name in shipped_scenarios() and table_of(load_scenario(table.name)) == table
    return table.name if shipped else "FILE"
