"""The single agent's task as stable-baselines3 takes it."""

from gymnasium.spaces import Discrete, MultiDiscrete

from mc_nested.arena.builder import build
from mc_nested.learn.experiments.sb3_env import Sb3Env
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT


def env() -> Sb3Env:
    return Sb3Env(GridVectorEnv([BAR]), [BAR])


def test_its_spaces_are_the_ten_actions_and_a_value_each_of_x_y_b_and_m() -> None:
    assert env().action_space == Discrete(10)
    assert env().observation_space == MultiDiscrete([15, 15, 4, 3])
    assert env().observation_space.contains(env().reset()[0])


def test_the_builder_earns_the_optimum() -> None:
    own = env()
    observation, _ = own.reset()
    assert observation.tolist() == [*BAR.start, 3, 0]
    earned = []
    for action in [1, *(2 + int(action) for action in build(BAR))]:
        observation, reward, terminated, truncated, info = own.step(action)
        assert own.observation_space.contains(observation)
        earned.append(reward)
    assert (terminated, truncated) == (True, False)
    assert info == {"score": BAR.optimum}
    assert sum(earned) == BAR.optimum
    assert (own.episodes, own.steps) == (1, 1 + len(build(BAR)))


def test_a_first_action_that_is_no_material_ends_the_episode_with_nothing() -> None:
    own = Sb3Env(GridVectorEnv([DOT]), [DOT])
    own.reset()
    _, reward, terminated, _, info = own.step(5)
    assert (reward, terminated, info) == (0.0, True, {"score": 0.0})


def test_a_long_episode_is_truncated() -> None:
    own = env()
    own.reset()
    flags = [own.step(1)[2:4] for _ in range(BAR.step_limit)]
    assert flags[-1] == (False, True)
    assert not any(truncated for _, truncated in flags[:-1])
