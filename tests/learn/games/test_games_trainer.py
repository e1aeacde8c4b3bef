"""A learner with several games: which episodes count, how they differ, and when the run is finished."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays
from mc_nested.errors import PresetError
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.games.games_trainer import GamesTrainer, materials_of
from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.preset import Preset, load_preset
from tests.arena.made_parts import STRIPES
from tests.learn.games.lockstep import finish, game_of, learner_of
from tests.learn.imagination.made_games import BENT, SMALL, TWO
from tests.learn.made_experiments import small_preset
from tests.learn.made_trainings import copied

PAPER = load_preset("paper").model_copy(update={"episodes": 6, "evaluate_every": 3})
PLAY = {id(preset): game_of(BENT, preset) for preset in (SMALL, PAPER)}


def play(plan: EpisodePlan, preset: Preset = SMALL) -> PlayedEpisode:
    return PLAY[id(preset)](plan)


def assert_same(one: Arrays, other: Arrays) -> None:
    assert one.keys() == other.keys()
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def with_a_known_game() -> GamesTrainer:
    """Return a learner that has played enough to know what its actions do."""
    learner = learner_of(BENT, SMALL)
    for _ in range(3):
        learner.take(play(learner.plan("game")))
    assert learner.practice.imagination is not None
    assert learner.practice.imagination.rules(0).known.all()
    return learner


def with_a_known_design(stops: bool = False) -> tuple[GamesTrainer, EpisodePlan]:
    """Return a learner that is about to evaluate a policy that builds all of its design, and that evaluation."""
    learner = learner_of(BENT, SMALL.model_copy(update={"episodes": 40}), stops=stops)
    while not (plan := learner.plan("game 0")).greedy:
        learner.take(play(plan))
    return learner, plan


def cells_of(played: PlayedEpisode) -> set[tuple[int, int]]:
    """Return the cells where the episode's blocks landed, each ahead of the agent."""
    used = played.observations[1:, 2] < played.observations[:-1, 2]
    return {(int(x), int(y) + 1) for x, y in played.observations[1:][used][:, :2]}


def test_an_episode_counts_exactly_once() -> None:
    learner = learner_of(BENT, SMALL)
    played = play(learner.plan("game"))
    assert learner.take(played)
    before = copied(learner.state())
    assert not learner.take(played), "it was taken"
    assert not learner.take(replace(played, number=7)), "it was never planned"
    assert_same(learner.state(), before)
    assert len(learner.episode_rows) == 1


def test_an_episode_that_another_learner_planned_does_not_count() -> None:
    learner, resumed = learner_of(BENT, SMALL), learner_of(BENT, SMALL)
    played = play(learner.plan("game"))
    assert resumed.plan("game").number == played.number
    assert not resumed.take(played)
    assert learner.take(played)


def test_an_abandoned_episode_uses_up_its_number_and_changes_nothing_else() -> None:
    learner = learner_of(BENT, SMALL)
    other, plan = learner.plan("game 0"), learner.plan("game 1")
    before = copied(learner.state())
    learner.abandon(plan.number)
    learner.abandon(plan.number)
    assert not learner.take(play(plan))
    assert_same(learner.state(), before)
    assert learner.take(play(other)), "it costs that episode alone"
    assert learner.plan("game 1").number == 2


def test_planning_a_games_next_episode_abandons_its_unfinished_one() -> None:
    learner = learner_of(BENT, SMALL)
    first, second = learner.plan("game"), learner.plan("game")
    assert not learner.take(play(first))
    assert learner.take(play(second))


MOVES = st.lists(st.tuples(st.integers(0, 2), st.sampled_from(["plan", "take", "take", "abandon"])), max_size=30)


@given(MOVES)
def test_every_taken_episode_becomes_exactly_one_row_in_any_order_of_events(moves: list[tuple[int, str]]) -> None:
    learner, out, taken, greedy = learner_of(BENT, PAPER), dict[int, EpisodePlan](), 0, 0
    ends = ((0, move) for move in itertools.cycle(["plan", "take"]))
    for game, move in itertools.chain(moves, ends):
        if learner.finished:
            break
        if game not in out or move == "plan":
            out[game] = learner.plan(f"game {game}")
        elif move == "abandon":
            learner.abandon(out.pop(game).number)
        else:
            plan = out.pop(game)
            played = play(plan, PAPER)
            if learner.take(played):
                taken, greedy = taken + 1, greedy + plan.greedy
            assert not learner.take(played)
    assert taken == len(learner.episode_rows) + len(learner.evaluation_rows)
    assert greedy == len(learner.evaluation_rows)
    assert [row.episode for row in learner.episode_rows] == list(range(1, PAPER.episodes + 1))
    assert learner.env_steps == sum(row.steps for row in learner.episode_rows)
    assert learner.evaluation_steps == sum(row.steps for row in learner.evaluation_rows)
    evaluated = [row.episode for row in learner.evaluation_rows]
    assert evaluated == sorted(set(evaluated))
    assert evaluated[-1] == PAPER.episodes


