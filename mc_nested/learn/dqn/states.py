"""States: what a learner's rows see and do, as a replay keeps it. Numbered (state_space.py), or planes."""

from typing import Any, NamedTuple, Protocol

from numpy.typing import NDArray


class States(Protocol):
    """What the rows of a learner see and do."""

    @property
    def rows(self) -> int:
        """How many rows there are."""

    @property
    def actions(self) -> int:
        """How many actions there are."""

    @property
    def highest(self) -> int:
        """The highest number that a replay keeps of a state; the lowest is 0."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of what a replay keeps of one state; () for a single number."""

    def kept(self, states: NDArray[Any]) -> NDArray[Any]:
        """What a replay keeps of the states (…): (…, *shape), whole numbers."""


class PlaneStates(NamedTuple):
    """Planes of whole numbers from 0 to 255, kept as they are.

    Args:
        rows: how many rows there are.
        actions: how many actions there are.
        shape: (planes, height, width).
    """

    rows: int
    actions: int
    shape: tuple[int, ...]

    @property
    def highest(self) -> int:
        return 255

    def kept(self, states: NDArray[Any]) -> NDArray[Any]:
        return states
