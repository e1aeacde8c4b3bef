"""``mc-nested train --games``: games on other computers play a training's episodes.

Plans go out to them, and whole episodes come back.
"""

import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import landing
from mc_nested.arena.scenario import Scenario
from mc_nested.cli.interrupt import Interrupt, Stopped
from mc_nested.errors import ClusterError, UserError
from mc_nested.learn.games.episode import PlayedEpisode
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.workers.cluster.address import SchedulerAddress, scheduler_address
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.dask_jobs import counted
from mc_nested.workers.games.dask_games import Answered, DaskGames, GameEvent, Joined, NameTaken, Unreachable
from mc_nested.workers.games.mailbox import GameAnswer, GameSetup
from sim.worlds import Backend

if TYPE_CHECKING:  # the cluster extra's
    from distributed import Client

LOOK_EVERY_S = 0.2
"""Seconds that a Ctrl+C may go unnoticed while no game answers."""


OF_THIS_GAME = ("--profile", "--server-allowed", "--record")
"""Options of this computer's own game, which doesn't play."""


def games_of(games: str | None, keys: Path | None, insecure: bool, options: Collection[str]) -> SchedulerAddress | None:
    """Return the scheduler whose games play, None for this computer's; ``options`` are those that were given.

    Raise ClusterError or UserError if that can't be.
    """
    if games is None:
        if keys is not None or insecure:
            raise ClusterError("--keys and --insecure say how games are spoken to: name their scheduler with --games")
        return None
    for option in OF_THIS_GAME:
        if option in options:
            raise UserError(f"--games play with profiles of their own: leave out {option}")
    return scheduler_address(games, keys, insecure=insecure)


@dataclass
class GameRecord:
    """What is known of one game: the number of the plan that it plays, and what it last reported that playing took."""

    playing: int | None = None
    is_here: bool = True
    log: dict[str, Any] = field(default_factory=dict)


class GamesAtPlay:
    """The games of one training, and its trainer: gives each free game its next episode, and takes what comes back.

    Args:
        training: the learner.
        games: the games.
        scenario: what is built.
    """

    def __init__(self, training: GamesTrainer, games: DaskGames, scenario: Scenario) -> None:
        self.training = training
        choices = 0 if training.agent.main else len(scenario.materials)
        self.arenas = LastEpisode(scenario, choices)
        self._games = games
        self._records: dict[str, GameRecord] = {}
        self._refused: dict[str, str] = {}
        self._has_played = False
        self._is_over = False
        self._lost = 0
        self._problems: list[str] = []

    def play_on(self) -> list[str]:
        """Deal with what has happened, or wait for a moment; return lines about who came and what was lost.

        Raise ClusterError if the only games that ever came have refused.
        """
        lines = [line for event in self._games.events(LOOK_EVERY_S) if (line := self._handle(event))]
        if self._refused and not self._has_played and not any(record.is_here for record in self._records.values()):
            raise ClusterError("; ".join(f"{game} can't play: {why}" for game, why in self._refused.items()))
        return [*lines, *self.training.practice.news()]

    def end(self) -> None:
        """Take the episodes that have come back by now, and ask the games for nothing more."""
        self._is_over = True
        for event in self._games.events(0):
            if isinstance(event, Answered):
                self._handle(event)

    def in_words(self) -> str:
        """Return how many games there are, and what is lost."""
        records = self._records.values()
        here, playing = sum(each.is_here for each in records), sum(each.playing is not None for each in records)
        words = f"{counted(here, 'game')}, {playing} playing" if here else "waiting for a game (mc-nested train serve)"
        return words + (f", {counted(self._lost, 'episode')} lost" if self._lost else "")

    def summary(self) -> dict[str, Any]:
        """Return, for a training's summary, what playing took in each game, and what was lost."""
        logs = {game: record.log for game, record in self._records.items()}
        seconds = [each for log in logs.values() for each in log.get("game_s", ())]
        lost = {"spoiled_episodes": self._lost, "last_problems": self._problems[-3:]}
        return {"live": {"game_s": seconds, "games": logs, **lost}}

    def _handle(self, event: GameEvent) -> str:
        game = event.game
        if isinstance(event, Joined):
            self._refused.pop(game, None)
            self._records[game] = GameRecord(log=self._records[game].log if game in self._records else {})
            self._games.ask(game, None)
            return f"{game} has joined"
        if isinstance(event, Answered):
            if isinstance(event.answer, Exception):
                return self._refuse(game, str(event.answer))
            return self._take(game, event.answer)
        if isinstance(event, NameTaken):
            return f"a second game named {game} was refused: give it another --name"
        if isinstance(event, Unreachable):
            return f"{game} has answered, but can't be reached at {event.address}: let that port through its firewall"
        record = self._records[game]
        record.is_here = False
        lost = self._lose(record, f"{game} is gone")
        return "" if game in self._refused else f"{game} is gone{lost}"

    def _take(self, game: str, answer: GameAnswer) -> str:
        """Take a game's answer, ask it for the next episode, and return the lines to say about it."""
        record = self._records[game]
        record.log = dict(answer.log) or record.log
        if answer.is_refusal:
            return self._refuse(game, answer.problem)
        said = f"{game}: {answer.problem}{self._lose(record, answer.problem)}" if answer.problem else ""
        self._has_played = self._has_played or not answer.problem
        if answer.episode and self.training.take(answer.episode):
            self.arenas.episode = answer.episode if answer.episode.observations.ndim == 2 else None
        record.playing = None
        if not (self._is_over or self.training.finished or answer.leaves):
            # After a mishap it says first when it is ready again: its player may be away.
            plan = None if answer.problem else self.training.plan(game)
            record.playing = plan.number if plan else None
            self._games.ask(game, plan)
        return said

    def _refuse(self, game: str, why: str) -> str:
        self._refused[game] = why
        record = self._records[game]
        record.is_here = False
        self._lose(record, why)
        return f"{game} can't play: {why}"

    def _lose(self, record: GameRecord, why: str) -> str:
        """Leave out the episode that the game was playing, if any, and return a line that says so."""
        if record.playing is None:
            return ""
        self.training.abandon(record.playing)
        record.playing = None
        self._lost += 1
        self._problems.append(why)
        return ", its episode is lost"