def test_first_episodes_of_several_games_try_different_actions_and_materials() -> None:
    learner = learner_of(BENT, SMALL)
    plans = [learner.plan(f"game {game}") for game in range(3)]
    assert len({int(play(plan).actions[0]) for plan in plans}) == 3
    assert [plan.material for plan in plans[:2]] in ([0, 1], [1, 0])
    assert [plan.epsilon for plan in plans] == [0.0, 1.0, 1.0], "beside the first, what an untaught network says"


def test_simultaneous_episodes_probe_different_cells() -> None:
    learner = with_a_known_game()
    assert learner.practice.imagination is not None
    unknown = {
        (int(x), int(y))
        for x, y in np.argwhere(learner.practice.imagination.beliefs(0).cells <= Belief.BELIEVED)
        if y > 0  # no block lands on the near edge
    }
    probed = [cells_of(play(learner.plan(f"game {game}"))) & unknown for game in range(3)]
    assert all(probed)
    assert sum(map(len, probed)) == len(set.union(*probed))


def test_the_next_game_probes_cells_of_an_abandoned_episode() -> None:
    learner = with_a_known_game()
    dead = learner.plan("game 0")
    cells = cells_of(play(dead))
    learner.abandon(dead.number)
    assert cells_of(play(learner.plan("game 1"))) & cells


def test_an_evaluation_keeps_the_networks_that_played_it() -> None:
    learner, plan = with_a_known_design()
    played_by = copied(learner.agent.online())
    learner.take(play(learner.plan("game 1")))
    learner.plan("game 2")
    learner.agent.low_level.engine.load_online(learner.agent.low_level.engine.online + 1)
    assert learner.take(play(plan))
    assert learner.policy_scores.tolist() == [BENT.optimum]
    for role, online in played_by.items():
        np.testing.assert_array_equal(learner.policies[role], online)


def test_only_one_game_evaluates_after_the_same_episodes() -> None:
    learner, plan = with_a_known_design()
    assert not learner.plan("game 1").greedy
    learner.abandon(plan.number)
    assert learner.plan("game 0").greedy, "the evaluation that didn't come is still due"


def test_a_newer_evaluation_replaces_one_that_hangs_in_another_game() -> None:
    learner, hung = with_a_known_design()
    learner.take(play(learner.plan("game 1")))
    newer = learner.plan("game 1")
    assert newer.greedy
    assert learner.take(play(newer))
    assert not learner.take(play(hung)), "the rows of evaluations are in their policies' order"
    assert [row.episode for row in learner.evaluation_rows][-1] == len(learner.episode_rows)


def test_a_learner_finished_at_the_optimum_refuses_further_episodes() -> None:
    learner, plan = with_a_known_design(stops=True)
    other = learner.plan("game 1")
    assert learner.take(play(plan))
    assert learner.finished
    rows = len(learner.episode_rows)
    assert not learner.take(play(other))
    assert len(learner.episode_rows) == rows
    with pytest.raises(ValueError, match="finished"):
        learner.plan("game 0")


def test_every_game_evaluates_after_the_last_episode_and_the_first_result_ends_the_run() -> None:
    learner = learner_of(BENT, PAPER)
    late = learner.plan("late")
    while len(learner.episode_rows) < PAPER.episodes:
        learner.take(play(learner.plan("game 0"), PAPER))
    assert not learner.take(play(late, PAPER)), "there are no more than its episodes"
    last = [learner.plan(f"game {game}") for game in range(2)]
    assert all(plan.greedy for plan in last)
    assert learner.take(play(last[1], PAPER))
    assert learner.finished
    assert not learner.take(play(last[0], PAPER))


@pytest.mark.parametrize("agent", ["nested", "hierarchical", "single"])
def test_a_learner_without_imagination_learns_from_each_step_of_a_taken_episode(agent: str) -> None:
    preset = PAPER.model_copy(update={"update": PAPER.update.model_copy(update={"learning_starts": 1})})
    learner, game = learner_of(BENT, preset, agent=agent), game_of(BENT, preset, agent)
    plans = [learner.plan(f"game {game}") for game in range(2)]
    assert learner.agent.low_level.engine.updates.sum() == 0
    for plan in plans:
        assert learner.take(game(plan))
    assert learner.agent.low_level.engine.updates.sum() == learner.env_steps
    assert learner.agent.low_level.replay.added.sum() == learner.env_steps
    if learner.agent.main:
        assert learner.agent.main.engine.updates.tolist() == [2]
    finish(learner, game)


