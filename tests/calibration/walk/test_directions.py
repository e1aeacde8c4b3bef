"""Which key goes which way, from where a step with each of them ended."""

import itertools

import pytest

from calibration.walk.directions import DIRECTIONS, Direction, corrected_keys, describe_keys, direction_of
from mc_nested.errors import UserError
from mc_nested.live.profile.tables import KeysTable

KEYS = KeysTable()


@pytest.mark.parametrize(
    ("offset", "way"),
    [
        ((0.0, 0.32), "forward"),
        ((0.02, -0.32), "back"),
        ((0.32, 0.05), "right"),
        ((-0.32, 0.0), "left"),
        ((0.2, 0.2), None),
        ((0.0, 0.05), None),
        ((0.0, 0.0), None),
    ],
)
def test_a_step_leads_one_way_or_none(offset: tuple[float, float], way: Direction | None) -> None:
    assert direction_of(offset) == way


def test_whatever_the_four_keys_do_each_ends_at_its_own_way() -> None:
    for led in itertools.permutations(DIRECTIONS):
        keys = corrected_keys(KEYS, dict(zip(DIRECTIONS, led, strict=True)))
        for way, found in zip(DIRECTIONS, led, strict=True):
            assert getattr(keys, found) == getattr(KEYS, way)


def test_swapped_sides_are_said() -> None:
    keys = corrected_keys(KEYS, {"forward": "forward", "back": "back", "left": "right", "right": "left"})
    assert (keys.left, keys.right, keys.forward, keys.sneak) == ("d", "a", "w", "left.shift")
    assert describe_keys(KEYS, keys).endswith("the profile had left and right the other way round")
    assert describe_keys(KEYS, KEYS) == "w goes forward, s goes back, a goes left, d goes right"


def test_a_key_without_effect_and_two_that_go_the_same_way_are_mistakes() -> None:
    with pytest.raises(UserError, match="the key a doesn't move the player left"):
        corrected_keys(KEYS, {"forward": "forward", "back": "back", "left": None, "right": "right"})
    with pytest.raises(UserError, match="don't go four ways"):
        corrected_keys(KEYS, {"forward": "forward", "back": "forward", "left": "left", "right": "right"})
