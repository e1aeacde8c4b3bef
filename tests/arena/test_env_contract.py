"""The contract suite of Envs: the simulator's passes it, and Envs that return something else don't."""

from typing import Any

import numpy as np
import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from sim.grid import GridGame
from tests.arena.env_contract import check_env_contract
from tests.arena.game_contract import BUMPS

LINE = load_scenario("line")
Step = tuple[Any, float, bool, bool, dict[str, Any]]


class PaysForEveryBlock(ArenaEnv):
    def step(self, action: np.int64 | int) -> Step:
        observation, _, terminated, truncated, info = super().step(action)
        return observation, float("placed" in info), terminated, truncated, info


class NeverEnds(ArenaEnv):
    def step(self, action: np.int64 | int) -> Step:
        self._running = True
        observation, reward, *_, info = super().step(action)
        return observation, reward, False, False, info


class TerminatesAtTheLimit(ArenaEnv):
    def step(self, action: np.int64 | int) -> Step:
        observation, reward, terminated, truncated, info = super().step(action)
        return observation, reward, terminated or truncated, False, info


class TellsTheScoreEarly(ArenaEnv):
    def step(self, action: np.int64 | int) -> Step:
        observation, reward, terminated, truncated, info = super().step(action)
        return observation, reward, terminated, truncated, {"score": 10.0, **info}


class IgnoresTheMaterial(ArenaEnv):
    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        return super().reset(seed=seed, options={**(options or {}), "material": None})


class ShowsBlocksBuilt(ArenaEnv):
    def step(self, action: np.int64 | int) -> Step:
        observation, reward, terminated, truncated, info = super().step(action)
        observation[2] = len(self.placed)
        return observation, reward, terminated, truncated, info


class ShowsFloats(ArenaEnv):
    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        observation, info = super().reset(seed=seed, options=options)
        return observation.astype(np.float64), info


def test_the_simulators_env_passes_the_contract() -> None:
    check_env_contract(ArenaEnv(GridGame(LINE), LINE), LINE, BUMPS)


LIARS = [PaysForEveryBlock, NeverEnds, TerminatesAtTheLimit, TellsTheScoreEarly, IgnoresTheMaterial, ShowsBlocksBuilt]


@pytest.mark.parametrize("liar", [*LIARS, ShowsFloats])
def test_an_env_with_wrong_returns_fails_the_contract(liar: type[ArenaEnv]) -> None:
    with pytest.raises((AssertionError, pytest.fail.Exception)):
        check_env_contract(liar(GridGame(LINE), LINE), LINE, BUMPS)
