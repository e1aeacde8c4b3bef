"""The main thread of a served game: the episodes that it plays, its answers after mishaps, and its end."""

from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv
from mc_nested.errors import DesktopError, LiveError, NotConfirmedError, ProfileError, StoppedError
from mc_nested.learn.games.episode import EpisodePlan
from mc_nested.workers.games.game_server import GameServer, OpenGame
from mc_nested.workers.games.mailbox import GameAnswer, GameSetup, Mailbox, Request
from sim.virtual_games import VirtualPlay, open_virtual_games
from tests.workers.games.made_setups import SETUP, new_trainer

PLAN = new_trainer().plan("pc")


class Served:
    """A server over a game on the virtual client, whose requests are asked one after the other."""

    def __init__(self) -> None:
        self.said: list[str] = []
        self.is_in_front = True
        self.is_ended = False
        """Whether the player has ended it."""
        self.opened: list[GameSetup] = []
        self.closed = 0
        self.before_step: Callable[[], None] = lambda: None
        self.check_stopped: Callable[[], None] = lambda: None
        self.looks = iter(range(0))
        """How often it looks for another request before it is ended."""
        self.opening_error: Exception | None = None
        self.announced: list[int] = []
        self.down: set[str] = {"unknown"}
        """What is held down in the client's window: keys and buttons."""

    @contextmanager
    def opens(self, setup: GameSetup) -> Iterator[OpenGame]:
        if self.opening_error:
            raise self.opening_error
        self.opened.append(setup)
        try:
            with open_virtual_games([setup.scenario], setup.seed) as (game,):
                arena = ArenaVectorEnv([ArenaEnv(game, setup.scenario)])
                keyboard: Any = game.connection.devices.keyboard
                self.down = keyboard._sender._window.down
                step = arena.step

                def watched(actions: Any) -> Any:
                    self.before_step()
                    return step(actions)

                arena.step = watched  # type: ignore[method-assign]
                announce = arena.announce

                def noted(following: Any) -> None:
                    self.announced += following.tolist()
                    announce(following)

                arena.announce = noted  # type: ignore[method-assign]
                yield OpenGame(arena, VirtualPlay([game]), lambda: self.is_in_front, self.check_stopped)
        finally:
            self.closed += 1

    def ask(self, *plans: EpisodePlan | None, wanted: Callable[[], bool] = lambda: True) -> list[GameAnswer]:
        """Return the answers to these requests, after which the player ends it."""
        mailbox = Mailbox()
        requests = [Request(SETUP, plan, wanted, Future()) for plan in plans]
        for request in requests:
            mailbox._requests.put(request)

        def is_over() -> bool:
            all_is_answered = all(request.answer.done() for request in requests)
            return self.is_ended or (all_is_answered and next(self.looks, None) is None)

        self.server = GameServer(mailbox, self.opens, self.said.append, is_over)
        try:
            self.server.serve()
        finally:
            self.answers = [request.answer.result() for request in requests if request.answer.done()]
        return self.answers


@pytest.fixture
def served() -> Served:
    return Served()


def test_an_episode_is_played_as_it_was_planned(served: Served) -> None:
    (answer,) = served.ask(PLAN)
    assert answer.episode
    assert answer.episode.number == PLAN.number
    assert answer.problem == ""
    assert answer.log["game_s"][0] > 0
    assert served.said == ["episode 1 of dot", f"episode 1: score {answer.episode.score:g} of 11"]
    assert served.closed == 1


def test_a_served_game_is_told_what_comes_next(served: Served) -> None:
    plan = replace(PLAN, first_tries=None)
    (answer,) = served.ask(plan)
    assert answer.episode
    assert served.announced == [*answer.episode.actions[1:].tolist(), NO_ACTION]


def test_game_asked_without_a_plan_answers_that_it_is_ready(served: Served) -> None:
    (answer,) = served.ask(None)
    assert (answer.episode, answer.problem, answer.is_refusal) == (None, "", False)
    assert served.said == []


def test_the_game_stays_open_between_episodes(served: Served) -> None:
    assert all(answer.episode for answer in served.ask(PLAN, PLAN, PLAN))
    assert len(served.opened) == 1


def test_mishap_spoils_only_its_own_episode(served: Served) -> None:
    mishaps = iter([NotConfirmedError("it did not move")])

    def once() -> None:
        for error in mishaps:
            raise error

    served.before_step = once
    first, second = served.ask(PLAN, PLAN)
    assert first.episode is None
    assert first.problem == "it did not move"
    assert second.episode
    assert second.log["spoiled_episodes"] == 1


