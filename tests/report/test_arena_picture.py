"""A picture of a film: the arena with its words, and the window beside it."""

import dataclasses

import numpy as np
import pytest
from PIL import ImageDraw

from mc_nested.arena.action import Action
from mc_nested.arena.drawing import Picture, draw_picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.report.arena_picture import (
    ARENA_PX,
    CAPTION,
    LINES,
    MARGIN,
    PAPER,
    SMALL_ARENA_PX,
    STEP_PX,
    beside,
    box_for,
    draw_moment,
)
from tests.arena.made_parts import STONE, STRIPES, TO_FAR, TO_NEAR, WOOD
from tests.arena.simulated import arena_env
from tests.report.films import flat

LINE = load_scenario("line")


def after(*actions: Action, scenario: Scenario = LINE, material: str = "stone") -> ArenaEnv:
    """Return an arena after a reset and those actions."""
    env = arena_env(scenario)
    env.reset(options={"material": material})
    for action in actions:
        env.step(action)
    return env


def words_of(picture: Picture) -> Picture:
    return picture[:CAPTION]


@pytest.mark.parametrize(
    ("arena_px", "size", "px"), [(390, 15, 26), (390, 32, 12), (390, 5, 78), (210, 15, 14), (210, 32, 6)]
)
def test_every_arena_fills_the_same_square(arena_px: int, size: int, px: int) -> None:
    scenario = dataclasses.replace(LINE, design=frozenset({(2, 2)}), start=(1, 1), size=size)
    picture = draw_moment(after(Action.FD, scenario=scenario), arena_px=arena_px)
    assert picture.shape == (arena_px + CAPTION + MARGIN, arena_px + 2 * MARGIN, 3)
    side = size * px
    top, left = CAPTION + (arena_px - side) // 2, (picture.shape[1] - side) // 2
    expected = draw_picture(scenario, (1, 2), {(1, 3)}, px)
    np.testing.assert_array_equal(picture[top : top + side, left : left + side], expected)


@pytest.mark.parametrize(
    "changed",
    [after(*[Action.B] * 4), after(Action.B, Action.BD, Action.BD), after(*[Action.B] * 3, material="wood")],
    ids=["another step", "a block on the design", "another material"],
)
def test_the_caption_changes_with_the_step_the_blocks_and_the_material(changed: ArenaEnv) -> None:
    assert (words_of(draw_moment(changed)) != words_of(draw_moment(after(*[Action.B] * 3)))).any()


def test_the_caption_of_a_design_in_parts_says_what_is_in_hand_and_the_score_so_far(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words: list[str] = []
    monkeypatch.setattr(ImageDraw.ImageDraw, "text", lambda _pen, _place, text, *_, **__: words.append(text))
    env = after(scenario=STRIPES)
    for action in TO_FAR:
        env.step((action, STONE))
    draw_moment(env)
    for action in TO_NEAR[:2]:
        env.step((action, WOOD))
    draw_moment(env)
    assert words == [
        *("stripes, in stone", "step 2", "2 of 5 blocks", "score 12 of 21"),
        *("stripes, in wood", "step 4", "3 of 5 blocks", "score 19 of 21"),
    ]


def test_the_caption_does_not_depend_on_the_agents_cell() -> None:
    np.testing.assert_array_equal(words_of(draw_moment(after(Action.B))), words_of(draw_moment(after(Action.L))))


def test_a_long_name_ends_before_the_edge() -> None:
    named = dataclasses.replace(LINE, name="W" * 60)
    words = words_of(draw_moment(after(scenario=named), arena_px=SMALL_ARENA_PX))[: LINES[1]]
    plain = words_of(draw_moment(after(), arena_px=SMALL_ARENA_PX))[: LINES[1]]
    assert (words[:, :MARGIN] == PAPER).all()
    assert (words[:, SMALL_ARENA_PX // 2 : -MARGIN - STEP_PX] != PAPER).any()
    np.testing.assert_array_equal(words[:, -MARGIN - STEP_PX :], plain[:, -MARGIN - STEP_PX :])


def test_a_window_is_drawn_beside_the_arena_at_the_arenas_height() -> None:
    picture, window = draw_moment(after()), flat((9, 99, 199), 1280, 720)
    box = box_for(window)
    assert box == (round(ARENA_PX * 16 / 9), ARENA_PX)
    both = beside(picture, window, box)
    assert both.shape == (picture.shape[0], picture.shape[1] + box[0] + MARGIN, 3)
    np.testing.assert_array_equal(both[:, : picture.shape[1]], picture)
    assert (both[CAPTION : CAPTION + ARENA_PX, picture.shape[1] : -MARGIN] == (9, 99, 199)).all()
    assert (both[: LINES[1], picture.shape[1] :] == PAPER).all()
    assert (both[LINES[1] : CAPTION, picture.shape[1] :] != PAPER).any()


def test_a_window_of_another_size_is_fitted_into_the_same_box() -> None:
    picture, box = draw_moment(after()), (600, ARENA_PX)
    shapes = {beside(picture, flat((0, 0, 0), width, height), box).shape for width, height in [(900, 576), (100, 576)]}
    assert len(shapes) == 1
    narrow = beside(picture, flat((0, 0, 0), 100, 576), box)[CAPTION : CAPTION + ARENA_PX, picture.shape[1] : -MARGIN]
    dark = (narrow == 0).all(axis=(0, 2))
    assert dark.sum() == round(100 * ARENA_PX / 576)
    assert (narrow[:, ~dark] == PAPER).all()
