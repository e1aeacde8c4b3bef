"""``mc-nested cooperate``: train several builders in one simulated arena, or resume that."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import cv2
import numpy as np
import typer

from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.cooperative.team_env import TeamEnv, draw_team_picture
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.atomic_file import atomic_write
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.output import JsonOption, Output, QuietOption
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.progress import STOPPING
from mc_nested.cli.scenario_options import FILES, NAME_OR_FILE, LayerOption, named_scenario
from mc_nested.cli.team_progress import TeamProgress
from mc_nested.cli.train import MOST_TRIALS
from mc_nested.errors import UserError
from mc_nested.learn.cooperation.team_agent import KINDS, Kind, check_team_preset
from mc_nested.learn.cooperation.team_evaluation import play_team_greedily
from mc_nested.learn.cooperation.team_run import TeamConfig, TeamRun
from mc_nested.learn.cooperation.team_trainer import TeamArena, TeamTrainer, arena_of
from mc_nested.learn.preset import MOST, load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.curve import align_trials, draw_curve
from sim.team_grid import TeamGrid

SAVE_EVERY_S = 60.0
"""Seconds between checkpoints, which is what a kill can cost."""

BESIDE_RESUME = ("resume", "quiet", "as_json")
"""The options that a run can be resumed with; all others are in its config.toml."""

CURVE, PICTURE = "curve.png", "team.png"

PICTURE_CELL_PX = 32
"""Side of a cell in the picture of the best trial's last greedy episode."""

BUILDERS = 2


def cooperate(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    scenario: Annotated[
        str | None, typer.Option(metavar=NAME_OR_FILE, help=f"the design to build: {FILES} [line]")
    ] = None,
    layer: LayerOption = None,
    builders: Annotated[int | None, typer.Option(help=f"builders in one arena, 1 to 4 [{BUILDERS}]")] = None,
    start: Annotated[
        list[str] | None,
        typer.Option(metavar="X,Y", help="a builder's start cell, once for each [spread along the scenario's start]"),
    ] = None,
    networks: Annotated[
        str | None,
        typer.Option(
            help="shared: one nested agent plays every builder; own: each has one of its own; single: independent "
            "single agents [shared]"
        ),
    ] = None,
    preset: Annotated[str | None, typer.Option(metavar="NAME|FILE", help="hyper-parameters [paper]")] = None,
    episodes: Annotated[int | None, typer.Option(min=1, max=MOST, help="episodes a trial [the preset's]")] = None,
    trials: Annotated[
        int | None, typer.Option(min=1, max=MOST_TRIALS, help="independent trials, trained as one batch [1]")
    ] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="the same seed gives the same training [0]")] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="a new or empty folder for the run [runs/DESIGN-BUILDERS-DATE]")
    ] = None,
    resume: Annotated[Path | None, typer.Option(metavar="DIR", help="go on from a run's last checkpoint")] = None,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Train several builders in one simulated arena; Ctrl+C saves, and --resume goes on from there."""
    output = Output(quiet, as_json)
    if resume is not None:
        _check_alone(context)
        run = TeamRun.open(resume)
        with folder_lock(resume):
            _run(run, output, resumed=not run.only_begun)
        return
    chosen = load_preset("paper" if preset is None else preset)
    check_team_preset(chosen)
    team = _team(named_scenario("line" if scenario is None else scenario, layer), builders, start)
    config = TeamConfig(
        builders=team.builders,
        networks=_kind("shared" if networks is None else networks),
        starts=[list(cell) for cell in team.starts],
        trials=trials or 1,
        seed=seed or 0,
        preset_name="paper" if preset is None else preset,
        preset=chosen.model_copy(update={"episodes": episodes or chosen.episodes}),
        scenario=table_of(team.scenario),
    )
    with output_folder(out, f"{team.scenario.name}-{team.builders}-builders") as path:
        _run(TeamRun.new(path, config), output, resumed=False)


def _check_alone(context: typer.Context) -> None:
    """UserError, one line, if an option is given that a run can't be resumed with."""
    given = [name for name, value in context.params.items() if value not in (None, ()) and value is not False]
    beside = [name for name in given if name not in BESIDE_RESUME]
    if beside:
        raise UserError(f"--resume goes on with the run's own config.toml: leave out --{beside[0]}")


