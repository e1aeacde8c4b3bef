"""Comparing and copying regions by command, as each version answers."""

import pytest

from sim.client.game.commands.chat_line import Answer, run
from sim.client.game.realm import Realm
from tests.sim.client.game.commands.commanded import answer_to, realm


def test_a_fill_covers_both_corners_in_any_order() -> None:
    played = realm()
    assert answer_to("/fill 1 65 0 0 64 0 stone", played) == ("Successfully filled 4 block(s)", False)
    assert sorted(played.world.built()) == [(0, 64, 0), (0, 65, 0), (1, 64, 0), (1, 65, 0)]


@pytest.mark.parametrize(("version", "data"), [("1.12.2", "0 "), ("1.13", "")])
def test_a_fill_with_keep_fills_only_air(version: str, data: str) -> None:
    played = realm(version)
    played.world.put((0, 63, 0), "air")
    played.world.put((1, 63, 0), "sand")
    _, is_error = answer_to(f"/fill 0 63 0 2 63 0 stone {data}keep", played)
    assert not is_error
    assert played.world.built() == {(0, 63, 0): "stone", (1, 63, 0): "sand"}
    assert answer_to(f"/fill 0 63 0 2 63 0 stone {data}hollow", played)[1]


@pytest.mark.parametrize(("version", "answer"), [("1.12.2", "No blocks filled"), ("1.13", "No blocks were filled")])
def test_a_fill_that_changes_nothing_is_refused(version: str, answer: str) -> None:
    assert answer_to("/fill 0 64 0 1 64 0 air", realm(version)) == (answer, True)


def test_a_fill_of_32768_blocks_is_the_largest() -> None:
    assert answer_to("/fill 0 64 0 31 95 31 stone", realm()) == ("Successfully filled 32768 block(s)", False)
    text, is_error = answer_to("/fill 0 64 0 31 95 32 stone", realm())
    assert (text, is_error) == (
        "Too many blocks in the specified area (maximum 32768, specified 33792)",
        True,
    )


@pytest.mark.parametrize(
    ("version", "answer"), [("1.12.2", "8 blocks cloned"), ("1.20.1", "Successfully cloned 8 blocks")]
)
def test_a_region_is_copied_to_the_named_lowest_corner(version: str, answer: str) -> None:
    played = realm(version)
    assert answer_to("/clone 1 64 1 0 62 0 10 70 20", played) == (answer, False)
    assert played.world.built() == {(x, y, z): "dirt" for x in (10, 11) for y in (70, 71) for z in (20, 21)}


@pytest.mark.parametrize(("version", "answer"), [("1.12.2", "No blocks cloned"), ("1.20.1", "No blocks were cloned")])
def test_a_copy_that_changes_nothing_is_refused(version: str, answer: str) -> None:
    assert answer_to("/clone 0 64 0 1 65 1 10 70 20", realm(version)) == (answer, True)


@pytest.mark.parametrize(("x", "overlaps"), [(9, True), (10, False), (7, True), (6, False)])
def test_a_copy_may_touch_but_not_overlap(x: int, overlaps: bool) -> None:
    refused = ("The source and destination areas cannot overlap", True)
    assert (answer_to(f"/clone 8 63 8 9 63 9 {x} 63 8", realm()) == refused) == overlaps


def test_a_region_of_32768_blocks_is_the_largest() -> None:
    assert answer_to("/testforblocks 0 64 0 31 95 31 40 64 0", realm("1.12.2")) == ("32768 blocks compared", False)
    text, is_error = answer_to("/testforblocks 0 64 0 31 95 32 40 64 0", realm("1.12.2"))
    assert (text, is_error) == ("Too many blocks in the specified area (maximum 32768, specified 33792)", True)


def test_1_12_answers_testforblocks_in_its_own_words() -> None:
    played = realm("1.12.2")
    assert answer_to("/testforblocks 0 64 0 3 65 3 9 80 9", played) == ("32 blocks compared", False)
    played.world.put((2, 64, 2), "stone")
    refused = ("Source and destination are not identical", True)
    assert answer_to("/testforblocks 0 64 0 3 65 3 9 80 9", played) == refused


def test_newer_versions_do_not_know_testforblocks() -> None:
    assert run("/testforblocks 0 64 0 3 65 3 9 80 9", realm())[1].text.endswith("<--[HERE]")


@pytest.mark.parametrize("block", [(39, 64, 8), (-16, 64, 8), (8, 64, 31)])
def test_only_blocks_within_the_view_distance_in_chunks_are_loaded(block: tuple[int, int, int]) -> None:
    played = realm()
    played.view_distance = 1
    x, y, z = block
    is_refused = x >= 32
    answers = run(f"/execute if block {x} {y} {z} air run tp @s ~ ~ ~ 0 44", played)
    assert (answers[0].text == "That position is not loaded") == is_refused
    assert (played.player.pitch == 44) != is_refused


