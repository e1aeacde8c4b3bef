import pytest

from sim.client.game.realm import Stack
from tests.sim.client.game.commands.commanded import answer_to, realm


@pytest.mark.parametrize(
    ("version", "answer"),
    [
        ("1.12.2", "Teleported Player to 1.50, 70.00, -2.00"),
        ("1.13", "Teleported Player to 1.500000, 70.000000, -2.000000"),
    ],
)
def test_a_teleport_answers_with_the_position(version: str, answer: str) -> None:
    assert answer_to("/tp @s 1 70 -2.0", realm(version)) == (answer, False)


def test_a_teleport_that_names_a_view_turns_the_player() -> None:
    played = realm()
    answer_to("/tp 1 70 -2 ~15 -20", played)
    assert (played.player.yaw, played.player.pitch) == (45.0, -20.0)
    answer_to("/tp 1 70 -2", played)
    assert (played.player.yaw, played.player.pitch) == (45.0, -20.0)


@pytest.mark.parametrize("line", ["/tp", "/tp 1 2", "/tp 1 2 3 4", "/tp @s 1 2 3 4", "/tp 1 2 3 4 5 6"])
def test_a_teleport_with_an_incomplete_position_or_view_is_refused(line: str) -> None:
    assert answer_to(line, realm()) == ("Incorrect argument for command", True)


@pytest.mark.parametrize(
    ("version", "word", "mode"),
    [
        ("1.20.1", "survival", "survival"),
        ("1.12.2", "s", "survival"),
        ("1.12.2", "1", "creative"),
        ("1.12.2", "creative", "creative"),
    ],
)
def test_the_game_mode_is_named_or_abbreviated(version: str, word: str, mode: str) -> None:
    played = realm(version)
    played.player.mode = "creative" if mode == "survival" else "survival"
    assert answer_to(f"/gamemode {word}", played) == (f"Set own game mode to {mode.capitalize()} Mode", False)
    assert played.player.mode == mode


@pytest.mark.parametrize(("version", "word"), [("1.13", "s"), ("1.12.2", "spectator"), ("1.20.1", "adventure")])
def test_unknown_game_modes_are_refused(version: str, word: str) -> None:
    assert answer_to(f"/gamemode {word}", realm(version))[1]


def test_item_replace_fills_a_slot_from_1_17_on() -> None:
    played = realm()
    assert answer_to("/item replace entity @s hotbar.8 with minecraft:stone 64", played) == (
        "Replaced a slot on Player with [Stone]",
        False,
    )
    assert played.player.hotbar[8] == Stack("stone", 64)
    answer_to("/item replace entity @s hotbar.8 with air", played)
    assert played.player.hotbar[8] is None


@pytest.mark.parametrize(
    "line",
    [
        "/item modify entity @s hotbar.0 with stone",
        "/item replace block @s hotbar.0 with stone",
        "/item replace entity @s hotbar.0 from stone",
        "/item replace entity @s weapon.0 with stone",
        "/item replace entity @s hotbar.-1 with stone",
    ],
)
def test_item_replace_with_another_slot_or_word_is_refused(line: str) -> None:
    played = realm()
    assert answer_to(line, played) == ("Incorrect argument for command", True)
    assert played.player.hotbar == [None] * 9


@pytest.mark.parametrize(
    ("version", "slot", "answer"),
    [
        ("1.12.2", "slot.hotbar.2", "Replaced slot slot.hotbar.2 with 3 * [Stone]"),
        ("1.13", "hotbar.2", "Replaced a slot on Player with [Stone]"),
    ],
)
def test_replaceitem_fills_a_slot_before_1_17(version: str, slot: str, answer: str) -> None:
    played = realm(version)
    assert answer_to(f"/replaceitem entity @s {slot} stone 3", played) == (answer, False)
    assert played.player.hotbar[2] == Stack("stone", 3)
    assert answer_to(f"/replaceitem block @s {slot} stone 3", played)[1]


WRONG = ("Incorrect argument for command", True)


def test_a_rule_is_set_by_the_name_of_its_version() -> None:
    older, newer = realm("1.21.10"), realm("1.21.11")
    answer_to("/gamerule minecraft:keepInventory true", older)
    answer_to("/gamerule keep_inventory 3", newer)
    assert (older.rules, newer.rules) == ({"keepInventory": "true"}, {"keep_inventory": "3"})
    assert answer_to("/gamerule keep_inventory true", older) == WRONG
    assert answer_to("/gamerule keepInventory true", newer) == WRONG


@pytest.mark.parametrize("value", ["yes", "-1", "True"])
def test_a_value_other_than_true_false_or_a_number_is_refused(value: str) -> None:
    played = realm()
    assert answer_to(f"/gamerule randomTickSpeed {value}", played) == WRONG
    assert played.rules == {}


@pytest.mark.parametrize(("word", "ticks"), [("day", 1000), ("midnight", 18000), ("17", 17)])
def test_the_time_is_a_word_or_ticks(word: str, ticks: int) -> None:
    played = realm()
    assert answer_to(f"/time set {word}", played) == (f"Set the time to {ticks}", False)
    assert played.day_time == ticks


def test_time_commands_other_than_set_are_refused() -> None:
    played = realm()
    assert answer_to("/time add 5", played) == WRONG
    assert played.day_time == 6000


def test_the_weather_is_clear_rain_or_thunder() -> None:
    assert answer_to("/weather thunder", realm()) == ("Set the weather to thunder", False)
    assert answer_to("/weather rain", realm("1.12.2")) == ("Changing to rain weather", False)
    assert answer_to("/weather snow", realm()) == WRONG


def test_setting_the_difficulty_is_answered() -> None:
    assert answer_to("/difficulty peaceful", realm()) == ("The difficulty has been set to Peaceful", False)
