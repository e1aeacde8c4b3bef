"""stable-baselines3's model: the library is asked for only where it is used, and its absence is one line."""

import sys

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.experiments import sb3_model
from mc_nested.learn.experiments.benchmark import baseline
from mc_nested.learn.experiments.sb3_env import Sb3Env
from mc_nested.learn.experiments.sb3_model import Sb3Dqn
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import DOT


def test_without_the_library_it_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sb3_model, "is_installed", lambda: False)
    with pytest.raises(RunError, match=r"stable-baselines3 isn't installed: pip install .*\[bench\]"):
        Sb3Dqn(Sb3Env(GridVectorEnv([DOT]), [DOT]), baseline().preset, 100, 0)
    assert "stable_baselines3" not in sys.modules