OF_GAMES = "mc-nested-games"
"""The name of the lock that a learner holds: games play for one at a time."""

FREED_S = 45.0
"""Seconds until a scheduler has noticed that a learner was killed, and a little more."""

ASK_AGAIN_S = 1.0
"""Seconds between two looks whether they are free."""


@contextmanager
def games_at_play(
    folder: RunFolder, cluster: SchedulerAddress, interrupt: Interrupt, say: Callable[[str], None]
) -> Iterator[GamesAtPlay]:
    """Yield the games of that scheduler, for an untrained learner of that folder's training.

    Raise UserError if games can't play it; raise ClusterError if the scheduler can't be reached, or another training
    has its games; raise Stopped if somebody asks to stop while that is seen.
    """
    config = folder.config
    if config.backend == Backend.SIM.value:
        raise UserError("--games are live, or on the virtual client: begin a training with --backend live, or virtual")
    if config.trials != 1:
        raise UserError(f"games teach one trial together, and this training has {config.trials}: leave out --trials")
    agent = folder.new_agent(1, config.preset.device)
    trainer = GamesTrainer(folder.scenario, agent, config.preset, config.seed, config.stop_at_optimum)
    setup = GameSetup(config.backend, folder.scenario, config.agent, config.preset, config.seed)
    with connected(cluster) as client, _alone(client, cluster, interrupt, say), DaskGames(client, setup) as games:
        yield GamesAtPlay(trainer, games, folder.scenario)


@contextmanager
def _alone(
    client: "Client", cluster: SchedulerAddress, interrupt: Interrupt, say: Callable[[str], None]
) -> Iterator[None]:
    from distributed import Lock

    lock = Lock(OF_GAMES, scheduler_rpc=client.scheduler, loop=client.loop)
    until, is_said = time.monotonic() + FREED_S, False
    while not lock.acquire(timeout=ASK_AGAIN_S):
        if interrupt.requested:
            raise Stopped("stopped: nothing was begun")
        if time.monotonic() >= until:
            raise ClusterError(f"another training has the games of {cluster.url}: wait until it ends, or stop it")
        if not is_said:
            is_said = True
            say(f"another training has the games; if it was killed, they are free within {FREED_S:.0f} s")
    try:
        yield
    finally:
        with suppress(Exception):  # the scheduler may be gone
            lock.release()


@dataclass
class LastEpisode:
    """The arena as the episode that came back last left it, for a view; as it begins where states are no numbers.

    Args:
        scenario: what is built.
        choices: how many of the agent's actions choose a material, before those of the arena.
        episode: the one that came back last, if its states are numbers.
    """

    scenario: Scenario
    choices: int
    episode: PlayedEpisode | None = None

    def cell(self, _run: int) -> Cell:
        """Return where the agent stood at the episode's end."""
        if self.episode is None:
            return self.scenario.start
        x, y = self.episode.observations[-1, :2].tolist()
        return x, y

    def placed(self, _run: int) -> frozenset[Cell]:
        """Return where the episode's blocks landed."""
        return blocks_of(self.episode, self.scenario.size, self.choices) if self.episode else frozenset()


def blocks_of(episode: PlayedEpisode, size: int, choices: int) -> frozenset[Cell]:
    """Return where an episode's blocks landed, by the rules and by (x, y, b) of each step."""
    placed: set[Cell] = set()
    seen = episode.observations[:, :3].tolist()
    for action, (_, _, before), (x, y, after) in zip(episode.actions.tolist(), seen[:-1], seen[1:], strict=True):
        if after < before and (block := landing((x, y), Action(action - choices), placed, size)):
            placed.add(block)
    return frozenset(placed)
