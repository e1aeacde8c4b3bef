"""The agent with objectives where it isn't told the design: it finds it, and builds it, without an update."""

from collections.abc import Sequence
from dataclasses import replace
from statistics import median
from typing import Any

import pytest

from mc_nested.arena.design import random_scenario
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.learnt_game import given_facts_of
from mc_nested.learn.objectives.weights import shipped_weights
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.unknown_design import EPISODES, UnknownDesigns, playing
from sim.grid import GridVectorEnv
from tests.arena.made_games import TakesAtItsWord
from tests.learn.made_trainings import StartsOver, assert_same, finish, saved, ticked

LINE = load_scenario("line")


def player_of(scenarios: Sequence[Scenario]) -> UnknownDesigns:
    return UnknownDesigns(shipped_weights(), given_facts_of(scenarios))


def trainer_of(*scenarios: Scenario, env: Any = None, stops: bool = True, episodes: int = EPISODES) -> Trainer:
    preset = playing(load_preset("any-design")).model_copy(update={"episodes": episodes})
    arenas = GridVectorEnv(scenarios) if env is None else env
    return Trainer(arenas, scenarios, player_of(scenarios), preset, 0, stops)


def played(trainer: Trainer) -> int:
    return len(trainer.episode_rows) + len(trainer.evaluation_rows)


@pytest.fixture(scope="module")
def found() -> Trainer:
    return finish(trainer_of(LINE))


@pytest.mark.parametrize(("name", "at_most"), [("line", 7), ("diamond", 8), ("islands", 14)])
def test_a_design_that_nobody_tells_is_found_and_built_within_a_few_episodes(name: str, at_most: int) -> None:
    scenario = load_scenario(name)
    trainer = finish(trainer_of(scenario))
    assert trainer.evaluation_rows[-1].score == scenario.optimum
    assert played(trainer) <= at_most
    assert trainer.agent.updates == 0


def test_it_is_evaluated_only_once_it_knows_the_whole_design(found: Trainer) -> None:
    assert [row.score for row in found.evaluation_rows] == [LINE.optimum]
    assert {(row.epsilon_main, row.epsilon_nested) for row in found.episode_rows} == {(0.0, 0.0)}


def test_each_material_is_tried_once_and_then_the_best_is_taken(found: Trainer) -> None:
    chosen = [row.material for row in found.episode_rows]
    assert sorted(chosen[:2]) == [0, 1]
    assert set(chosen[2:]) == {LINE.best_material}


def test_nothing_of_the_design_but_its_number_of_blocks_is_known_before_a_block_pays() -> None:
    rows = [replace(LINE, design=frozenset((x, y) for x in range(LINE.blocks))) for y in (1, 3)]
    known = [ticked(trainer_of(each), 12).practice.known for each in rows]
    seen = [each.known_arena(0) for each in known if each]
    assert [each.known_to_pay for each in seen] == [0, 0]
    assert seen[0].built_last == seen[1].built_last != frozenset()


def test_a_run_is_the_same_again_and_in_a_batch(found: Trainer) -> None:
    assert_same(finish(trainer_of(LINE)), found)
    both = finish(trainer_of(LINE, replace(LINE, name="other")))
    for run in (0, 1):
        assert [row[1:] for row in both.episode_rows if row.trial == run] == [row[1:] for row in found.episode_rows]


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.9])
def test_a_resumed_run_continues_to_the_bit(found: Trainer, share: float) -> None:
    first = ticked(trainer_of(LINE), int(share * found.ticks))
    assert not first.finished
    resumed = trainer_of(LINE)
    resumed.load(*saved(first))
    assert_same(finish(resumed), found)


def test_an_episode_ended_by_a_mishap_leaves_no_trace(found: Trainer) -> None:
    game = StartsOver(LINE)
    trainer = trainer_of(LINE, env=ArenaVectorEnv([ArenaEnv(game, LINE)]))
    while played(trainer) < 2:
        trainer.tick()
    game.acts_left = 9
    with pytest.raises(ConnectionError):
        finish(trainer)
    trainer.abandon_episodes()
    finish(trainer)
    assert trainer.episode_rows == found.episode_rows
    assert trainer.evaluation_rows == found.evaluation_rows


def test_what_it_announces_is_kept_and_all_that_no_pay_decides_is_announced(found: Trainer) -> None:
    game = TakesAtItsWord(LINE)
    trainer = finish(trainer_of(LINE, env=ArenaVectorEnv([ArenaEnv(game, LINE)])))
    assert trainer.episode_rows == found.episode_rows
    # An episode's first action follows nothing. While cells are to be found, neither does one after a block, but for
    # the last block, after which there is none; the greedy episode is announced whole.
    explored = len(trainer.episode_rows)
    assert game.kept >= game.acts - game.episodes - explored * (LINE.blocks - 1)
    assert game.kept >= trainer.evaluation_rows[0].steps - 1


def test_the_policy_that_is_kept_builds_what_was_found(found: Trainer) -> None:
    alone = player_of([LINE])
    kept = found.policies
    alone.load_online({role: kept[role][rows] for role, rows in found.agent.rows_of(0).items()})
    played_again = play_greedily(GridVectorEnv([LINE]), [LINE], alone)[0]
    assert (played_again.score, played_again.material) == (LINE.optimum, LINE.best_material)
    assert len(played_again.actions) == found.evaluation_rows[-1].steps


def test_no_cell_is_tried_twice_while_others_are_unknown() -> None:
    one = replace(LINE, design=frozenset({(0, 1)}))
    seen = finish(trainer_of(one, episodes=20)).practice.known
    assert seen
    assert [(each.new, each.other) for each in seen.known_arena(0).episodes[:20]] == [(1, 0)] * 20


@pytest.mark.slow
def test_the_first_ten_random_designs_of_the_benchmark_are_found_in_twelve_episodes_or_fewer() -> None:
    episodes = []
    for number in range(10):
        scenario = random_scenario(2026, number, like=LINE)
        trainer = finish(trainer_of(scenario))
        assert trainer.evaluation_rows[-1].score == scenario.optimum, scenario.name
        episodes.append(played(trainer))
    assert median(episodes) <= 12
    assert max(episodes) <= 44


@pytest.mark.slow
def test_a_design_of_a_hundred_blocks_is_found_within_five_episodes() -> None:
    square = load_scenario("square")
    trainer = finish(trainer_of(square))
    assert trainer.evaluation_rows[-1].score == square.optimum
    assert played(trainer) <= 5
