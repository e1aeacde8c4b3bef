"""Episodes of games: each game has one out, until it comes back, is left or is superseded."""

import numpy as np

from mc_nested.learn.games.episode import EpisodeOut, EpisodePlan, EpisodesOut


def an_episode(number: int, *, greedy: bool = False, probes: frozenset[tuple[int, int]] = frozenset()) -> EpisodeOut:
    """Return the episode of that number, played by the game of that number, planned after ten times as many."""
    plan = EpisodePlan(number, 0, number % 2, greedy, np.zeros(1, np.float32), 0.0, np.zeros((0, 2)), None)
    return EpisodeOut(plan, f"game {number}", 10 * number, (0.0, 0.0), probes, {})


def out_of(*episodes: EpisodeOut) -> EpisodesOut:
    out = EpisodesOut()
    for episode in episodes:
        out.add(episode)
    return out


def test_an_episode_can_be_removed_only_once() -> None:
    episode = an_episode(3)
    out = out_of(episode)
    assert out.remove(3) is episode
    assert out.remove(3) is None
    assert len(out) == 0


def test_a_leaving_game_removes_its_own_episode_alone() -> None:
    out = out_of(an_episode(3), an_episode(4))
    out.leave("game 3")
    assert out.remove(3) is None
    assert out.remove(4) is not None


def test_probes_and_materials_of_all_episodes_out_are_combined() -> None:
    out = out_of(an_episode(3, probes=frozenset({(1, 1)})), an_episode(4, probes=frozenset({(1, 1), (2, 1)})))
    assert out.probes == {(1, 1), (2, 1)}
    assert out.materials == {0, 1}
    assert (EpisodesOut().probes, EpisodesOut().materials) == (frozenset(), frozenset())


def test_superseding_removes_older_evaluations_and_keeps_training_episodes() -> None:
    out = out_of(an_episode(1, greedy=True), an_episode(2), an_episode(3, greedy=True))
    assert out.newest_evaluation == 30
    out.supersede(30)
    assert out.remove(1) is None
    assert out.remove(2) is not None
    assert out.newest_evaluation == 30
    out.keep_evaluations()
    assert len(out) == 1
    out.clear()
    assert out.newest_evaluation == -1
