"""stable-baselines3's model: it learns a step at a time; the library is asked for only where it is used."""

import sys

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.experiments import sb3_model
from mc_nested.learn.experiments.benchmark import baseline
from mc_nested.learn.experiments.sb3_env import Sb3Env
from mc_nested.learn.experiments.sb3_model import Sb3Dqn
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT


def test_without_the_library_it_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sb3_model, "is_installed", lambda: False)
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)  # importing it would raise another error
    with pytest.raises(RunError, match=r"stable-baselines3 isn't installed: pip install .*\[bench\]"):
        Sb3Dqn(Sb3Env(GridVectorEnv([DOT]), [DOT]), baseline().preset, 100, 0)


@pytest.mark.slow
def test_the_library_learns_a_step_at_a_time_and_chooses_greedily() -> None:
    preset = baseline().preset
    env = Sb3Env(GridVectorEnv([BAR]), [BAR])
    model = Sb3Dqn(env, preset, capacity=1000, seed=3)
    steps = preset.update.learning_starts + 20
    for _ in range(steps):
        model.learn_a_step(epsilon=1.0)
    assert 19 <= model.updates <= 20
    assert env.episodes > 0
    inputs, hidden = 15 + 15 + (BAR.blocks + 1) + (len(BAR.materials) + 1), preset.hidden[0]
    assert model.parameters == (inputs + 1) * hidden + (hidden + 1) * hidden + (hidden + 1) * 10
    choices = {model.greedy(env.reset()[0]) for _ in range(3)}
    assert len(choices) == 1
