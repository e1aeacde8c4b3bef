"""The lines of options.txt that the virtual client knows."""

import pytest

from mc_nested.errors import UserError
from sim.client.game.edition import Edition
from sim.client.game.options import LINES, GameOptions, parse_options

NEWEST = Edition("26.4")


def test_options_without_lines_are_the_games_defaults() -> None:
    assert parse_options([], NEWEST) == GameOptions()


def test_an_option_of_each_type_is_read() -> None:
    lines = ["guiScale:3", "debugGuiScale:-1", "toggleUse:true", "textBackgroundOpacity:0.25", "chatVisibility:2"]
    assert parse_options(lines, NEWEST) == GameOptions(
        gui_scale=3, debug_gui_scale=-1, toggle_use=True, text_background_opacity=0.25, chat_visibility=2
    )


def test_the_last_of_two_lines_for_one_option_counts() -> None:
    assert parse_options(["guiScale:3", "guiScale:1"], NEWEST).gui_scale == 1


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("guiscale:3", "no option 'guiscale' is known"),
        ("", "no option '' is known"),
        ("guiScale:two", "guiScale can't be 'two'"),
        ("guiScale:-1", "guiScale can't be '-1'"),
        ("guiScale", "guiScale can't be ''"),
        ("debugGuiScale:-2", "debugGuiScale can't be '-2'"),
        ("toggleUse:on", "toggleUse can't be 'on'"),
        ("textBackgroundOpacity:nan", "textBackgroundOpacity can't be 'nan'"),
        ("textBackgroundOpacity:1.5", "textBackgroundOpacity can't be '1.5'"),
    ],
)
def test_a_line_that_is_not_an_option_is_refused(line: str, problem: str) -> None:
    with pytest.raises(UserError, match=problem):
        parse_options([line], NEWEST)


@pytest.mark.parametrize(
    ("line", "version"),
    [
        ("debugGuiScale:0", "26.2"),
        ("toggleUse:true", "1.21.8"),
        ("saveChatDrafts:true", "1.21.8"),
        ("backgroundForChatOnly:false", "1.13"),
        ("toggleCrouch:true", "1.14.4"),
    ],
)
def test_an_option_that_the_version_lacks_is_refused(line: str, version: str) -> None:
    with pytest.raises(UserError, match=f"Minecraft {version} has no option {line.split(':')[0]}"):
        parse_options([line], Edition(version))


def test_each_option_has_a_field_of_its_own() -> None:
    assert sorted(line.field for line in LINES.values()) == sorted(GameOptions.__dataclass_fields__)


def test_only_a_background_set_to_everywhere_changes_the_typed_lines_ground() -> None:
    seen = [
        (options.message_ground, options.typed_ground)
        for options in (
            GameOptions(),
            GameOptions(text_background_opacity=0.2),
            GameOptions(text_background_opacity=0.2, background_for_chat_only=False),
        )
    ]
    assert seen == [(128, 128), (51, 128), (51, 51)]
