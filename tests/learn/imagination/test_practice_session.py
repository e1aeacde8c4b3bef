"""A practice reaches its aim in the learnt game, in the named row alone, repeatably, and ends where it has to."""

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.errors import DivergedError
from mc_nested.learn.imagination.arena_step import NOWHERE, index_of, step
from mc_nested.learn.imagination.practice_session import (
    CAPACITY,
    Goal,
    NetworkPractice,
    Practised,
    RealTransitions,
    landed_cells,
)
from mc_nested.learn.learner import Learner
from mc_nested.learn.preset import Preset
from tests.learn.imagination.made_games import BENT, RULE, SMALL, with_update
from tests.learn.imagination.made_practice import GOAL, MATERIAL, arena_of, learner_of, real_of

UNREACHABLE = GOAL._replace(aim=float(BENT.blocks + 1), most_updates=50, most_table_steps=0)


def practised(
    learner: Learner,
    row: int = 0,
    goal: Goal = GOAL,
    real: RealTransitions | None = None,
    preset: Preset = SMALL,
    seed: int = 5,
) -> tuple[Practised, NetworkPractice]:
    practice = NetworkPractice(learner, preset, RULE)
    real = real_of(learner) if real is None else real
    session = practice.session(row, arena_of(), goal, MATERIAL, real, np.random.default_rng(seed))
    session.run()
    return session.practised, practice


def greedy_score(learner: Learner, row: int) -> float:
    """Return what the row's policy earns in the learnt game, played step by step by the learner's own choice."""
    arena = arena_of()
    solid, position, left, score = arena.empty.copy(), index_of(BENT.start, arena), BENT.blocks, 0.0
    for _ in range(BENT.step_limit):
        x, y = position // arena.side - arena.border, position % arena.side - arena.border
        state = np.array([[x, y, left, *MATERIAL]])
        action = int(learner.act(state, np.zeros(1), np.zeros((1, 2)), np.array([row]))[0])
        position, block = step(arena, position, action, solid)
        left, score = left - (block != NOWHERE), score + arena.pay[block]
        if left == 0:
            break
    return score


@pytest.mark.parametrize("seed", range(3))
def test_a_practice_reaches_its_aim_and_its_policy_plays_as_well_outside(seed: int) -> None:
    learner = learner_of(seed=seed)
    result, _ = practised(learner)
    assert result.reached
    assert result.score == GOAL.aim == greedy_score(learner, 0)
    assert 0 < result.updates == learner.engine.updates[0] < 15_000


def test_a_reached_aim_is_confirmed_by_one_greedy_episode_without_an_update() -> None:
    learner = learner_of()
    practised(learner)
    online = learner.engine.online.copy()
    assert practised(learner, seed=6)[0] == Practised(0, 1, GOAL.aim, True)
    np.testing.assert_array_equal(learner.engine.online, online)


def test_a_practice_changes_its_own_row_only_and_ignores_the_other_rows() -> None:
    learner, alone = learner_of(3), learner_of(3)
    before = {name: kept.copy() for name, kept in learner.engine.state().items()}
    practised(learner, row=1)
    for name, kept in learner.engine.state().items():
        np.testing.assert_array_equal(kept[[0, 2]], before[name][[0, 2]], err_msg=name)
        assert (kept[1] != before[name][1]).any(), name
    practised(alone, row=0)
    practised(alone, row=1)
    np.testing.assert_array_equal(alone.engine.online[1], learner.engine.online[1])
    assert learner.replay.added.tolist() == [0, 0, 0], "a practice has a replay of its own"


def test_the_same_seed_practises_the_same_networks_and_another_does_not() -> None:
    one, same, other = learner_of(), learner_of(), learner_of()
    results = [practised(one)[0], practised(same)[0]]
    assert results[0] == results[1]
    for name, kept in one.engine.state().items():
        np.testing.assert_array_equal(kept, same.engine.state()[name], err_msg=name)
    practised(other, seed=77)
    assert (one.engine.online != other.engine.online).any()


def test_a_practice_with_an_unreachable_aim_ends_at_its_budget() -> None:
    result, _ = practised(learner_of(), goal=UNREACHABLE)
    assert not result.reached
    assert result.updates >= UNREACHABLE.most_updates
    # The budget is looked at each time that the numbers are used up, 65536 of them: 18 an update here.
    assert result.updates < UNREACHABLE.most_updates + 65_536 / 17
    assert result.episodes > 10


def test_a_practice_ends_when_the_networks_reach_the_score_of_tables_that_fell_short() -> None:
    result, _ = practised(learner_of(), goal=GOAL._replace(aim=float(BENT.blocks + 1)))
    assert not result.reached
    assert result.score == BENT.blocks
    assert 0 < result.updates < GOAL.most_updates


