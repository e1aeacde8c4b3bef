"""Waiting for a person: until the game is in front, its debug screen can be read, and the player stands still."""

from collections.abc import Callable

from mc_nested.errors import NotInFrontError, UnreadableError
from mc_nested.live.devices import Clock, Display
from mc_nested.live.reading import Reading

PATIENCE_S = 60.0
"""How long the player has to switch to the game and turn the debug screen on."""

LOOK_S = 0.25
"""Between two looks: a few frames of the game, so that the same place seen twice is a place stood on."""


def wait_for_front(display: Display, clock: Clock) -> None:
    """Return as soon as the game is in front; NotInFrontError where that took too long."""
    end = clock.now() + PATIENCE_S
    while not display.is_in_front():
        if clock.now() >= end:
            raise NotInFrontError("the game's window didn't come to the front: click on it, and run this again")
        clock.sleep_until(clock.now() + LOOK_S)


def read_at_rest(display: Display, clock: Clock, read: Callable[[], Reading]) -> Reading:
    """The first reading that is seen twice in a row while the game is in front.

    Raises:
        NotInFrontError: the game was not in front when time ran out.
        UnreadableError: it was, but the debug screen could not be read, or the player kept moving.
    """
    end = clock.now() + PATIENCE_S
    before: Reading | None = None
    problem: str | None = None
    while clock.now() < end:
        in_front = display.is_in_front()
        reading = read() if in_front else None
        if reading is not None and reading.problem is None and reading == before:
            return reading
        before = reading
        problem = (reading.problem or "the player keeps moving") if reading else None
        clock.sleep_until(clock.now() + LOOK_S)
    if problem is None:
        raise NotInFrontError("the game's window didn't come to the front: click on it, and run this again")
    raise UnreadableError(f"the debug screen can't be read ({problem}): mend that, and run this again")
