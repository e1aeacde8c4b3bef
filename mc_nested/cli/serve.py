"""``mc-nested train serve`` and ``train keys``: what other computers need to play, or to train, for a learner."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.cluster_options import InsecureOption, KeysOption
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileOption, ServerOption, opening_of
from mc_nested.cli.output import Output, QuietOption
from mc_nested.errors import UserError
from mc_nested.live.profile.store import load_profile
from mc_nested.live.screen_arenas import windows_of
from mc_nested.live.session import OFF
from mc_nested.workers.cluster.address import scheduler_address
from mc_nested.workers.cluster.connection import check_installed
from mc_nested.workers.cluster.keys import AUTHORITY_KEY, make_keys
from mc_nested.workers.games.game_server import GameServer, OpenGame
from mc_nested.workers.games.game_worker import GameWorker
from mc_nested.workers.games.mailbox import GameSetup, process_mailbox
from sim.worlds import Backend, as_shown, open_arenas


def serve(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    scheduler: Annotated[str, typer.Option(metavar="ADDRESS", help="of the Dask scheduler that the learner uses, too")],
    profile: ProfileOption = DEFAULT_PROFILE,
    backend: Annotated[Backend, typer.Option(help="live, or virtual for a game on the virtual client")] = Backend.LIVE,
    name: Annotated[
        str | None, typer.Option(help="this game's, which no other may have", show_default="the computer's")
    ] = None,
    keys: KeysOption = None,
    insecure: InsecureOption = False,
    server_allowed: ServerOption = False,
    evidence: Annotated[
        Path, typer.Option(metavar="DIR", help="for the last pictures of a game that was given up")
    ] = Path("evidence"),
    quiet: QuietOption = False,
) -> None:
    """Serve this computer's game to a learner (mc-nested train --games); Ctrl+C or the panic key ends it.

    It joins again by itself when the network was gone. Switch to another window to pause it.
    """
    address = scheduler_address(scheduler, keys, insecure=insecure)
    if backend is Backend.SIM:
        raise UserError("the simulator needs no game: train there with --backend sim, or serve --backend virtual")
    if backend is Backend.LIVE:
        load_profile(profile)
    opening = replace(opening_of(profile, "serve", OFF, server_allowed=server_allowed), evidence=evidence)
    say = Output(quiet).note

    @contextmanager
    def opens(setup: GameSetup) -> Iterator[OpenGame]:
        if setup.backend != backend.value:
            raise UserError(f"the learner asks for --backend {setup.backend}, and this game is {backend.value}")
        with open_arenas(backend, [setup.scenario], opening, setup.seed) as (arenas, log):
            if log is None or not isinstance(arenas, ArenaVectorEnv):
                raise AssertionError("the simulator is not served")
            (window,) = windows_of(arenas)
            view = setup.new_agent().view_of(as_shown(arenas, setup.preset.states), [setup.scenario])
            yield OpenGame(view, log, window.devices.display.is_in_front, window.controller.check_stopped)

    with catch_interrupts() as interrupt:
        with GameWorker(address, name or socket.gethostname(), say):
            try:
                GameServer(process_mailbox, opens, say, lambda: interrupt.requested).serve()
            finally:
                process_mailbox.close()
        raise Stopped("stopped: no key is held, and the learner goes on without this game")


def keys(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="where to make them; an authority there is kept")],
    machines: Annotated[list[str], typer.Argument(metavar="MACHINE...", help="a name of your choice for each machine")],
) -> None:
    """Make keys with which your machines know each other: copy to each machine its own folder, and nothing else."""
    check_installed()
    for made in make_keys(folder, machines):
        typer.echo(f"{made}: copy this folder to {made.name}, and name it there with --keys")
    typer.echo(f"{folder / AUTHORITY_KEY}: keep it here: who has it can let any machine in")
