"""``mc-nested build``: a known design, built by the scripted builder, in the simulator or in a running game."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Annotated

import typer

from calibration.arena.undo import undo_command
from mc_nested.arena.action import Action
from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.design import is_buildable
from mc_nested.arena.env import ArenaEnv, step_in
from mc_nested.arena.game import Game
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
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.view import Viewed, ViewOption, viewed
from mc_nested.cli.watching import VideoOption, filmed, started_over, times_of, watched
from mc_nested.errors import ScenarioError, UserError
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.report.film import check_film
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


@prints(Built)
def build(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    design: Annotated[str, typer.Argument(metavar="NAME|FILE", help=f"the design: {FILES}")],
    layer: LayerOption = None,
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

    One layer is built. Of a schematic with several, name it with --layer; mc-nested scenarios FILE lists them.
    """
    if video:
        check_film(video)
    scenario = named_scenario(design, layer, must_choose=True)
    chosen = build_with_materials(scenario, None if material is None else scenario.material_index(material))
    steps = len(chosen)
    if not is_buildable(scenario):
        raise ScenarioError(
            f"scenario {scenario.name}: the scripted builder takes {steps} steps, and its step_limit is "
            f"{scenario.step_limit}: raise it"
        )
    afterwards = _how_to_put_back(profile, yes=yes) if backend is Backend.LIVE else None
    output = Output(quiet, as_json)
    if afterwards and not quiet:
        typer.echo(f"  building clears the arena first; {afterwards}", err=True)
    opening = opening_of(profile, f"build-{scenario.name}", record, server_allowed=server_allowed)
    with viewed(view, "build", f"{scenario.name}, {where_words(backend)}") as viewing:
        opened = open_game(backend, scenario, replace(opening, journal=viewing.publisher.board))
        with opened as (played, display), filmed(played, display, scenario, video) as game:
            built = started_over(partial(_built, game, scenario, chosen, viewing, quiet=quiet or as_json))
            times = times_of(game)
    name = ", then ".join(scenario.materials[index].name for index, _ in groupby(index for _, index in chosen))
    output.result(
        Built(scenario.name, scenario.blocks, built, name, steps, video),
        f"  built {built} of {scenario.blocks} blocks, of {name}, in {steps} steps",
        *times,
        *([f"  film: {video}"] if video else []),
    )
    if afterwards:
        output.hint(f"  it stands until the arena is cleared for the next episode; {afterwards}")


def _built(game: Game, scenario: Scenario, steps: Sequence[tuple[Action, int]], viewing: Viewed, *, quiet: bool) -> int:
    """Build the design from a reset on, and return how many of its blocks stand then."""
    env = ArenaEnv(game, scenario)
    with watched(env, scenario.name, viewing, quiet=quiet) as show:
        env.reset(options={"material": scenario.materials[steps[0][1]].name})
        show()
        taken = [step_in(scenario, *step) for step in steps]
        for step, following in zip(taken, [*taken[1:], None], strict=True):
            env.announce(following)
            env.step(step)
            show()
    return len(env.placed & scenario.design)


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
