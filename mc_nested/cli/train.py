"""``mc-nested train``: begin a training, or resume one."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.atomic_file import atomic_write
from mc_nested.cli.earlier_run import earlier_run
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.options import DEFAULT_PROFILE, Backend, ProfileOption, ServerOption, open_arenas, played_live
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.errors import DesktopError, LiveError, UserError
from mc_nested.learn.agents import AGENT_SPECS, view_of
from mc_nested.learn.preset import MOST, load_preset
from mc_nested.learn.runs.run_folder import RunConfig, RunFolder
from mc_nested.learn.trainer import Trainer
from mc_nested.live.failure_budget import FailureBudget
from mc_nested.report.arena_map import draw_map
from mc_nested.report.curve import align_trials, draw_curve
from mc_nested.report.game_time import expected
from mc_nested.report.played import played_by
from mc_nested.report.played_curve import draw_played_curve
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed

SAVE_EVERY_S = {Backend.SIM: 60.0, Backend.LIVE: 15.0}
"""Seconds between checkpoints, which is what a kill can cost: in the simulator, or in a game of a block per second."""

MOST_TRIALS = 1000
"""More at once would only run out of memory."""

MAP = "map.png"
"""What was learnt of the arena, in a run's folder."""

DEFAULTS: dict[str, Any] = {
    "scenario": "line",
    "agent": "nested",
    "backend": Backend.SIM,
    "preset": "paper",
    "trials": 1,
    "seed": 0,
}


def train(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    scenario: Annotated[str | None, typer.Option(metavar="NAME|FILE", help="the design to build [line]")] = None,
    agent: Annotated[str | None, typer.Option(help=f"the agent: {', '.join(AGENT_SPECS)} [nested]")] = None,
    backend: Annotated[Backend | None, typer.Option(help="where [sim]")] = None,
    preset: Annotated[str | None, typer.Option(metavar="NAME|FILE", help="hyper-parameters [paper]")] = None,
    episodes: Annotated[int | None, typer.Option(min=1, max=MOST, help="episodes a trial [the preset's]")] = None,
    trials: Annotated[
        int | None, typer.Option(min=1, max=MOST_TRIALS, help="independent trials, trained as one batch [1]")
    ] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="the same seed gives the same training [0]")] = None,
    stop_at_optimum: Annotated[
        bool, typer.Option("--stop-at-optimum", help="end a trial at its first greedy evaluation at the optimum")
    ] = False,
    profile: ProfileOption = None,
    server_allowed: ServerOption = False,
    begin_from: Annotated[
        Path | None,
        typer.Option(
            "--from", metavar="RUN", help="begin with the best policy of an earlier training, and its learnt game"
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="a new or empty folder for the run")] = None,
    resume: Annotated[Path | None, typer.Option(metavar="DIR", help="go on from a run's last checkpoint")] = None,
) -> None:
    """Train an agent; Ctrl+C saves, and --resume goes on from there."""
    if resume is not None:
        given = [name for name, value in context.params.items() if value is not None and value is not False]
        beside = [name for name in given if name not in ("resume", "profile", "server_allowed")]
        if beside:
            option = "--from" if beside[0] == "begin_from" else "--" + beside[0].replace("_", "-")
            raise UserError(f"--resume goes on with the run's own config.toml: leave out {option}")
        folder = RunFolder.open(resume)
        run_training(folder, profile or folder.config.profile, not folder.only_begun, server_allowed=server_allowed)
        return
    if out is None:
        raise UserError("name a new folder for the run with --out DIR, or a run to go on with, --resume DIR")
    if agent not in (None, *AGENT_SPECS):
        raise UserError(f"no agent {agent!r}: choose one of {', '.join(AGENT_SPECS)}")
    chosen = load_preset(DEFAULTS["preset"] if preset is None else preset)
    where = backend or DEFAULTS["backend"]
    config = RunConfig(
        agent=agent or DEFAULTS["agent"],
        backend=where.value,
        profile=(DEFAULT_PROFILE if profile is None else profile) if where is Backend.LIVE else None,
        trials=trials or DEFAULTS["trials"],
        seed=seed or DEFAULTS["seed"],
        stop_at_optimum=stop_at_optimum,
        preset_name=DEFAULTS["preset"] if preset is None else preset,
        preset=chosen.model_copy(update={"episodes": episodes or chosen.episodes}),
        scenario=table_of(load_scenario(DEFAULTS["scenario"] if scenario is None else scenario)),
    )
    folder = RunFolder.new(out, config)
    run_training(folder, config.profile, resumed=False, begin_from=begin_from, server_allowed=server_allowed)


