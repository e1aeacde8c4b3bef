"""``mc-nested serve-game``: let a learner on another computer play this one's game, an episode at a time."""

import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.cluster_options import InsecureOption, KeysOption
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.options import DEFAULT_PROFILE, Backend, ProfileOption, ServerOption
from mc_nested.cli.output import Output, QuietOption
from mc_nested.cli.screen_states import as_shown
from mc_nested.errors import UserError
from mc_nested.live.profile.store import load_profile
from mc_nested.live.session import open_live_game
from mc_nested.workers.cluster.address import scheduler_address
from mc_nested.workers.games.game_server import GameServer, OpenGame
from mc_nested.workers.games.game_task import desk
from mc_nested.workers.games.game_worker import GameWorker
from mc_nested.workers.games.order import GameOrder

if TYPE_CHECKING:
    from mc_nested.arena.game import PlayLog
    from mc_nested.live.devices import Display


def serve_game(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    scheduler: Annotated[str, typer.Option(metavar="ADDRESS", help="of the Dask scheduler that the learner uses, too")],
    profile: ProfileOption = None,
    backend: Annotated[Backend, typer.Option(help="live, or virtual for a game on the virtual client")] = Backend.LIVE,
    name: Annotated[str | None, typer.Option(help="this game's, which no other may have [the computer's]")] = None,
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
    played = DEFAULT_PROFILE if profile is None else profile
    if backend is Backend.LIVE:
        load_profile(played)
    say = Output(quiet).note

    @contextmanager
    def opens(order: GameOrder) -> Iterator[OpenGame]:
        if order.backend != backend.value:
            raise UserError(f"the learner asks for --backend {order.backend}, and this game is {backend.value}")
        with ExitStack() as stack:
            if backend is Backend.VIRTUAL:
                # Imported here: a live game doesn't need it.
                from mc_nested.cli.virtual_games import VirtualPlay, open_virtual_games

                (game,) = stack.enter_context(open_virtual_games([order.scenario], order.seed))
                log: PlayLog = VirtualPlay([game])
                display: Display = game.connection.devices.display
            else:
                say_to_player = partial(typer.echo, err=True)
                opened = open_live_game(
                    order.scenario, played, say_to_player, evidence=evidence, is_server_allowed=server_allowed
                )
                game, display = stack.enter_context(opened)
                log = game.log
            arena = as_shown(ArenaVectorEnv([ArenaEnv(game, order.scenario)]), order.preset.states)
            view = order.new_agent().view_of(arena, [order.scenario])
            yield OpenGame(view, log, display.is_in_front, game.connection.controller.check_stopped)

    with catch_interrupts() as interrupt:
        with GameWorker(address, name or socket.gethostname(), say):
            try:
                GameServer(desk, opens, say, lambda: interrupt.requested).serve()
            finally:
                desk.close()
        raise Stopped("stopped: no key is held, and the learner goes on without this game")
