import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.menus.reset import reset_commands
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.game.commands.chat_line import Answer, run
from sim.client.game.edition import Edition
from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import VirtualWorld

VERSIONS = ["1.12.2", "1.13.2", "1.16.5", "1.20.1", "1.21.11", "26.1"]


def realm(version: str = "1.20.1") -> Realm:
    return Realm(Edition(version), VirtualWorld(64, "dirt"), Player((8.5, 64.0, 8.5)))


def answered(line: str, version: str = "1.20.1") -> list[str]:
    return [answer.text for answer in run(line, realm(version))]


@pytest.mark.parametrize("version", VERSIONS)
def test_every_command_of_a_reset_succeeds_in_every_version(version: str) -> None:
    played, line = realm(version), load_scenario("line")
    profile = Profile(game=GameVersion(version=version), arena=Arena.around((0, 64, 0), "west"))
    played.world.put(profile.marked_arena().block_of((3, 4)), "stone")
    for command in reset_commands(profile, line.start, [material.block for material in line.materials]):
        answers = run(command, played)
        assert len(answers) == 1
        assert not answers[0].is_error
    assert played.world.built() == {}
    assert played.player.feet == profile.marked_arena().centre_of(line.start)
    assert (played.player.yaw, played.player.pitch) == (90.0, 65.0)
    planks = "planks" if version == "1.12.2" else "oak_planks"
    assert played.player.hotbar[:3] == [Stack(planks, 64), Stack("stone", 64), None]


@pytest.mark.parametrize(
    ("line", "feet"),
    [
        ("/tp @s 1.5 70 -3.25", (1.5, 70.0, -3.25)),
        ("/tp 1 70 -3", (1.5, 70.0, -2.5)),
        ("/tp @s ~ ~2 ~-1.5", (8.5, 66.0, 7.0)),
        ("/tp Player 0 64 0", (0.5, 64.0, 0.5)),
    ],
)
def test_a_teleport_to_whole_numbers_leads_to_the_blocks_middle(line: str, feet: tuple[float, ...]) -> None:
    played = realm()
    assert not run(line, played)[0].is_error
    assert played.player.feet == feet


@pytest.mark.parametrize(
    ("version", "line", "answer"),
    [
        ("1.12.2", "/fill 0 64 0 1 64 0 stone", "2 blocks filled"),
        ("1.16.5", "/fill 0 64 0 1 64 0 stone", "Successfully filled 2 blocks"),
        ("1.20.1", "/fill 0 64 0 1 64 0 stone", "Successfully filled 2 block(s)"),
        ("1.12.2", "/fill 0 64 0 1 64 0 air", "No blocks filled"),
        ("1.20.1", "/fill 0 64 0 1 64 0 air", "No blocks were filled"),
        (
            "1.20.1",
            "/fill 0 64 0 63 95 31 stone",
            "Too many blocks in the specified area (maximum 32768, specified 65536)",
        ),
        ("1.20.1", "/gamerule doDaylightCycle false", "Gamerule doDaylightCycle is now set to: false"),
        ("1.21.11", "/gamerule advance_time false", "Gamerule advance_time is now set to: false"),
        ("1.12.2", "/gamerule doDaylightCycle false", "Game rule doDaylightCycle has been updated to false"),
        ("1.20.1", "/gamemode creative", "Set own game mode to Creative Mode"),
        ("1.12.2", "/gamemode 0", "Set own game mode to Survival Mode"),
        ("1.20.1", "/time set 6000", "Set the time to 6000"),
        ("1.12.2", "/weather clear", "Changing to clear weather"),
        ("1.20.1", "/weather clear", "Set the weather to clear"),
        ("1.20.1", "hello there", "<Player> hello there"),
    ],
)
def test_each_version_answers_in_its_own_words(version: str, line: str, answer: str) -> None:
    assert answered(line, version) == [answer]


