"""A training with many games, made up here: who plays which episode, and which episodes count or are lost."""

import dataclasses
from collections import deque
from typing import Any

import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.games_at_play import GamesAtPlay, blocks_of
from mc_nested.errors import ClusterError
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.games.player import play_episode
from mc_nested.workers.games.dask_games import Answered, GameEvent, Joined, Left, NameTaken, Unreachable
from mc_nested.workers.games.mailbox import GameAnswer
from sim.grid import GridGame
from tests.learn.made_experiments import DOT
from tests.workers.games.made_setups import SETUP, new_trainer


class MadeGames:
    """Games that answer when the test lets them."""

    def __init__(self) -> None:
        self.asked: list[tuple[str, EpisodePlan | None]] = []
        self.coming: deque[GameEvent] = deque()

    def ask(self, game: str, plan: EpisodePlan | None) -> None:
        self.asked.append((game, plan))

    def events(self, _timeout_s: float) -> list[GameEvent]:
        found = list(self.coming)
        self.coming.clear()
        return found


class Play:
    """A training with made-up games."""

    def __init__(self) -> None:
        self.games = MadeGames()
        self.trainer = new_trainer()
        made: Any = self.games
        self.at_play = GamesAtPlay(self.trainer, made, DOT)

    def happens(self, *events: GameEvent) -> list[str]:
        self.games.coming += events
        return self.at_play.play_on()

    def begin(self, *names: str) -> list[EpisodePlan]:
        """Let these games join and be ready; the plans that they get."""
        self.happens(*map(Joined, names))
        self.happens(*(Answered(name, GameAnswer()) for name in names))
        return [plan for _, plan in self.games.asked[-len(names) :] if plan]


@pytest.fixture
def play() -> Play:
    return Play()


def played(plan: EpisodePlan) -> PlayedEpisode:
    arena = ArenaVectorEnv([ArenaEnv(GridGame(DOT), DOT)])
    return play_episode(arena, plan, SETUP.new_agent())


def test_a_game_that_joins_is_asked_whether_it_is_ready_and_then_gets_a_plan(play: Play) -> None:
    assert play.happens(Joined("one")) == ["one has joined"]
    assert play.games.asked == [("one", None)]
    assert play.happens(Answered("one", GameAnswer())) == []
    name, plan = play.games.asked[-1]
    assert name == "one"
    assert plan
    assert play.at_play.in_words() == "1 game, 1 playing"


def test_an_episode_counts_once_and_the_game_gets_the_next(play: Play) -> None:
    (plan,) = play.begin("one")
    episode = played(plan)
    assert play.happens(Answered("one", GameAnswer(episode, log={"game_s": [2.0]}))) == []
    assert len(play.trainer.episode_rows) == 1
    assert play.games.asked[-1][1]
    play.happens(Answered("one", GameAnswer(episode)))
    assert len(play.trainer.episode_rows) == 1
    assert play.at_play.summary()["live"]["game_s"] == [2.0]


def test_answers_that_arrived_before_the_end_count_and_no_game_is_asked_again(play: Play) -> None:
    first, second = play.begin("one", "two")
    asked = len(play.games.asked)
    play.games.coming += [
        Answered("one", GameAnswer(played(first))),
        Answered("two", GameAnswer(played(second))),
        Left("one"),
    ]
    play.at_play.end()
    assert len(play.trainer.episode_rows) == 2
    assert len(play.games.asked) == asked


def test_a_game_whose_answers_cannot_be_fetched_is_named_with_its_address(play: Play) -> None:
    play.begin("one")
    (said,) = play.happens(Unreachable("one", "tcp://192.168.0.11:50123"))
    assert said.startswith("one has answered, but can't be reached at tcp://192.168.0.11:50123: let that port through")


def test_game_that_leaves_loses_only_its_own_episode_and_may_join_again(play: Play) -> None:
    first, second = play.begin("one", "two")
    assert play.happens(Left("one")) == ["one is gone, its episode is lost"]
    assert play.at_play.in_words() == "1 game, 1 playing, 1 episode lost"
    play.happens(Answered("two", GameAnswer(played(second))))
    assert len(play.trainer.episode_rows) == 1
    assert play.happens(Joined("one")) == ["one has joined"]
    assert play.games.asked[-1] == ("one", None)
    assert not play.trainer.take(played(first))


