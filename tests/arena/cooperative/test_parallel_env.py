"""The team as a PettingZoo environment: PettingZoo's own tests, what is observed, and where it is missing."""

import subprocess
import sys

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Box

from mc_nested.arena.action import Action
from mc_nested.errors import ScenarioError
from sim.cooperative_env import cooperative_env

test = pytest.importorskip("pettingzoo.test")
F, B, L, R, FD, LD, RD, BD = Action


@pytest.mark.parametrize("builders", [1, 2, 3, 4])
def test_pettingzoos_tests_pass(builders: int) -> None:
    test.parallel_api_test(cooperative_env("line", builders), num_cycles=200)
    test.parallel_seed_test(lambda: cooperative_env("line", builders), num_cycles=200)


def test_each_agent_observes_its_cell_the_blocks_left_and_its_number() -> None:
    env = cooperative_env("line", starts=((7, 12), (3, 3)))
    observations, infos = env.reset(options={"material": "wood"})
    assert {agent: seen.tolist() for agent, seen in observations.items()} == {
        "builder_0": [7, 12, 11, 0],
        "builder_1": [3, 3, 11, 1],
    }
    assert infos["builder_1"] == {"material": "wood"}
    observations, rewards, _, _, _ = env.step({"builder_0": BD, "builder_1": L})
    assert observations["builder_1"].tolist() == [2, 3, 10, 1]
    assert rewards == {"builder_0": 1.0, "builder_1": 0.0}
    space = env.observation_space("builder_1")
    assert isinstance(space, Box)
    assert space.high.tolist() == [14, 14, 11, 1]


def test_all_agents_end_at_the_same_tick_with_the_teams_score() -> None:
    env = cooperative_env("line", 2)
    env.reset()
    for _ in range(59):
        env.step({"builder_0": F, "builder_1": F})
    _, _, terminated, truncated, infos = env.step({"builder_0": F, "builder_1": F})
    assert (list(terminated.values()), list(truncated.values())) == ([False, False], [True, True])
    assert [info["score"] for info in infos.values()] == [10.0, 10.0]
    assert env.agents == []
    with pytest.raises(ResetNeeded):
        env.step({})


def test_the_arena_is_drawn_as_a_picture_or_as_text() -> None:
    env = cooperative_env("line", 2, render_mode="ansi")
    env.reset()
    assert env.render().splitlines()[0].split()[7::7] == ["0", "1"]
    pictured = cooperative_env("line", 2, render_mode="rgb_array")
    pictured.reset()
    assert pictured.render().dtype == np.uint8


def test_an_unknown_material_is_refused_in_one_line() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold'"):
        cooperative_env("line", 2).reset(options={"material": "gold"})


def test_only_the_cooperative_env_needs_pettingzoo_and_names_the_command_to_install_pettingzoo() -> None:
    program = (
        "import sys; sys.modules['pettingzoo'] = None\n"
        "import mc_nested, mc_nested.arena.cooperative, sim.team_grid\n"
        "from mc_nested.errors import UserError\n"
        "try:\n    import sim.cooperative_env\n"
        "except UserError as error:\n    print(error)\n"
    )
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert said == (
        "several builders as a PettingZoo environment need pettingzoo: "
        "install mc-nested again with its extra, as '.[pettingzoo]' (docs/how-to/install.md)\n"
    )
