"""The effect of each part of [imagination] that an ablation turns off."""

import numpy as np
import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Int64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.beliefs import Belief, believe, evidence_of
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR
from tests.learn.made_trainings import finish

LANDS = (0, 1)
SIZE, BLOCKS = 5, 3


def steps_that_placed(cells: dict[tuple[int, int], int]) -> Int64s:
    """Return a transition for each cell, whose block landed there and was paid so much."""
    rows = [
        [x, y - 1, BLOCKS - at, 4, x, y - 1, BLOCKS - at - 1, paid, 0]
        for at, ((x, y), paid) in enumerate(cells.items())
    ]
    return np.array(rows, dtype=np.int64)


def test_every_unknown_cell_pays_the_same_without_neighbours() -> None:
    steps = steps_that_placed({(2, 2): 1, (0, 4): 0})
    with_them = believe(evidence_of(steps, LANDS, SIZE), LANDS, BLOCKS)
    assert with_them.pay[2, 3] > with_them.pay[4, 4]
    without = believe(evidence_of(steps, LANDS, SIZE), LANDS, BLOCKS, neighbours=False)
    unknown = without.cells == Belief.UNKNOWN
    assert not (without.cells == Belief.BELIEVED).any()
    assert set(without.pay[unknown][without.pay[unknown] > 0]) == {1.0}
    assert without.pay[4, 4] == without.pay[2, 3] == 1.0


def test_only_cells_known_to_pay_are_paid_without_optimism() -> None:
    beliefs = believe(
        evidence_of(steps_that_placed({(2, 2): 1, (0, 4): 0}), LANDS, SIZE),
        LANDS,
        BLOCKS,
        optimism=False,
        neighbours=False,
    )
    assert beliefs.explores
    assert np.argwhere(beliefs.pay).tolist() == [[2, 2]]
    assert beliefs.most == 1.0


def live_with(updates: int = 400, **changes: object) -> Preset:
    """Return the preset model-based with a short practice, and keys of its [imagination] changed."""
    live = load_preset("model-based")
    assert live.imagination is not None
    rule = live.imagination.model_copy(update={"updates_exploring": updates, "updates_building": updates, **changes})
    update = live.update.model_copy(update={"learning_starts": 50, "target_period": 20})
    return live.model_copy(update={"imagination": rule, "update": update, "hidden": [8, 8], "episodes": 3})


def trained(preset: Preset, scenario: Scenario = BAR) -> Agent:
    agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed=1)
    finish(Trainer(GridVectorEnv([scenario]), [scenario], agent, preset, seed=1))
    return agent


@pytest.mark.parametrize("part", ["double", "real_transitions"])
def test_turning_off_double_or_real_transitions_changes_the_learnt_networks(part: str) -> None:
    usual, again, without = (
        trained(live_with(**changes)).low_level.engine.online for changes in ({}, {part: True}, {part: False})
    )
    assert (usual == again).all()
    assert not np.allclose(usual, without)
