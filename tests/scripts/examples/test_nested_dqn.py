"""The paper's agents on one page: the page's rules, schedules and updates are the project's, and it learns.

What it scores beside the preset paper, with ten trials, is in docs/explanation/measured.md.
"""

import ast
import copy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from gymnasium.vector import VectorEnv
from hypothesis import given
from hypothesis import strategies as st
from torch import nn

from mc_nested.arena.action import Action
from mc_nested.arena.rules import PLACES, STEP
from mc_nested.arena.scenario_file import load_scenario, paper_scenarios
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.learn.exploration.schedules import decays_of, epsilon_after
from mc_nested.learn.preset import load_preset
from scripts.examples import nested_dqn
from scripts.examples.nested_dqn import Agent, Arenas, Learners, Settings, ddqn_target, train
from sim.grid import GridVectorEnv
from tests.scripts.examples.running import ROOT, run

PAGE = ROOT / "scripts" / "examples" / "nested_dqn.py"
ARENAS = 2
STEPS = st.lists(st.tuples(*[st.integers(0, 9)] * ARENAS), min_size=1, max_size=70)


def test_page_has_at_most_300_lines_and_imports_torch_gymnasium_and_numpy_alone() -> None:
    text = PAGE.read_text("utf-8")
    assert len(text.splitlines()) <= 300
    imports = [node for node in ast.walk(ast.parse(text)) if isinstance(node, (ast.Import, ast.ImportFrom))]
    names = [node.module or "" if isinstance(node, ast.ImportFrom) else node.names[0].name for node in imports]
    others = {name.split(".")[0] for name in names} - sys.stdlib_module_names
    assert others == {"torch", "gymnasium", "numpy"}


def test_designs_start_and_worth_are_those_of_the_papers_scenarios() -> None:
    assert set(nested_dqn.DESIGNS) == set(paper_scenarios())
    for name, cells in nested_dqn.DESIGNS.items():
        scenario = load_scenario(name)
        assert (frozenset(cells), len(cells)) == (scenario.design, scenario.blocks)
        facts = scenario.size, scenario.start, scenario.step_limit
        assert facts == (nested_dqn.SIZE, nested_dqn.START, nested_dqn.STEP_LIMIT)
        assert nested_dqn.WORTH.tolist() == [material.p for material in scenario.materials]


def test_actions_are_the_projects() -> None:
    assert [tuple(move) for move in nested_dqn.MOVES.tolist()] == [STEP[action] for action in Action]
    assert {action for action in Action if action >= nested_dqn.FIRST_TO_PLACE} == PLACES


def assert_both_play_alike(ours: Arenas, theirs: VectorEnv[Any, Any, Any], steps: list[tuple[int, ...]]) -> None:
    """Play the steps in both, beginning each arena's next episode, with the other material, where one ends."""
    material = np.arange(ARENAS)
    begins = np.ones(ARENAS, np.bool_)
    for step in steps:
        if begins.any():
            material = (material + begins) % 2
            options = {"reset_mask": begins, "material": material}
            assert ours.reset(options=options)[0].tolist() == theirs.reset(options=options)[0].tolist()
        taken = np.array(step) % (10 if ours.chooses else 8)
        seen, rewards, terminated, truncated, info = ours.step(taken)
        expected = theirs.step(taken)
        for part, wanted in zip((seen, rewards, terminated, truncated), expected[:4], strict=True):
            assert part.tolist() == wanted.tolist()
        begins = terminated | truncated
        assert info["score"][begins].tolist() == expected[4]["score"][begins].tolist()


@given(st.sampled_from(sorted(nested_dqn.DESIGNS)), STEPS)
def test_rules_are_the_projects_where_a_main_agent_chooses(name: str, steps: list[tuple[int, ...]]) -> None:
    assert_both_play_alike(Arenas(name, ARENAS), GridVectorEnv([load_scenario(name)] * ARENAS), steps)


@given(st.sampled_from(sorted(nested_dqn.DESIGNS)), STEPS)
def test_rules_are_the_projects_for_the_single_agent(name: str, steps: list[tuple[int, ...]]) -> None:
    scenarios = [load_scenario(name)] * ARENAS
    single = SingleAgentVectorEnv(GridVectorEnv(scenarios), scenarios)
    assert_both_play_alike(Arenas(name, ARENAS, chooses=True), single, steps)


