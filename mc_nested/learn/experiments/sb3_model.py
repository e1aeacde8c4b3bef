"""stable-baselines3's DQN with a preset's hyper-parameters, one environment step at a time."""

import importlib.util

import gymnasium
import numpy as np

from mc_nested.arrays import Int64s
from mc_nested.errors import RunError
from mc_nested.learn.preset import Preset

LIBRARY = "stable-baselines3"

HOW_TO_INSTALL = "pip install -c constraints.txt -e '.[bench]'"


def is_installed() -> bool:
    """Whether the library is installed."""
    return importlib.util.find_spec("stable_baselines3") is not None


class Sb3Dqn:
    """The model; it learns on its own Env, and its random numbers are the process's global ones.

    So nothing else may draw from those while it learns.

    Args:
        env: where it learns.
        preset: the hyper-parameters of its network, replay and update.
        capacity: transitions that its replay keeps.
        seed: of all its random choices.

    Raises:
        RunError: the library isn't installed.
    """

    def __init__(self, env: gymnasium.Env[Int64s, np.int64], preset: Preset, capacity: int, seed: int) -> None:
        if not is_installed():
            raise RunError(f"{LIBRARY} isn't installed: {HOW_TO_INSTALL}")
        from stable_baselines3 import DQN
        from stable_baselines3.common.logger import Logger
        from torch.nn import Tanh

        update = preset.update
        self._model = DQN(
            "MlpPolicy",
            env,
            learning_rate=update.learning_rate,
            buffer_size=capacity,
            learning_starts=update.learning_starts,
            batch_size=update.batch,
            gamma=update.gamma,
            train_freq=1,
            gradient_steps=1,
            target_update_interval=update.target_period,
            policy_kwargs={"net_arch": preset.hidden, "activation_fn": Tanh},
            seed=seed,
            device="cpu",
        )
        self._model.set_logger(Logger(folder=None, output_formats=[]))  # its own makes a folder at each call of learn

    @property
    def updates(self) -> int:
        """Updates so far."""
        return int(self._model._n_updates)

    @property
    def parameters(self) -> int:
        """Parameters of the online network."""
        return sum(parameter.numel() for parameter in self._model.q_net.parameters())

    def learn_a_step(self, epsilon: float) -> None:
        """One ε-greedy step in its Env, and one update; a new episode begins by itself after one has ended."""
        self._model.exploration_rate = epsilon
        self._model.exploration_schedule = lambda _: epsilon  # its own falls with steps, of which none knows the total
        self._model.learn(1, reset_num_timesteps=False)

    def greedy(self, observation: Int64s) -> int:
        """The greedy action."""
        action, _ = self._model.predict(observation, deterministic=True)
        return int(action)