def _team(scenario: Scenario, builders: int | None, starts: list[str] | None) -> Team:
    """The builders that were asked for; UserError or ScenarioError, one line, if there can't be such."""
    if not starts:
        return team_of(scenario, BUILDERS if builders is None else builders)
    if builders not in (None, len(starts)):
        raise UserError(f"--builders {builders} and {len(starts)} times --start: give each builder one start, or none")
    return Team(scenario, tuple(_cell(text) for text in starts))


def _cell(text: str) -> tuple[int, int]:
    x, _, y = text.partition(",")
    try:
        return int(x), int(y)
    except ValueError:
        raise UserError(f"--start {text!r} is no cell: name it as X,Y, like 7,14") from None


def _kind(name: str) -> Kind:
    for kind in KINDS:
        if kind == name:
            return kind
    raise UserError(f"no networks {name!r}: choose one of {', '.join(KINDS)}")


@dataclass(frozen=True)
class _Arenas:
    """A simulated arena for each trial, as its agents see it, and the arena of the first within."""

    seen: list[TeamArena]
    within: TeamEnv

    @classmethod
    def of(cls, run: TeamRun, trials: int) -> "_Arenas":
        within = [TeamEnv(TeamGrid(run.team), run.team) for _ in range(trials)]
        return cls([arena_of(env, run.config.networks) for env in within], within[0])


def _run(run: TeamRun, output: Output, *, resumed: bool) -> None:
    """Train until the run is finished or somebody stops it; saved on the way and at the end."""
    began = time.monotonic() - (run.wall_s_so_far() if resumed else 0.0)
    trainer = run.new_trainer(_Arenas.of(run, run.config.trials).seen)
    with catch_interrupts() as interrupt:
        if resumed:
            run.checkpoint.load_into(trainer)
        else:
            run.begin()
        output.note(f"run:        {run.path}")
        _tick_until_done(run, trainer, interrupt, output, lambda: run.save(trainer, time.monotonic() - began))
        summary = run.save(trainer, time.monotonic() - began)
        _draw_curve(run, trainer)
        if not trainer.finished:
            raise Stopped(f"stopped and saved: go on with mc-nested cooperate --resume {run.path}")
    _draw_best(run, trainer)
    _say_end(run, output, summary)


def _tick_until_done(
    run: TeamRun, trainer: TeamTrainer, interrupt: Interrupt, output: Output, save: Callable[[], object]
) -> None:
    save_at = time.monotonic() + SAVE_EVERY_S
    with TeamProgress(run.team.scenario.optimum, trainer, output.progress) as progress:
        interrupt.says = STOPPING
        while not (trainer.finished or interrupt.requested):
            trainer.tick()
            progress.show()
            if time.monotonic() >= save_at:
                save()
                save_at = time.monotonic() + SAVE_EVERY_S


def _draw_curve(run: TeamRun, trainer: TeamTrainer) -> None:
    rows = [(row.trial, row.episode, row.score) for row in trainer.evaluation_rows]
    episodes, scores = align_trials(rows, run.config.trials)
    with run.writing(), atomic_write(run.path / CURVE) as path:
        draw_curve(path, _title(run), episodes, scores, run.team.scenario.optimum)


def _draw_best(run: TeamRun, trainer: TeamTrainer) -> None:
    """Draw what the best trial's policy leaves behind: every builder where it ends, and the blocks."""
    arenas = _Arenas.of(run, 1)
    play_team_greedily(arenas.seen[0], run.agent_of(int(np.argmax(trainer.kept_scores))))
    picture = draw_team_picture(run.team, arenas.within.cells, arenas.within.placed, PICTURE_CELL_PX)
    with run.writing(), atomic_write(run.path / PICTURE) as path:
        path.write_bytes(cv2.imencode(".png", picture[:, :, ::-1])[1].tobytes())


def _title(run: TeamRun) -> str:
    config = run.config
    count = f"{config.builders} builders" if config.builders > 1 else "one builder"
    return f"{run.team.scenario.name}, {count}, networks {config.networks}, preset {Path(config.preset_name).stem}"


def _say_end(run: TeamRun, output: Output, summary: dict[str, Any]) -> None:
    scores = ", ".join(f"{score:g}" for score in summary["final_scores"])
    output.result(
        {"folder": run.path, **summary},
        f"final scores (optimum {summary['optimum']:g}): {scores}",
        f"run:        {run.path}",
        f"curve:      {run.path / CURVE}",
        f"picture:    {run.path / PICTURE}",
    )
