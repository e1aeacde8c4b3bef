import pytest

from mc_nested.live.model.keys import check_key
from sim.client.game.keys import BINDINGS
from sim.window.input_events import PLACES, symbol_at


@pytest.mark.parametrize(
    ("number", "name"),
    [(87, "w"), (32, "space"), (340, "left.shift"), (292, "f3"), (301, "f12"), (47, "/"), (49, "1"), (256, "esc")],
)
def test_keys_are_named_as_in_profiles(number: int, name: str) -> None:
    # The numbers are those of glfw3.h.
    assert PLACES[number] == name


def test_every_key_name_may_be_used_in_a_profile() -> None:
    for name in PLACES.values():
        check_key(name)
    assert len(set(PLACES.values())) == len(PLACES)


def test_every_key_of_the_game_has_a_place() -> None:
    keys = {key for key in BINDINGS if not key.endswith("button")} - {" "}
    assert keys <= set(PLACES.values())


@pytest.mark.parametrize(
    ("place", "made", "has_shift", "key"),
    [
        ("w", "z", False, "z"),
        ("w", "z", True, "z"),
        ("w", "ц", False, ""),
        ("w", None, False, ""),
        ("1", "&", False, ""),
        ("1", "&", True, "1"),
        ("4", "'", False, "'"),
        ("4", "'", True, "4"),
        ("left.shift", None, True, "left.shift"),
    ],
)
def test_up_to_1_12_a_key_is_taken_by_the_symbol_that_it_makes(
    place: str, made: str | None, has_shift: bool, key: str
) -> None:
    assert symbol_at(place, made, has_shift=has_shift) == key
