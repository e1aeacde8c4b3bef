import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.drawing.scenery import WORLDS, random_world


def world(kind: str, seed: int = 0) -> Frame:
    return random_world(np.random.default_rng(seed), kind, 50, 40)


@pytest.mark.parametrize("kind", [*WORLDS, "bright", "dark"])
def test_every_kind_has_the_asked_size_and_depends_on_the_seed_alone(kind: str) -> None:
    assert world(kind).shape == (40, 50, 3)
    assert world(kind).dtype == np.uint8
    assert np.array_equal(world(kind), world(kind))
    assert not np.array_equal(world(kind), world(kind, 1))


def test_a_flat_world_has_one_colour() -> None:
    assert len(np.unique(world("flat").reshape(-1, 3), axis=0)) == 1


def test_grey_noise_is_grey_and_noise_is_not() -> None:
    assert (world("grey noise") == world("grey noise")[..., :1]).all()
    assert not (world("noise") == world("noise")[..., :1]).all()


def test_a_noon_is_bright_and_a_night_is_dark() -> None:
    assert world("bright").min() >= 200
    assert world("dark").max() < 30


def test_a_gradient_changes_from_left_to_right_alone() -> None:
    picture = world("gradient")
    assert (picture == picture[:1]).all()
    assert not (picture == picture[:, :1]).all()


def test_bright_specks_are_about_a_third_of_a_dark_grey() -> None:
    picture = random_world(np.random.default_rng(0), "specks", 400, 400)
    assert (picture == picture[..., :1]).all()
    dark, bright = np.unique(picture)
    assert (bright, bool(dark < 120)) == (224, True)
    assert 0.25 < (picture == 224).mean() < 0.35


@pytest.mark.parametrize("kind", ["bright", "dark"])
def test_a_sky_is_made_of_squares_of_16_pixels(kind: str) -> None:
    picture = world(kind)
    assert (picture[:16, :16] == picture[0, 0]).all()
    assert (picture[32:40, 48:50] == picture[32, 48]).all()
    assert not (picture[0, 15] == picture[0, 16]).all()