def test_unwanted_episode_is_broken_off_with_no_key_down(served: Served) -> None:
    steps: list[int] = []
    served.before_step = lambda: steps.append(1)
    (answer,) = served.ask(PLAN, wanted=lambda: len(steps) < 2)
    assert answer.episode is None
    assert answer.problem.startswith("the episode was broken off")
    assert len(steps) == 2
    assert not answer.log["spoiled_episodes"]
    assert served.down == set()


def test_player_who_ends_the_game_breaks_off_the_episode_and_the_learner_is_told_why(served: Served) -> None:
    def ends() -> None:
        served.is_ended = True

    served.before_step = ends
    (answer,) = served.ask(PLAN)
    assert (answer.problem, answer.leaves) == ("its player has ended it", True)
    assert served.said == ["episode 1 of dot", "the episode was broken off"]
    assert served.down == set()


def test_game_in_the_background_waits_to_be_ready_but_returns_an_episode_unplayed(served: Served) -> None:
    served.is_in_front = False
    looks = iter(range(3))

    def wanted() -> bool:
        if next(looks, None) is None:
            served.is_in_front = True
        return True

    (ready,) = served.ask(None, wanted=wanted)
    assert ready.problem == ""
    assert served.said == ["paused: switch to the game to let it go on", "goes on"]
    served.is_in_front = False
    (answer,) = served.ask(PLAN)
    assert answer.problem == "the game is paused: its player is in another window"


def test_pause_ends_if_nobody_wants_the_answer_any_more(served: Served) -> None:
    served.is_in_front = False
    (answer,) = served.ask(None, wanted=lambda: False)
    assert answer.problem == "the game is paused"


def test_panic_key_ends_the_game_and_the_learner_is_told(served: Served) -> None:
    served.before_step = stopped
    with pytest.raises(StoppedError):
        served.ask(PLAN, PLAN)
    (answer,) = served.answers
    assert answer.problem == "the panic key was pressed"
    assert served.closed == 1
    assert served.down == set()


def stopped() -> None:
    raise StoppedError("the panic key was pressed")


def test_the_panic_key_ends_a_game_that_is_paused_too(served: Served) -> None:
    served.is_in_front, served.check_stopped = False, stopped
    looks = iter(range(5))
    with pytest.raises(StoppedError):
        served.ask(None, wanted=lambda: next(looks, None) is not None)
    (answer,) = served.answers
    assert (answer.problem, answer.leaves) == ("the panic key was pressed", True)
    assert served.said == ["paused: switch to the game to let it go on"]


def test_panic_key_ends_an_idle_game(served: Served) -> None:
    served.looks, served.check_stopped = iter(range(5)), stopped
    with pytest.raises(StoppedError):
        served.ask(PLAN)
    (answer,) = served.answers
    assert answer.episode
    assert served.closed == 1


def test_a_game_whose_window_is_closed_ends_and_the_learner_is_told(served: Served) -> None:
    def closed() -> None:
        raise DesktopError("the game's window was closed")

    served.before_step = closed
    with pytest.raises(DesktopError):
        served.ask(PLAN, PLAN)
    (answer,) = served.answers
    assert (answer.problem, answer.leaves) == ("the game's window was closed", True)
    assert served.closed == 1


def test_unwanted_plan_is_not_begun(served: Served) -> None:
    steps: list[int] = []
    served.before_step = lambda: steps.append(1)
    (answer,) = served.ask(PLAN, wanted=lambda: False)
    assert answer.episode is None
    assert steps == []


def test_game_is_given_up_after_six_failed_episodes(served: Served) -> None:
    def fails() -> None:
        raise NotConfirmedError("it did not move")

    served.before_step = fails
    with pytest.raises(NotConfirmedError):
        served.ask(*[PLAN] * 10)
    assert len(served.answers) == 6


@pytest.mark.parametrize("error", [ProfileError("the arena is too small"), LiveError("no game in front")])
def test_a_game_that_cannot_be_opened_is_refused_at_both_ends(error: Exception, served: Served) -> None:
    served.opening_error = error
    with pytest.raises(type(error), match=str(error)):
        served.ask(PLAN)
    assert served.answers == [GameAnswer(problem=str(error), is_refusal=True, leaves=True)]
