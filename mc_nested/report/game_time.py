"""How long real episodes take in a running game, and how many of them a training should need."""

from dataclasses import dataclass

from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.learn.preset import Preset

ACTION_S = 0.35
"""Seconds of game time of an action: what `scripts/bench.py live` asks of the median, and README counts with."""

RESET_S = 1.5
"""Seconds of game time of a reset: 1.1 to 1.6 on the virtual client (`scripts/bench.py live`, 300 actions
on the line and on the diamond: the time played beside the actions, a reset)."""


def minutes_of(episodes: int, steps: int) -> float:
    """Return minutes of game time of so many episodes with so many actions in all."""
    return (steps * ACTION_S + episodes * RESET_S) / 60


def episodes_without_a_prior(blocks: int, size: int = DEFAULT_SIZE) -> float:
    """Return how many episodes a design of so many blocks should take if every cell is equally likely.

    The blocks stand on n of the N = size x (size - 1) cells where one can land. Tested in any order, the last of them
    is expected at test (N + 1) n / (n + 1). An episode tests n cells, and one more builds them all.
    """
    cells = size * (size - 1)
    return (cells + 1) / (blocks + 1) + 1


@dataclass(frozen=True)
class Expected:
    """What a live training is expected to take.

    ``episodes`` are real ones, the greedy ones included; ``is_a_limit``: it may end before, at the optimum.
    """

    episodes: int
    minutes: float
    is_a_limit: bool

    def line(self, scenario: Scenario) -> str:
        """Return one line for the person who waits."""
        about = "at most about" if self.is_a_limit else "about"
        return (
            f"expected: {about} {self.minutes:.0f} minutes of game time, {self.episodes} episodes of up to "
            f"{scenario.step_limit} actions of {ACTION_S:g} s and a reset of {RESET_S:g} s"
        )


def expected(preset: Preset, scenario: Scenario, *, stop_at_optimum: bool) -> Expected:
    """Return how long a training from scratch should take in a running game, every episode as long as it may be.

    All its episodes are played, or with ``stop_at_optimum`` up to all. With [imagination] it ends then by as many as
    finding a design of so many blocks takes without any prior, if the preset has so many.
    """
    every = preset.episodes
    if preset.imagination is not None:
        episodes = every + 1
        if stop_at_optimum:
            episodes = min(episodes, round(episodes_without_a_prior(scenario.blocks, scenario.size)))
    else:
        episodes = every + -(-every // preset.evaluate_every)
    minutes = minutes_of(episodes, episodes * scenario.step_limit)
    return Expected(episodes, minutes, is_a_limit=stop_at_optimum and preset.imagination is None)