def run_training(
    folder: RunFolder,
    profile: str | None,
    resumed: bool,
    begin_from: Path | None = None,
    *,
    server_allowed: bool = False,
) -> None:
    """Train until the run is finished or somebody stops it; saved on the way and at the end."""
    config = folder.config
    earlier = earlier_run(begin_from, folder) if begin_from else None
    began = time.monotonic() - (folder.wall_s_so_far() if resumed else 0.0)
    with catch_interrupts() as interrupt:
        with open_arenas(
            Backend(config.backend),
            profile,
            folder.scenarios,
            server_allowed=server_allowed,
            evidence=folder.path / "evidence",
        ) as (env, log):
            agent = folder.new_agent(config.trials)
            view = view_of(agent.spec, env, folder.scenarios)
            trainer = Trainer(view, folder.scenarios, agent, config.preset, config.seed, config.stop_at_optimum)
            if resumed:
                folder.checkpoint.load_into(trainer)
            else:
                if earlier:
                    earlier.begin(trainer)
                    folder.save_before_all(trainer)
                folder.begin()
                if Backend(config.backend) is Backend.LIVE:
                    expectation = expected(config.preset, folder.scenario, stop_at_optimum=config.stop_at_optimum)
                    typer.echo(expectation.line(folder.scenario))
            failure_budget = FailureBudget()

            def save() -> dict[str, Any]:
                return folder.save(trainer, time.monotonic() - began, played_live(log, failure_budget))

            try:
                _tick_until_done(folder, trainer, interrupt, failure_budget, save)
            except (LiveError, DesktopError) as error:
                trainer.abandon_episodes()
                save()
                raise LiveError(f"{error}; saved: go on with mc-nested train --resume {folder.path}") from error
            summary = save()
        _draw(folder, trainer)
    if not trainer.finished:
        raise Stopped(f"stopped and saved: go on with mc-nested train --resume {folder.path}")
    scores = ", ".join(f"{score:g}" for score in summary["final_scores"])
    if folder.config.stop_at_optimum:
        reached = ", ".join("never" if done is None else f"{done}" for done in summary["episodes_to_optimum"])
        played = ", ".join("never" if each is None else f"{each['episodes']}" for each in summary["played_to_optimum"])
        typer.echo(f"episodes to the optimum: {reached}; with the greedy ones: {played}")
    typer.echo(f"final scores (optimum {summary['optimum']:g}): {scores}")
    typer.echo(f"run:        {folder.path}")
    typer.echo(f"curve:      {folder.path / 'curve.png'}")
    if trainer.imagination:
        typer.echo(f"map:        {folder.path / MAP}")
    typer.echo(f"checkpoint: {folder.path / 'checkpoint'}")


def _tick_until_done(
    folder: RunFolder,
    trainer: Trainer,
    interrupt: Interrupt,
    failure_budget: FailureBudget,
    save: Callable[[], dict[str, Any]],
) -> None:
    every = SAVE_EVERY_S[Backend(folder.config.backend)]
    save_at = time.monotonic() + every
    events = _events(folder, trainer)
    with TrainingProgress(folder.scenario, trainer, stops=lambda: interrupt.requested) as progress:
        if not progress.in_terminal:
            interrupt.says = STOPPING
        while not (trainer.finished or interrupt.requested):
            try:
                trainer.tick()
            except LiveError as error:
                failure_budget.record_failure(error, trainer.env_steps)
                trainer.abandon_episodes()
                continue
            progress.show()
            if events:
                with folder.writing():
                    events.write()
            if time.monotonic() >= save_at:
                save()
                save_at = time.monotonic() + every


def _events(folder: RunFolder, trainer: Trainer) -> TensorBoard | None:
    if not is_installed():
        return None
    with folder.writing():
        return TensorBoard([folder.path / FOLDER / f"trial-{trial}" for trial in range(folder.config.trials)], trainer)


def _draw(folder: RunFolder, trainer: Trainer) -> None:
    """Draw the curve, and what was learnt of the arena, if anything was."""
    config, scenario = folder.config, folder.scenario
    title = f"{scenario.name}, {config.agent} agent, preset {Path(config.preset_name).stem}"
    with folder.writing(), atomic_write(folder.path / "curve.png") as path:
        if trainer.imagination:
            played = played_by(trainer.episode_rows, trainer.evaluation_rows, config.trials)
            draw_played_curve(path, title, played, scenario.optimum)
        else:
            rows = [(row.trial, row.episode, row.score) for row in trainer.evaluation_rows]
            episodes, scores = align_trials(rows, config.trials)
            draw_curve(path, title, episodes, scores, scenario.optimum)
    if trainer.imagination:
        which = f", the first of {config.trials} trials" if config.trials > 1 else ""
        with folder.writing(), atomic_write(folder.path / MAP) as path:
            draw_map(path, title + which, trainer.imagination.seen(0))