@pytest.mark.parametrize(
    ("version", "answers"),
    [
        ("1.12.2", ["Unknown command. Try /help for a list of commands"]),
        ("1.13.2", ["Unknown command", "nonsense 1<--[HERE]"]),
        ("1.15.2", ["Unknown command", "nonsense 1<--[HERE]"]),
        ("1.16", ["Unknown or incomplete command, see below for error", "nonsense 1<--[HERE]"]),
        ("1.20.1", ["Unknown or incomplete command, see below for error", "nonsense 1<--[HERE]"]),
        ("26.1", ["Unknown or incomplete command. See below for error", "nonsense 1<--[HERE]"]),
    ],
)
def test_an_unknown_command_is_an_error_in_each_versions_words(version: str, answers: list[str]) -> None:
    assert answered("/nonsense 1", version) == answers


@pytest.mark.parametrize(
    ("version", "line"),
    [
        ("1.20.1", "/replaceitem entity @s hotbar.0 minecraft:stone 64"),
        ("1.16.5", "/item replace entity @s hotbar.0 with minecraft:stone 64"),
        ("1.16.5", "/replaceitem entity @s slot.hotbar.0 minecraft:stone 64"),
        ("1.12.2", "/replaceitem entity @s hotbar.0 minecraft:stone 64 0"),
        ("1.12.2", "/replaceitem entity @s slot.hotbar.0 minecraft:oak_planks 64 0"),
        ("1.20.1", "/item replace entity @s hotbar.9 with minecraft:stone 64"),
        ("1.20.1", "/gamemode 1"),
        ("1.20.1", "/gamerule advance_time false"),
        ("1.21.11", "/gamerule doDaylightCycle false"),
        ("1.20.1", "/tp @s 1 2"),
        ("1.20.1", "/fill 0 64 0 1 64"),
        ("1.20.1", "/tp Somebody 1 2 3"),
    ],
)
def test_commands_of_other_versions_and_malformed_ones_are_refused(version: str, line: str) -> None:
    played = realm(version)
    assert all(answer.is_error for answer in run(line, played))
    assert played.player == realm(version).player
    assert played.rules == {}


@pytest.mark.parametrize(
    ("version", "answer"),
    [
        ("1.12.2", "You do not have permission to use this command"),
        ("1.20.1", "Unknown or incomplete command, see below for error"),
    ],
)
def test_commands_are_refused_without_cheats(version: str, answer: str) -> None:
    played = realm(version)
    played.has_cheats = False
    assert run("/tp @s 0 0 0", played)[0] == Answer(answer, is_error=True)
    assert played.player.feet == (8.5, 64.0, 8.5)


@pytest.mark.parametrize(
    ("version", "line", "answer"),
    [
        ("1.12.2", "/fill 1 2", "Usage: /fill"),
        ("1.20.1", "/time set", "Incorrect argument for command"),
        ("1.20.1", "/weather", "Incorrect argument for command"),
    ],
)
def test_a_wrong_argument_is_answered_as_the_version_does(version: str, line: str, answer: str) -> None:
    answers = run(line, realm(version))
    assert all(each.is_error for each in answers)
    assert answers[0].text == answer
    assert [each.text for each in answers[1:]] == ([f"{line[1:]}<--[HERE]"] if version != "1.12.2" else [])


def test_a_long_line_is_quoted_by_its_last_ten_letters() -> None:
    assert run("/difficult peaceful", realm())[1].text == "...t peaceful<--[HERE]"
    assert run("/abcdefghij", realm())[1].text == "abcdefghij<--[HERE]"


@pytest.mark.parametrize("line", ["", "   "])
def test_an_empty_line_gets_no_answer(line: str) -> None:
    assert run(line, realm()) == []


def test_only_errors_are_answered_without_command_feedback() -> None:
    played = realm()
    assert run("/gamerule sendCommandFeedback false", played) == []
    assert run("/time set noon", played) == []
    assert run("/nonsense", played)[0] == Answer("Unknown or incomplete command, see below for error", is_error=True)
