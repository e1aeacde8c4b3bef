import pytest

from tests.sim.client.game.commands.commanded import answer_to, realm

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
