from itertools import islice

import numpy as np

from mc_nested.live.model.reading import Reading, Target
from scripts.benches.f3_cases import expected, frames, random_screen
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from tests.sim.client.playing import FONT

SMALL = ((320, 240), (660, 480))


def test_every_layout_window_and_scale_comes_in_turn() -> None:
    cases = [(screen, frame.shape) for screen, frame in islice(frames(FONT, 0, SMALL), 28)]
    assert [screen.layout for screen, _ in cases[:7]] == list(LAYOUTS)
    assert [shape[:2] for _, shape in cases] == ([(240, 320)] * 7 + [(480, 660)] * 7) * 2
    # The boxes of 26.4 don't fit beside each other at the larger scale.
    assert [screen.gui_scale for screen, _ in cases] == [1] * 21 + [2] * 6 + [1]


def test_the_same_seed_gives_the_same_frames() -> None:
    first, second = (list(islice(frames(FONT, 5, SMALL), 6)) for _ in range(2))
    for (screen, frame), (other_screen, other_frame) in zip(first, second, strict=True):
        assert screen == other_screen
        assert np.array_equal(frame, other_frame)


def test_random_screens_lie_within_the_world_and_fit_their_layout() -> None:
    rng = np.random.default_rng(0)
    for number in range(300):
        layout = LAYOUTS[number % len(LAYOUTS)]
        screen = random_screen(rng, layout, 2)
        x, y, z = screen.xyz
        assert max(abs(x), abs(z)) <= 29_999_000
        assert -64 <= y <= 319
        assert abs(screen.yaw) <= 180
        assert abs(screen.pitch) <= 90
        assert (screen.entries is not None) == (layout in ("1.21.9-26.3", "26.4"))
        assert not screen.reduced
        assert screen.entries is None or not {"looking_at_block", "looking_at_block_state"}.isdisjoint(screen.shown)
        assert not (screen.tags and layout in ("standin", "1.8-1.12"))
        if screen.target is not None:
            assert (screen.target.id or "").startswith("minecraft:") == (layout != "standin")
            assert screen.target.pos is not None


def test_about_four_of_five_screens_have_a_target() -> None:
    rng = np.random.default_rng(1)
    share = sum(random_screen(rng, "1.16-1.19.2", 1).target is not None for _ in range(400)) / 400
    assert 0.74 < share < 0.86


def test_a_perfect_reader_reads_the_numbers_as_shown() -> None:
    target = Target((1, 2, 3), "stone")
    screen = F3Screen("1.16-1.19.2", 1, (1.23456, 64.123456, -7.6543), 12.34, -5.67, target)
    assert expected(screen) == Reading((1.235, 64.12346, -7.654), 12.3, -5.7, target)
    standin = F3Screen("standin", 1, (1.23456, 64.123456, -7.6543), 12.34, -5.67)
    assert expected(standin).xyz == (1.235, 64.123, -7.654)


def test_the_gui_scale_fits_the_windows_width_and_height() -> None:
    for window in ((320, 480), (660, 240)):
        scales = {screen.gui_scale for screen, _ in islice(frames(FONT, 0, (window,)), 18)}
        assert scales == {1}


def test_a_target_has_any_number_of_properties_and_tags() -> None:
    rng = np.random.default_rng(2)
    screens = [random_screen(rng, "1.16-1.19.2", 1) for _ in range(200)]
    assert {len(screen.tags) for screen in screens} == {0, 1, 2, 3}
    assert {len(screen.properties) for screen in screens} == {0, 1, 2, 3, 4}
    assert 0.1 < sum(screen.fluid is not None for screen in screens) / 200 < 0.3
