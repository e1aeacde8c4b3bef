"""A live game that fails: the simulator's behind the live path's door, with a grey window.

What the live path does to a window is left to tests/live.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import sim.worlds
from mc_nested.arena.action import Action
from mc_nested.arena.game import Following, Outcome, Resumable
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError, McNestedError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.session import Opening
from sim.grid import GridGame


class FragileGame(GridGame):
    """A live game that fails at its action number ``lasts``, and ever after, or only ``failures`` times."""

    def __init__(self, scenario: Scenario, lasts: float, error: McNestedError, failures: float) -> None:
        super().__init__(scenario)
        self._left = lasts
        self._error = error
        self._failures = failures

    @property
    def resumable(self) -> Resumable | None:
        return None

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        self._left -= 1
        if self._left < 0 < self._failures:
            self._failures -= 1
            raise self._error
        return super().act(action, material, following)


class GreyDisplay:
    """A window that is grey all over."""

    def size(self) -> tuple[int, int]:
        return 4, 3

    def title(self) -> str:
        return "Minecraft 1.20.1"

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        return np.full((3, 4, 3), 99, np.uint8)


def open_live(
    monkeypatch: pytest.MonkeyPatch, lasts: float, error: McNestedError | None = None, failures: float = float("inf")
) -> None:
    """Make every live game from here on one that lasts so many actions."""

    @contextmanager
    def opened(scenario: Scenario, opening: Opening) -> Iterator[tuple[FragileGame, GreyDisplay]]:
        assert opening.profile == "mine"
        assert not opening.is_server_allowed
        yield FragileGame(scenario, lasts, error or LiveError("never raised"), failures), GreyDisplay()

    monkeypatch.setattr(sim.worlds, "open_live_game", opened)