def test_the_line_built_backward_ends_the_episode_with_the_optimum() -> None:
    arenas = Arenas("line", 1)
    arenas.reset()
    steps = [arenas.step(np.array([action])) for action in [Action.B] * 2 + [Action.BD] * 11]
    assert [bool(terminated[0]) for _, _, terminated, _, _ in steps] == [False] * 12 + [True]
    assert steps[-1][4]["score"] == [load_scenario("line").optimum]


def test_settings_are_the_preset_papers() -> None:
    preset, ours = load_preset("paper"), Settings()
    main, nested = decays_of(preset)
    assert (ours.episodes, ours.evaluate_every) == (preset.episodes, preset.evaluate_every)
    assert ((ours.hidden,) * 2, ours.replay) == (tuple(preset.hidden), preset.replay_capacity)
    update = preset.update
    assert (ours.batch, ours.batch, ours.learning_rate) == (update.batch, update.learning_starts, update.learning_rate)
    assert (ours.gamma, ours.target_period, update.huber_delta) == (update.gamma, update.target_period, 1.0)
    done = np.arange(0, 3001, 100)
    for floor, share, rule in ((ours.floor, ours.share, nested), (ours.main_floor, ours.main_share, main)):
        wanted = epsilon_after(done, 3000, rule)
        assert nested_dqn.epsilon_after(done, 3000, floor, share) == pytest.approx(wanted)


def test_target_is_what_the_target_network_says_of_the_online_networks_choice() -> None:
    """The online network chooses action 0, for which the target network says 5; plain DQN would take 9."""
    online, target = torch.tensor([[3.0, 2.0]] * 2), torch.tensor([[5.0, 9.0]] * 2)
    goals = ddqn_target(torch.tensor([[1.0], [1.0]]), torch.tensor([[0.0], [1.0]]), online, target, gamma=0.5)
    assert goals.tolist() == [[3.5], [1.0]]


def network_of(learners: Learners, parameters: torch.Tensor) -> nn.Sequential:
    """Return a row's parameters as the modules that everybody knows."""
    layers: list[nn.Module] = []
    for size, inputs, flat in zip(
        learners.widths[1:], learners.widths, parameters.split_with_sizes(learners.sizes), strict=False
    ):
        weights = flat.view(inputs + 1, size)
        layer = nn.Linear(inputs, size)
        layer.weight.data, layer.bias.data = weights[:-1].T.clone(), weights[-1].clone()
        layers += [layer, nn.Tanh()]
    return nn.Sequential(*layers[:-1])


def learners_with_one_transition(rows: int, **settings: Any) -> Learners:
    """Return learners whose every batch is the same: each row holds one transition, and its own."""
    random = torch.Generator().manual_seed(3)
    learners = Learners(rows, np.array([14, 14, 11]), 8, Settings(episodes=1, batch=1, **settings), random)
    states = np.array([[7, 14, 11]] * rows)
    following = states - [[row, 1, 0] for row in range(rows)]
    learners.store(torch.arange(rows), states, np.arange(rows), np.ones(rows), following, np.zeros(rows, np.bool_))
    return learners


def test_updates_are_torchs_adam_on_the_huber_loss_of_ddqn() -> None:
    learners = learners_with_one_transition(2, target_period=2)
    for row in range(2):
        online = network_of(learners, learners.online[row])
        target = copy.deepcopy(online)
        adam = torch.optim.Adam(online.parameters(), lr=1e-3)
        state, following = (
            torch.tensor([[2.0 * x / 14 - 1, 2.0 * y / 14 - 1, 1.0]]) for x, y in ((7, 14), (7 - row, 13))
        )
        for update in range(3):
            best = online(following).argmax(1)
            goal = (1 + 0.95 * target(following)[:, best[0]]).detach()
            adam.zero_grad()
            nn.functional.huber_loss(online(state)[:, row], goal).backward()  # type: ignore[no-untyped-call]  # torch's
            adam.step()
            learners.learn(torch.tensor([row]))
            if update == 1:
                target.load_state_dict(online.state_dict())
        tried = torch.rand(5, 3) * 2 - 1
        raw = (tried + 1) / 2 * learners.highest
        torch.testing.assert_close(learners.values(learners.online[row : row + 1], raw[None])[0], online(tried))
        torch.testing.assert_close(learners.values(learners.target[row : row + 1], raw[None])[0], target(tried))