def test_after_a_mishap_a_game_says_first_that_it_is_ready_again(play: Play) -> None:
    play.begin("one")
    assert play.happens(Answered("one", GameAnswer(problem="the game is paused"))) == [
        "one: the game is paused, its episode is lost"
    ]
    assert play.games.asked[-1] == ("one", None)
    play.happens(Answered("one", GameAnswer()))
    assert play.games.asked[-1][1]
    summary = play.at_play.summary()["live"]
    assert (summary["spoiled_episodes"], summary["last_problems"]) == (1, ["the game is paused"])


def test_the_training_ends_at_the_optimum_and_nobody_gets_another_plan(play: Play) -> None:
    plans = dict(zip(("one", "two"), play.begin("one", "two"), strict=True))
    while not play.trainer.finished:
        for name in plans:
            if play.trainer.finished:
                break
            play.happens(Answered(name, GameAnswer(played(plans[name]))))
            asked, plan = play.games.asked[-1]
            if plan and asked == name:
                plans[name] = plan
    asked_so_far = len(play.games.asked)
    play.happens(Answered("one", GameAnswer(played(plans["one"]))))
    assert len(play.games.asked) == asked_so_far


@pytest.mark.parametrize(
    "answer", [GameAnswer(problem="the arena is too small", is_refusal=True), ClusterError("the arena is too small")]
)
def test_refusal_of_the_only_game_ends_the_training_with_its_reason(answer: GameAnswer | Exception, play: Play) -> None:
    play.happens(Joined("one"))
    with pytest.raises(ClusterError, match=r"^one can't play: the arena is too small$"):
        play.happens(Answered("one", answer))


def test_refusal_of_one_of_several_games_leaves_the_others_playing(play: Play) -> None:
    play.begin("one", "two")
    refusal = GameAnswer(problem="the arena is too small", is_refusal=True)
    assert play.happens(Answered("one", refusal)) == ["one can't play: the arena is too small"]
    assert play.happens(Left("one")) == []
    assert play.at_play.in_words() == "1 game, 1 playing, 1 episode lost"


def test_training_waits_for_a_game_that_left_even_if_another_game_has_refused(play: Play) -> None:
    play.begin("one")
    refusal = GameAnswer(problem="another version", is_refusal=True, leaves=True)
    play.happens(Joined("old"))
    play.happens(Answered("old", refusal))
    assert play.happens(Left("one")) == ["one is gone, its episode is lost"]
    assert play.happens(Joined("one")) == ["one has joined"]


def test_a_game_that_leaves_is_not_asked_again(play: Play) -> None:
    play.begin("one")
    asked = len(play.games.asked)
    said = play.happens(Answered("one", GameAnswer(problem="its player has ended it", leaves=True)))
    assert said == ["one: its player has ended it, its episode is lost"]
    assert len(play.games.asked) == asked


def test_a_training_without_a_game_waits_and_says_so(play: Play) -> None:
    assert play.happens() == []
    assert play.at_play.in_words() == "waiting for a game (mc-nested train serve)"


def test_second_game_of_the_same_name_is_reported_as_refused(play: Play) -> None:
    assert play.happens(NameTaken("one")) == ["a second game named one was refused: give it another --name"]


def test_the_view_shows_the_episode_that_came_back_last(play: Play) -> None:
    shown = play.at_play.arenas
    assert (shown.cell(0), shown.placed(0)) == (DOT.start, frozenset())
    (plan,) = play.begin("one")
    arena = ArenaVectorEnv([ArenaEnv(GridGame(DOT), DOT)])
    episode = play_episode(arena, plan, SETUP.new_agent())
    play.happens(Answered("one", GameAnswer(episode)))
    assert shown.cell(0) == arena.cell(0)
    assert shown.placed(0) == arena.placed(0)
    single = dataclasses.replace(episode, actions=episode.actions + 2)
    assert blocks_of(single, DOT.size, 2) == arena.placed(0)