@pytest.mark.slow
@pytest.mark.parametrize("agent", ["nested", "single"])
def test_an_agent_with_image_states_learns_from_each_step_of_a_taken_episode(agent: str) -> None:
    image = load_preset("image")
    preset = image.model_copy(update={"update": image.update.model_copy(update={"learning_starts": 1})})
    learner, play_image = learner_of(BENT, preset, agent=agent), game_of(BENT, preset, agent)
    assert learner.take(play_image(learner.plan("game")))
    assert learner.agent.low_level.engine.updates.sum() == learner.env_steps > 0


def test_the_same_episodes_in_the_same_order_give_the_same_training() -> None:
    for preset in (SMALL, PAPER):
        one, other = learner_of(BENT, preset), learner_of(BENT, preset)
        for learner in (one, other):
            plans = [learner.plan(f"game {game}") for game in range(3)]
            for plan in reversed(plans):
                learner.take(play(plan, preset))
            learner.plan("game 0")
        assert_same(one.state(), other.state())


@pytest.mark.parametrize("preset", [SMALL, PAPER], ids=["imagining", "paper"])
def test_a_resumed_learner_drops_episodes_that_were_out_and_continues_identically(preset: Preset) -> None:
    learner = learner_of(BENT, preset)
    for _ in range(3):
        learner.take(play(learner.plan("game 0"), preset))
    lost = learner.plan("game 1")
    saved, journal = copied(learner.state()), learner.journal(None)
    resumed = learner_of(BENT, preset)
    resumed.load(saved, [journal])
    assert_same(resumed.state(), saved)
    assert not resumed.take(play(lost, preset))
    learner.abandon(lost.number)
    for each in (learner, resumed):
        finish(each, lambda plan: play(plan, preset))
    assert_same(resumed.state(), learner.state())
    assert resumed.episode_rows == learner.episode_rows
    assert resumed.evaluation_rows == learner.evaluation_rows


def test_a_policy_to_begin_from_is_evaluated_first_and_once() -> None:
    learner = learner_of(TWO, small_preset(4))
    learner.begin_from(learner.agent.online())
    first, second = learner.plan("game 0"), learner.plan("game 1")
    assert (first.greedy, second.greedy) == (True, False)
    assert learner.take(game_of(TWO, small_preset(4))(first))
    assert learner.evaluation_rows[0].episode == 0


@pytest.mark.parametrize(
    ("scenario", "preset", "what"),
    [
        (
            BENT,
            "tuned",
            r"\[excursions\] need the learner at every step: with several games take the preset model-based or",
        ),
        (STRIPES, "paper", r"stripes has parts, which several games can't learn together: train with one game"),
    ],
    ids=["excursions", "parts"],
)
def test_excursions_and_parts_are_refused_for_several_games_in_one_line(
    scenario: Scenario, preset: str, what: str
) -> None:
    with pytest.raises(PresetError, match=what) as caught:
        learner_of(scenario, load_preset(preset))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["nested", "hierarchical", "single"])
@pytest.mark.parametrize("seed", range(5))
def test_each_step_is_stored_for_the_agent_that_acted_and_the_choice_for_the_main_agent(name: str, seed: int) -> None:
    learner = learner_of(BENT, PAPER, agent=name, seed=seed)
    plan = learner.plan("game")
    played, agent = game_of(BENT, PAPER, name)(plan), learner.agent
    assert learner.take(played)

    replay, states = agent.low_level.replay, agent.low_level.states
    row = plan.material if name == "hierarchical" else 0
    assert replay.added.tolist() == [played.steps if at == row else 0 for at in range(states.rows)]
    held = replay.gather(np.array([row]), np.arange(played.steps)[None])
    materials = materials_of(agent, played, plan.material)
    seen = states.encoded(agent.low_level_states(played.observations, materials))
    np.testing.assert_array_equal(held.states[:, 0], [seen[:-1], seen[1:]])
    np.testing.assert_array_equal(held.actions[0], played.actions)
    np.testing.assert_array_equal(held.rewards[0], played.rewards)
    discounts = np.full(played.steps, PAPER.update.gamma, np.float32)
    discounts[-1] *= not played.terminated
    np.testing.assert_array_equal(held.discounts[0], discounts)
    if agent.main:
        chosen = agent.main.replay.gather(np.array([0]), np.array([[0]]))
        assert agent.main.replay.added.tolist() == [1]
        assert chosen.actions.tolist() == [[plan.material]]
        assert chosen.rewards.tolist() == [[played.score]]
        assert chosen.discounts.tolist() == [[0.0]]


def test_a_single_agents_materials_are_read_from_its_observations() -> None:
    learner = learner_of(BENT, PAPER, agent="single", seed=1)
    played = game_of(BENT, PAPER, "single")(learner.plan("game"))
    materials = materials_of(learner.agent, played, 0)
    assert materials[0] == -1
    assert materials.tolist() == (played.observations[:, -1] - 1).tolist()