def test_an_update_leaves_the_other_rows_as_they_are() -> None:
    learners = learners_with_one_transition(3)
    before = learners.online.clone()
    learners.learn(torch.tensor([1]))
    assert (learners.online != before).any(dim=1).tolist() == [False, True, False]


def test_a_row_learns_nothing_before_it_has_a_batch() -> None:
    learners = learners_with_one_transition(1)
    learners.settings = Settings(batch=2)
    learners.learn(torch.tensor([0]))
    assert learners.updates.tolist() == [0]


@pytest.mark.parametrize(("kind", "parameters"), [("nested", 2730), ("hierarchical", 4146), ("single", 1546)], ids=str)
def test_networks_of_an_agent_have_the_projects_number_of_parameters(kind: str, parameters: int) -> None:
    """docs/explanation/measured.md, claims (e1) and (e2)."""
    agent = Agent(Settings(agent=kind, episodes=1), Arenas("line", 1, kind == "single"))
    main = 0 if kind == "single" else agent.main.online.numel()
    assert main + agent.builder.online.numel() == parameters


def test_a_hierarchy_has_a_builder_for_each_material_and_only_nested_sees_the_choice() -> None:
    seen, materials = np.array([[7, 14, 11]] * 2), np.array([1, 0])
    for kind, rows, width in (("nested", [0, 1], 4), ("hierarchical", [1, 2], 3), ("single", [0, 1], 3)):
        agent = Agent(Settings(agent=kind, episodes=1), Arenas("line", 2, kind == "single"))
        assert agent.rows(materials).tolist() == rows
        assert agent.states(seen, materials).shape == (2, width)


@pytest.mark.parametrize("kind", ["nested", "hierarchical", "single"])
def test_a_seed_is_trained_the_same_again(kind: str) -> None:
    settings = Settings(agent=kind, trials=2, seed=4, episodes=6, evaluate_every=2, batch=8)
    (episodes, scores, agent), (_, again, other) = (train(settings) for _ in range(2))
    assert (episodes.tolist(), scores.shape) == ([2, 4, 6], (2, 3))
    assert (scores == again).all()
    assert torch.equal(agent.builder.online, other.builder.online)
    assert not torch.equal(agent.builder.online[0], agent.builder.online[1])


def test_updates_are_one_a_step_and_one_an_episode() -> None:
    _, _, agent = train(Settings(episodes=34, evaluate_every=34))
    steps, episodes = int(agent.builder.stored[0]), int(agent.main.stored[0])
    assert (episodes, agent.main.updates.tolist()) == (34, [34 - 31])
    assert agent.builder.updates.tolist() == [steps - 31]


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_page_learns_the_line_but_for_a_block_or_two_in_400_episodes() -> None:
    """Five trials end at 19.6 of 21; with γ 0 at 14.8, and untaught at 10."""
    _, scores, _ = train(Settings(trials=5, episodes=400))
    assert scores[:, -1].mean() >= 18.5


@pytest.mark.slow
def test_page_runs_in_an_empty_folder_and_ends_with_both_scores(tmp_path: Path) -> None:
    done = run("nested_dqn", tmp_path, "--trials", "2", "--episodes", "6", "--evaluate-every", "2")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert [line.split(":")[0] for line in lines] == ["2 episodes", "4 episodes", "6 episodes", "early", "final"]
    assert lines[-1].startswith("final: ")
    assert " ± " in lines[-1]


@pytest.mark.slow
@pytest.mark.parametrize("words", [["--design", "castle"], ["--trials", "0"], ["--episodes", "20"], ["--seed", "x"]])
def test_mistake_is_refused_with_exit_code_2(words: list[str], tmp_path: Path) -> None:
    done = run("nested_dqn", tmp_path, *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert "nested_dqn.py: error: " in done.stderr.splitlines()[-1]


def test_interval_of_ten_trials_reaches_2_26_standard_errors() -> None:
    values = np.arange(10.0)
    mean, reach = nested_dqn.interval(values)
    assert mean == 4.5
    assert reach == pytest.approx(2.262 * values.std(ddof=1) / 10**0.5, rel=0.01)
