"""The paper's agents: who acts, and what is appended to whose state (paper, sections 4.1 and 5.1).

Nested: a main agent chooses the material once, on (x, y, b); the nested agent does the rest on (x, y, b, a_M), the main
action appended to its state, so that one network serves every material.
"""

from collections.abc import Sequence

import numpy as np
import torch

from mc_nested.arena.rules import SIZE, Action
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.checkpoint import part_of
from mc_nested.learn.learner import Ints, Learner, StateSpace
from mc_nested.learn.networks import parameter_count
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import initial_stream

AGENTS = ("nested",)
"""Names of the agents that can be trained."""


class NestedAgent:
    """The main and the nested agent in R runs, one scenario a run.

    Args:
        scenarios: each run's scenario; all with the same number of materials.
        preset: the hyper-parameters of both.
        seed: of the initial parameters.
    """

    def __init__(self, scenarios: Sequence[Scenario], preset: Preset, seed: int) -> None:
        streams = [initial_stream(seed, run) for run in range(len(scenarios))]
        materials = len(scenarios[0].materials)
        observed = np.array([[SIZE - 1, SIZE - 1, scenario.blocks] for scenario in scenarios])
        main_action = np.full((len(scenarios), 1), materials - 1)
        self.main = Learner(StateSpace(observed, materials), preset, streams)
        self.nested = Learner(StateSpace(np.hstack([observed, main_action]), len(Action)), preset, streams)

    @staticmethod
    def nested_states(observations: Ints, materials: Ints) -> Ints:
        """s_N = [s_M, a_M] (paper, section 4.1): (runs, 4)."""
        return np.concatenate((observations, materials[:, None]), axis=1)

    @property
    def networks(self) -> int:
        """Networks that one run trains."""
        return 2

    @property
    def parameters(self) -> int:
        """Parameters of one run's networks, target networks not counted."""
        return parameter_count(self.main.ddqn.sizes) + parameter_count(self.nested.ddqn.sizes)

    @property
    def updates(self) -> int:
        """Updates done, over all runs and both agents."""
        return int(self.main.ddqn.updates.sum() + self.nested.ddqn.updates.sum())

    def state(self) -> dict[str, torch.Tensor]:
        """Everything later choices and updates depend on, by name."""
        return {
            f"{role}.{name}": kept for role, learner in self._roles().items() for name, kept in learner.state().items()
        }

    def load(self, state: dict[str, torch.Tensor]) -> None:
        """Go on from what ``state`` gave; KeyError, ValueError or RuntimeError where it is of another shape."""
        for role, learner in self._roles().items():
            learner.load(part_of(state, role))

    def load_networks(self, state: dict[str, torch.Tensor]) -> None:
        """Take over the networks alone: enough to act."""
        for role, learner in self._roles().items():
            learner.load_networks(part_of(state, role))

    def _roles(self) -> dict[str, Learner]:
        return {"main": self.main, "nested": self.nested}
