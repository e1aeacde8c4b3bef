"""The main thread of a served game: it owns the game, and plays what it finds in the mailbox."""

from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from typing import Any

from gymnasium.vector import VectorEnv
from gymnasium.vector.vector_env import VectorWrapper

from mc_nested.arena.game import PlayLog
from mc_nested.arena.vector import foresees
from mc_nested.arrays import Int64s
from mc_nested.errors import DesktopError, LiveError, NotInFrontError, UserError
from mc_nested.learn.agents import Agent
from mc_nested.learn.games.episode import PlayedEpisode
from mc_nested.learn.games.player import play_episode
from mc_nested.live.action_log import FailureBudget
from mc_nested.workers.games.mailbox import GameAnswer, GameSetup, Mailbox, Request

Say = Callable[[str], None]
"""Shows one line to the player."""


@dataclass(frozen=True)
class OpenGame:
    """A game that is open: one arena, the log of playing it, and whether it can be played now.

    ``check_stopped`` raises StoppedError once its player has stopped it, as by the panic key.
    """

    arena: VectorEnv[Any, Int64s, Any]
    log: PlayLog
    is_in_front: Callable[[], bool]
    check_stopped: Callable[[], None] = lambda: None


Opener = Callable[[GameSetup], AbstractContextManager[OpenGame]]
"""Opens the game that a setup needs. UserError or LiveError, one line each, if it can't be."""


class UnwantedError(LiveError):
    """Raised when nobody waits for the episode any more: learner or network are gone, or this game is to end."""


class GameServer:
    """Plays what is asked for, until it is to end.

    Args:
        mailbox: where requests lie.
        opens: opens the game.
        say: shows a line to the player.
        is_over: whether the player has asked to end.
    """

    def __init__(self, mailbox: Mailbox, opens: Opener, say: Say, is_over: Callable[[], bool]) -> None:
        self._mailbox, self._opens, self._say, self._is_over = mailbox, opens, say, is_over
        self._setup: GameSetup | None = None
        self._stack = ExitStack()
        self._failures = FailureBudget()
        self._steps = self._episodes = 0

    def serve(self) -> None:
        """Answer requests until the player has asked to end; the game is closed then, with no key left down.

        UserError or LiveError if it can't be opened, was stopped by its panic key, or fails again and again: the
        learner has been told before.
        """
        with self._stack:
            while not self._is_over():
                if request := self._mailbox.next():
                    self._answer(request)
                elif self._setup:
                    self._game.check_stopped()

    def _answer(self, request: Request) -> None:
        try:
            game, agent = self._opened_for(request.setup)
        except (UserError, LiveError) as error:
            request.answer.set_result(GameAnswer(problem=str(error), is_refusal=True, leaves=True))
            raise
        try:
            self._wait_until_in_front(game, request)
            episode = self._played(game, agent, request)
        except UnwantedError as error:
            is_over = self._is_over()
            self._say("the episode was broken off" if is_over else str(error))
            problem = "its player has ended it" if is_over else str(error)
            request.answer.set_result(GameAnswer(problem=problem, leaves=is_over, log=self._summary(game)))
        except DesktopError as error:
            request.answer.set_result(GameAnswer(problem=str(error), leaves=True, log=self._summary(game)))
            raise
        except LiveError as error:
            if request.plan:
                self._say(f"the episode was lost: {error}")
            try:
                if not isinstance(error, NotInFrontError):
                    self._failures.record_failure(error, self._steps)
            except LiveError:
                request.answer.set_result(GameAnswer(problem=str(error), leaves=True, log=self._summary(game)))
                raise
            request.answer.set_result(GameAnswer(problem=str(error), log=self._summary(game)))
        else:
            request.answer.set_result(GameAnswer(episode, log=self._summary(game)))

    def _played(self, game: OpenGame, agent: Agent, request: Request) -> PlayedEpisode | None:
        if request.plan is None:
            return None
        self._say(f"episode {self._episodes + 1} of {request.setup.scenario.name}")
        wanted = _WantedArena(game.arena, lambda: request.is_wanted() and not self._is_over())
        episode = play_episode(wanted, request.plan, agent)
        self._episodes += 1
        self._steps += episode.steps
        self._say(f"episode {self._episodes}: score {episode.score:g} of {request.setup.scenario.optimum:g}")
        return episode

    def _opened_for(self, setup: GameSetup) -> tuple[OpenGame, Agent]:
        if setup != self._setup:
            self._stack.close()
            self._setup = None
            self._game = self._stack.enter_context(self._opens(setup))
            self._agent = setup.new_agent()
            self._setup = setup
        return self._game, self._agent

    def _wait_until_in_front(self, game: OpenGame, request: Request) -> None:
        """Wait as long as the player is elsewhere, unless an episode is asked for: others can play that."""
        if game.is_in_front():
            return
        if request.plan:
            raise NotInFrontError("the game is paused: its player is in another window")
        self._say("paused: switch to the game to let it go on")
        while not game.is_in_front():
            if self._is_over() or not request.is_wanted():
                raise UnwantedError("the game is paused")
            game.check_stopped()
            self._mailbox.wait()
        self._say("goes on")

    def _summary(self, game: OpenGame) -> dict[str, Any]:
        return {**game.log.summary(), **self._failures.summary()}


class _WantedArena(VectorWrapper):
    """An arena whose episode ends with UnwantedError where nobody wants it any more."""

    def __init__(self, arena: VectorEnv[Any, Int64s, Any], is_wanted: Callable[[], bool]) -> None:
        super().__init__(arena)
        self._is_wanted = is_wanted
        if foresees(arena):
            self.foresees, self.expected, self.announce = True, arena.expected, arena.announce  # type: ignore[attr-defined]  # it has them

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> Any:
        self._check_wanted()
        return self.env.reset(seed=seed, options=options)

    def step(self, actions: Any) -> Any:
        self._check_wanted()
        return self.env.step(actions)

    def _check_wanted(self) -> None:
        if not self._is_wanted():
            raise UnwantedError("the episode was broken off: nobody waits for it")