@pytest.mark.parametrize("seed", range(4))
def test_a_practice_that_falls_short_leaves_its_best_policy(seed: int) -> None:
    learner = learner_of(seed=seed)
    result, _ = practised(learner, goal=UNREACHABLE._replace(most_updates=3_000), seed=seed)
    assert not result.reached
    assert result.score == greedy_score(learner, 0)
    again, _ = practised(learner, goal=UNREACHABLE, seed=seed)
    assert again.score >= result.score, "practice makes no policy worse"
    np.testing.assert_array_equal(learner.engine.online, learner.engine.target)


def test_saturated_networks_reach_the_aim_only_when_they_begin_anew() -> None:
    results = []
    for anew in (False, True):
        learner = learner_of()
        learner.engine.online[:] = learner.engine.target[:] = 100.0  # every node is saturated
        results.append(practised(learner, goal=GOAL._replace(anew=anew))[0].reached)
    assert results == [False, True]


def test_a_practice_ends_when_told_to() -> None:
    answers = iter([True, True, False])
    learner = learner_of()
    goal = UNREACHABLE._replace(most_updates=10**9)
    practice, random = NetworkPractice(learner, SMALL, RULE), np.random.default_rng(0)
    session = practice.session(0, arena_of(), goal, MATERIAL, real_of(learner), random)
    session.run(lambda: next(answers))
    assert not session.practised.reached
    assert session.practised.updates > 0
    assert list(answers) == []


def test_a_practice_told_to_end_at_once_makes_no_update() -> None:
    learner = learner_of()
    practice, random = NetworkPractice(learner, SMALL, RULE), np.random.default_rng(0)
    session = practice.session(0, arena_of(), GOAL, MATERIAL, real_of(learner), random)
    session.run(lambda: False)
    assert session.practised == Practised(0, 0, 0.0, False)


def test_diverging_networks_are_reported_in_one_line() -> None:
    diverging = with_update(SMALL, learning_rate=1e38)
    learner = learner_of()
    with pytest.raises(DivergedError, match="lower it in the preset") as caught:
        practised(learner, goal=UNREACHABLE, preset=diverging)
    assert "\n" not in str(caught.value)


def test_a_practices_replay_holds_real_transitions_first_and_then_imagined_ones() -> None:
    learner, arena = learner_of(), arena_of()
    real = real_of(
        learner,
        ([2, 1, 3, 1], int(Action.FD), [2, 2, 2, 1], index_of((2, 3), arena)),
        ([2, 2, 1, 1], int(Action.LD), [1, 2, 0, 1], index_of((1, 3), arena)),
    )
    _, practice = practised(learner, goal=UNREACHABLE, real=real)
    replay = practice._replay
    assert replay.states[:2].tolist() == learner.states.encoded(np.array([[2, 1, 3, 1], [2, 2, 1, 1]])).tolist()
    assert replay.next_states[:2].tolist() == learner.states.encoded(np.array([[2, 2, 2, 1], [1, 2, 0, 1]])).tolist()
    assert replay.actions[:2].tolist() == [Action.FD, Action.LD]
    assert replay.landed[:2].tolist() == [index_of((2, 3), arena), index_of((1, 3), arena)]
    assert replay.terminated[:2].tolist() == [False, True]
    added = int(replay.added[0])
    begins = learner.states.encoded(np.array([*BENT.start_state, 1]))
    assert replay.states[2] == begins, "the first imagined episode"
    imagined = replay.states[2:added]
    assert (imagined % 2 == 1).all(), "its material comes last in a state"
    assert replay.terminated[2:added].tolist() == (replay.next_states[2:added] // 2 % 4 == 0).tolist()
    assert added < CAPACITY


def test_the_next_practice_begins_with_its_own_real_transitions_alone() -> None:
    learner = learner_of()
    practice, random = NetworkPractice(learner, SMALL, RULE), np.random.default_rng(0)
    real = real_of(learner, ([2, 1, 3, 1], int(Action.B), [2, 0, 3, 1], NOWHERE))
    practice.session(0, arena_of(), UNREACHABLE, MATERIAL, real, random).run()
    assert practice._replay.added[0] > 1
    in_one_go, empty = iter([True, False]), GOAL._replace(step_limit=0)
    practice.session(0, arena_of(), empty, MATERIAL, real, random).run(lambda: next(in_one_go))
    assert practice._replay.added.tolist() == [1]


def test_landed_cells_follow_from_the_agents_cell_after_each_action() -> None:
    arena = arena_of()
    steps = np.array([[2, 1, 3, 4, 2, 2, 2, 0, 1], [2, 2, 2, 0, 2, 2, 2, 0, 1], [2, 2, 2, 5, 1, 2, 1, 1, 1]])
    assert landed_cells(steps, (0, 1), arena).tolist() == [index_of((2, 3), arena), NOWHERE, index_of((1, 3), arena)]
    assert landed_cells(steps[:0], (0, 1), arena).tolist() == []
