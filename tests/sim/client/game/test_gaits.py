from collections.abc import Sequence

import pytest

from sim.client.game.edition import Edition
from sim.client.game.gaits import SPRINT_WINDOW, Gaits
from sim.client.game.physics import Gait


def gaits_of(keys: Sequence[str], version: str = "1.20.1", may_sprint: bool = True) -> list[Gait]:
    """The gaits of ticks in which these keys are down: any of w and s (for sneak)."""
    gaits = Gaits(Edition(version))
    return [gaits.tick(is_forward="w" in down, sneaks="s" in down, may_sprint=may_sprint) for down in keys]


def twice(apart: int) -> list[str]:
    """Forward down in tick 0, and in two ticks from ``apart`` on."""
    return ["w", *[""] * (apart - 1), "w", "w"]


@pytest.mark.parametrize("apart", range(2, SPRINT_WINDOW))
def test_a_second_press_within_the_window_sprints_until_it_ends(apart: int) -> None:
    assert gaits_of([*twice(apart), "", "w"])[apart:] == [
        "sprint",
        "sprint",
        "walk",
        "walk" if apart >= 4 else "sprint",
    ]


def test_a_second_press_after_the_window_walks() -> None:
    assert set(gaits_of(twice(SPRINT_WINDOW))) == {"walk"}


def test_one_long_press_never_sprints() -> None:
    assert set(gaits_of(["w"] * 20)) == {"walk"}


def test_whoever_may_not_sprint_walks() -> None:
    assert set(gaits_of(twice(3), may_sprint=False)) == {"walk"}


def test_a_tick_of_sneaking_between_two_presses_keeps_them_apart() -> None:
    assert gaits_of(["w", "s", "", "w"]) == ["walk", "walk", "sneak", "walk"]


def test_from_1_15_on_sneaking_slows_down_a_tick_after_its_key() -> None:
    keys = ["ws", "ws", "ws", "w"]
    assert gaits_of(keys, "1.15") == ["walk", "sneak", "sneak", "sneak"]
    assert gaits_of(keys, "1.14.4") == ["sneak", "sneak", "sneak", "walk"]