@pytest.mark.parametrize(
    ("version", "line", "answer"),
    [
        ("1.20.1", "/execute if block 8 64 40 air run tp 0 0 0", "That position is not loaded"),
        ("1.20.1", "/execute unless block 8 64 40 air run tp 0 0 0", "That position is not loaded"),
        ("1.20.1", "/clone 8 64 31 8 64 32 8 70 8", "That position is not loaded"),
        ("1.20.1", "/clone 8 64 8 8 64 9 8 70 31", "That position is not loaded"),
        ("1.12.2", "/testforblocks 8 64 31 8 64 32 8 70 8", "Cannot access blocks there"),
    ],
)
def test_commands_on_blocks_that_are_not_loaded_are_refused(version: str, line: str, answer: str) -> None:
    played = realm(version)
    played.view_distance = 1
    assert answer_to(line, played) == (answer, True)


def pitch_after(line: str, played: Realm) -> float:
    played.player.pitch = 0.0
    run(line, played)
    return played.player.pitch


@pytest.mark.parametrize("mode", ["all", "masked"])
def test_a_condition_on_blocks_runs_its_command_or_gives_no_answer(mode: str) -> None:
    played, blocks = realm(), f"blocks 0 64 0 3 65 3 9 80 9 {mode} run tp @s ~ ~ ~ 0 31"
    assert pitch_after(f"/execute if {blocks}", played) == 31
    assert run(f"/execute unless {blocks}", played) == []
    played.world.put((2, 64, 2), "stone")
    assert run(f"/execute if {blocks}", played) == []
    assert pitch_after(f"/execute unless {blocks}", played) == 31


def test_a_condition_on_a_block_runs_its_command_or_gives_no_answer() -> None:
    played, block = realm(), "block 2 64 2 minecraft:stone run tp @s ~ ~ ~ 0 31"
    assert pitch_after(f"/execute if {block}", played) == 0
    assert pitch_after(f"/execute unless {block}", played) == 31
    played.world.put((2, 64, 2), "stone")
    assert pitch_after(f"/execute if {block}", played) == 31
    assert pitch_after(f"/execute unless {block}", played) == 0


@pytest.mark.parametrize(
    "line",
    [
        "/execute if blocks 0 64 0 3 65 3 9 80 9 some run tp @s ~ ~ ~ 0 31",
        "/execute if entity @s run tp @s ~ ~ ~ 0 31",
        "/execute if block 2 64 2 air tp @s ~ ~ ~ 0 31",
        "/execute if block 2 64 2 air",
    ],
)
def test_other_conditions_of_execute_are_refused(line: str) -> None:
    played = realm()
    assert answer_to(line, played) == ("Incorrect argument for command", True)
    assert played.player.pitch == 10.0


def test_1_12_executes_a_command_if_it_detects_a_block() -> None:
    played = realm("1.12.2")
    assert pitch_after("/execute @s ~ ~ ~ detect 0 64 0 minecraft:air 0 tp @s ~ ~ ~ 0 31", played) == 31
    refused = answer_to("/execute @s ~ ~ ~ detect 0 63 0 minecraft:air 0 tp @s ~ ~ ~ 0 32", played)
    assert refused == ("Failed to execute 'tp @s ~ ~ ~ 0 32' as Player", True)
    for wrong in ("/execute @e ~ ~ ~ detect 0 64 0 air 0 tp 0 0 0", "/execute @s ~ ~ ~ notice 0 64 0 air 0 tp 0 0 0"):
        assert answer_to(wrong, played)[0].startswith("Usage: /execute")


@pytest.mark.parametrize(
    "inner", ["nonsense", "nonsense 1", "", "testforblocks 1", "execute if block 2 64 2 air run x"]
)
@pytest.mark.parametrize("condition", ["if", "unless"])
def test_execute_with_an_unknown_command_is_refused_whatever_its_condition(condition: str, inner: str) -> None:
    played = realm("1.20.1")
    answers = run(f"/execute {condition} block 2 80 2 air run {inner}", played)
    assert answers[0] == Answer("Unknown or incomplete command, see below for error", is_error=True)
    assert len(answers) == 2


def test_in_1_12_an_execute_of_an_unknown_command_fails() -> None:
    answer = answer_to("/execute @s ~ ~ ~ detect 0 64 0 minecraft:air 0 nonsense 1", realm("1.12.2"))
    assert answer == ("Failed to execute 'nonsense 1' as Player", True)
