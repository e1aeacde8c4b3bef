"""``mc-nested build``: a known design, built in the simulator or in a running game.

The scripted builder builds it, or the agent with objectives, whose weights come with the package.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.arena.undo import undo_command
from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build_with_materials, within_reach
from mc_nested.arena.design import is_buildable
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.cli.options import (
    DEFAULT_PROFILE,
    FILES,
    BackendOption,
    LayerOption,
    ProfileOption,
    RecordOption,
    ServerOption,
    named_scenario,
    opening_of,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints, say_aside
from mc_nested.cli.view import Viewed, ViewOption, viewed
from mc_nested.cli.watching import VideoOption, filmed, times_of, watched
from mc_nested.errors import ScenarioError, UserError
from mc_nested.learn.evaluation import BuildStep, GreedyEpisode, steps_of, take_steps
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from mc_nested.live.live_game import started_over
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.report.film import EpisodeFilm, check_film
from sim.worlds import Backend, open_game, where_words


@dataclass(frozen=True)
class Built:
    """What ``build`` prints."""

    scenario: Annotated[str, "the design's name"]
    blocks: Annotated[int, "of the design"]
    built: Annotated[int, "of them, as seen"]
    material: Annotated[str, "what it is built of"]
    steps: Annotated[int, "that it took"]
    film: Annotated[Path | None, "its file"]
    score: Annotated[float, "r_M of what stands"]
    optimum: Annotated[float, "the highest score possible"]
    unreachable: Annotated[tuple[Cell, ...], "cells of the design where no block can land, x and y each"]


Steps = Callable[[ArenaEnv], Iterator[BuildStep]]
"""Chooses the steps of an episode that has begun."""


@prints(Built)
def build(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    design: Annotated[str, typer.Argument(metavar="NAME|FILE", help=f"the design: {FILES}")],
    layer: LayerOption = None,
    agent: Annotated[
        bool,
        typer.Option(
            "--agent",
            help="let the agent that comes with the package build it, which has never seen it",
        ),
    ] = False,
    material: Annotated[
        str | None, typer.Option(help="what it is built of", show_default="the one worth most, in each part")
    ] = None,
    backend: BackendOption = Backend.SIM,
    profile: ProfileOption = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="build even where what stands in the game's arena can't be put back")
    ] = False,
    record: RecordOption = None,
    video: VideoOption = None,
    view: ViewOption = False,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Build a design without learning, and show the arena as it is built; after a mishap it starts over.

    With --agent, cells that can't be reached are named first, and left out. The exit code is 2 if another is missing.

    One layer is built. Of a schematic with several, name it with --layer; mc-nested scenarios FILE lists them.
    """
    if video:
        check_film(video)
    drawn = named_scenario(design, layer, must_choose=True, must_reach=not agent)
    scenario = within_reach(drawn)
    in_hand = None if material is None else scenario.material_index(material)
    steps = _by_the_agent(scenario, in_hand) if agent else _by_the_builder(scenario, in_hand)
    afterwards = _how_to_put_back(profile, yes=yes) if backend is Backend.LIVE else None
    output = Output(quiet, as_json)
    if afterwards and not quiet:
        typer.echo(f"  building clears the arena first; {afterwards}", err=True)
    unreachable = tuple(sorted(drawn.design - scenario.design))
    if unreachable and not quiet:
        cells = ", ".join(map(str, unreachable))
        typer.echo(
            f"  no block can land on {cells}: out of the agent's reach; it builds the other {scenario.blocks}", err=True
        )
    opening = opening_of(profile, f"build-{scenario.name}", record, server_allowed=server_allowed, backend=backend)
    with viewed(view, "build", f"{scenario.name}, {where_words(backend)}") as viewing:
        opened = open_game(backend, scenario, replace(opening, journal=viewing.publisher.board))
        with opened as (game, display), filmed(game, display, video) as film:
            env = ArenaEnv(game, scenario)
            watch = partial(_built, env, in_hand, steps, viewing, film, quiet=quiet or as_json)
            episode = started_over(watch, say_aside)
            times = times_of(game)
    built, count, name = len(env.placed & scenario.design), len(episode.actions), episode.material_name(scenario)
    found = Built(
        scenario=scenario.name,
        blocks=drawn.blocks,
        built=built,
        material=name,
        steps=count,
        film=video,
        score=episode.score,
        optimum=scenario.optimum,
        unreachable=unreachable,
    )
    output.result(
        found,
        f"  built {built} of {drawn.blocks} blocks, of {name}, in {count} steps",
        *times,
        *([f"  film: {video}"] if video else []),
    )
    if afterwards:
        output.hint(f"  it stands until the arena is cleared for the next episode; {afterwards}")
    _check_whole(built, scenario.blocks - len(env.placed), count, drawn)


def _built(
    env: ArenaEnv, material: int | None, steps: Steps, viewing: Viewed, film: EpisodeFilm | None, *, quiet: bool
) -> GreedyEpisode:
    """Build the design from a reset on."""
    with watched(env, env.scenario.name, viewing, film, quiet=quiet) as show:
        return take_steps(env, steps(env), material, show)


def _by_the_builder(scenario: Scenario, material: int | None) -> Steps:
    """Return the scripted builder's steps; ScenarioError if the step limit is too low for them."""
    chosen = build_with_materials(scenario, material)
    if not is_buildable(scenario):
        raise ScenarioError(
            f"scenario {scenario.name}: the scripted builder takes {len(chosen)} steps, and its step_limit is "
            f"{scenario.step_limit}: raise it"
        )
    steps = [BuildStep(taken, following) for taken, following in zip(chosen, [*chosen[1:], None], strict=True)]
    return lambda _: iter(steps)


def _by_the_agent(scenario: Scenario, material: int | None) -> Steps:
    """Return the steps that the shipped agent chooses; RunError, one line, if its weights can't be used."""
    agent = agent_of(shipped_weights(), scenario)
    return lambda env: steps_of(agent, env, material)


def _check_whole(built: int, left: int, steps: int, drawn: Scenario) -> None:
    """Raise UserError, one line, if a block in reach is missing; ``left`` weren't laid."""
    scenario = within_reach(drawn)
    if built == scenario.blocks:
        return
    remedies = ["build without --agent"] if scenario == drawn and is_buildable(drawn) else []
    if left and steps == scenario.step_limit:
        why = f"its step_limit of {scenario.step_limit} was reached"
        remedies.insert(0, "raise it")
    elif left:
        why = "it gave up the others"
    else:
        why = "it laid the others off the design"
    mend = f": {', or '.join(remedies)}" if remedies else ""
    raise UserError(f"the agent built {built} of {scenario.blocks} blocks in reach, {why}{mend}")


def _how_to_put_back(profile_name: str, *, yes: bool) -> str:
    """Return how what stood in the arena before comes back.

    Raise ProfileError if the profile can't be read, or has no arena; raise UserError if it can't come back, and nobody
    agreed to that.
    """
    profile = load_profile(profile_name)
    if profile.world is not None:
        return f"the world comes back from {profile.world.template} with the next episode"
    if profile.marked_arena().copied_to is None:
        if not yes:
            raise UserError(
                "building clears the arena, and the profile knows no copy of what stood there before: make one with "
                f"mc-nested calibrate arena --profile {profile_name}, or build anyway with --yes"
            )
        return "the profile knows no copy of what stood there before the arena was made: that can't be put back"
    return f"what stood there before the arena was made comes back with {undo_command(profile_path(profile_name))}"
