"""Questions about blocks: the command of each, and what each answer means."""

import re

import pytest

from calibration.arena.block_queries import BlockQueries
from mc_nested.live.model.reading import Reading
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile
from mc_nested.live.vision.game_screen import GameScreen
from sim.client.client import VirtualClient
from tests.calibration.arena.scripted import ScriptedConsole
from tests.sim.client.playing import connection_to

BOX = ((0, 64, 0), (2, 65, 4))


def turns(command: str) -> Reading:
    """The view that the command's last two numbers ask for."""
    yaw, pitch = command.split()[-2:]
    return Reading(xyz=(0.5, 64.0, 0.5), yaw=float(yaw), pitch=float(pitch))


def queries(console: ScriptedConsole, version: str = "1.20.1", *, reads_chat: bool = True) -> BlockQueries:
    profile = Profile(game=GameVersion(version=version), input=InputTable(reads_chat=reads_chat))
    return BlockQueries(console, profile, screen(), 90.0)


def screen() -> GameScreen:
    return connection_to(VirtualClient()).screen


def test_a_condition_that_holds_turns_the_view() -> None:
    console = ScriptedConsole(turns)
    assert queries(console).is_air((1, -2, 3)) is True
    assert console.sent == ["/execute if block 1 -2 3 minecraft:air run tp @s ~ ~ ~ 90 20"]


def test_a_condition_that_does_not_hold_turns_it_to_another_pitch() -> None:
    console = ScriptedConsole(lambda command: turns(command) if " unless " in command else None)
    assert queries(console).are_alike(BOX, (10, 64, 10)) is False
    assert console.sent == [
        "/execute if blocks 0 64 0 2 65 4 10 64 10 all run tp @s ~ ~ ~ 90 20",
        "/execute unless blocks 0 64 0 2 65 4 10 64 10 all run tp @s ~ ~ ~ 90 21",
    ]


def test_without_any_effect_the_answer_is_unknown() -> None:
    console = ScriptedConsole()
    assert queries(console).is_air((0, 0, 0)) is None
    assert len(console.sent) == 2


@pytest.mark.parametrize(("off", "answer"), [(0.1, True), (-0.1, True), (0.5, None), (-0.5, None)])
def test_the_view_may_differ_from_the_command_by_a_rounding(off: float, answer: bool | None) -> None:
    def turned(command: str) -> Reading:
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=90.0, pitch=float(command.split()[-1]) + off)

    assert queries(ScriptedConsole(turned)).is_air((0, 0, 0)) is answer


def test_pitches_are_used_again_only_after_forty_questions() -> None:
    console = ScriptedConsole(turns)
    asking = queries(console)
    for _ in range(42):
        asking.is_air((0, 0, 0))
    pitches = [int(command.split()[-1]) for command in console.sent]
    assert pitches[:41] == [*range(20, 60), 20]
    assert pitches[41] == 21


def test_1_12_answers_only_whether_one_block_is_air() -> None:
    console = ScriptedConsole(turns)
    assert queries(console, "1.12.2").is_air((1, 2, 3)) is True
    assert console.sent == ["/execute @s ~ ~ ~ detect 1 2 3 minecraft:air 0 tp @s ~ ~ ~ 90 20"]
    assert queries(ScriptedConsole(), "1.12.2").is_air((1, 2, 3)) is None


def test_1_12_without_its_chat_can_compare_nothing() -> None:
    console = ScriptedConsole()
    assert queries(console, "1.12.2", reads_chat=False).are_alike(BOX, (10, 64, 10)) is None
    assert console.sent == []


def test_1_12_compares_after_its_chat_is_cleared() -> None:
    console = ScriptedConsole()
    assert queries(console, "1.12.2").are_alike(BOX, (10, 64, 10)) is None, "its screen shows no answer"
    assert console.sent == ["clear", "/testforblocks 0 64 0 2 65 4 10 64 10"]


def test_a_floor_of_one_block_equals_itself_one_on_in_both_directions() -> None:
    console = ScriptedConsole(turns)
    assert queries(console).is_uniform(((0, 63, 0), (16, 63, 16))) is True
    regions = [re.search(r"blocks (.*) all", command) for command in console.sent]
    assert [match and match[1] for match in regions] == ["0 63 0 15 63 16 1 63 0", "0 63 0 0 63 15 0 63 1"]


def test_a_floor_that_differs_along_one_direction_is_not_of_one_block() -> None:
    def along_only(command: str) -> Reading | None:
        holds = "0 63 0 15 63 16" in command
        return turns(command) if holds == (" if " in command) else None

    assert queries(ScriptedConsole(along_only)).is_uniform(((0, 63, 0), (16, 63, 16))) is False
