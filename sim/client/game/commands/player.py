"""Commands that change no blocks: of the player's place, game mode and hotbar; of game rules, time and weather."""

import re

from sim.client.game.commands.words import after_player, block_name, coordinate, display_name
from sim.client.game.realm import SLOTS, Mode, Realm, Stack
from sim.client.game.world import AIR

_MODES: dict[str, Mode] = {"creative": "creative", "survival": "survival"}
_SHORT_MODES: dict[str, Mode] = {"0": "survival", "s": "survival", "1": "creative", "c": "creative"}

_TIMES = {"day": 1000, "noon": 6000, "night": 13000, "midnight": 18000}
_RULES = {
    "doDaylightCycle": "advance_time",
    "doWeatherCycle": "advance_weather",
    "doMobSpawning": "spawn_mobs",
    "sendCommandFeedback": "send_command_feedback",
    "reducedDebugInfo": "reduced_debug_info",
    "doImmediateRespawn": "immediate_respawn",
    "keepInventory": "keep_inventory",
    "fallDamage": "fall_damage",
    "logAdminCommands": "log_admin_commands",
    "randomTickSpeed": "random_tick_speed",
}
"""Each rule's name before 1.21.11, and its name since."""


def teleport(realm: Realm, words: list[str]) -> str:
    """Do ``/tp [player] x y z [yaw pitch]``."""
    if words and not re.match(r"[-~\d.]", words[0]):
        words = after_player(realm, words)
    if len(words) not in (3, 5):
        raise ValueError("a position, and perhaps a view")
    player = realm.player
    x, y, z = (
        coordinate(word, part, centred=axis != 1)
        for axis, (word, part) in enumerate(zip(words, player.feet, strict=False))
    )
    player.go_to((x, y, z))
    if len(words) == 5:
        player.look(coordinate(words[3], player.yaw), coordinate(words[4], player.pitch))
    shown = (f"{part:.6f}" if realm.edition.since(1, 13) else f"{part:.2f}" for part in (x, y, z))
    return f"Teleported {realm.player_name} to {', '.join(shown)}"


def gamemode(realm: Realm, words: list[str]) -> str:
    """Do ``/gamemode creative``; before 1.13 the mode may also be its number or first letter."""
    modes = _MODES if realm.edition.since(1, 13) else _MODES | _SHORT_MODES
    mode = modes.get(words[0])
    if mode is None:
        raise ValueError(words[0])
    realm.player.mode = mode
    return f"Set own game mode to {mode.capitalize()} Mode"


def item(realm: Realm, words: list[str]) -> str:
    """Do, from 1.17 on, ``/item replace entity @s hotbar.0 with minecraft:stone 64``."""
    if words[:2] != ["replace", "entity"] or words[4] != "with":
        raise ValueError(words)
    after_player(realm, words[2:3])
    return _replace(realm, words[3], words[5:], "hotbar.")


def replaceitem(realm: Realm, words: list[str]) -> str:
    """Do, before 1.17, ``/replaceitem entity @s hotbar.0 minecraft:stone 64``.

    In 1.12 the slot is ``slot.hotbar.0``, and the data value stands behind.
    """
    if words[0] != "entity":
        raise ValueError(words[0])
    after_player(realm, words[1:2])
    return _replace(realm, words[2], words[3:], "hotbar." if realm.edition.since(1, 13) else "slot.hotbar.")


def gamerule(realm: Realm, words: list[str]) -> str:
    """Do ``/gamerule name value``."""
    name, value = words[0].removeprefix("minecraft:"), words[1]
    known = _RULES.values() if realm.edition.since(1, 21, 11) else _RULES
    if name not in known or not (value in ("true", "false") or value.isdigit()):
        raise ValueError(name)
    realm.rules[name] = value
    if realm.edition.since(1, 13):
        return f"Gamerule {name} is now set to: {value}"
    return f"Game rule {name} has been updated to {value}"


def time(realm: Realm, words: list[str]) -> str:
    """Do ``/time set noon``, or a number of ticks."""
    if words[0] != "set":
        raise ValueError(words[0])
    realm.day_time = _TIMES[words[1]] if words[1] in _TIMES else int(words[1])
    return f"Set the time to {realm.day_time}"


def weather(realm: Realm, words: list[str]) -> str:
    """Do ``/weather clear``. It changes nothing here."""
    if words[0] not in ("clear", "rain", "thunder"):
        raise ValueError(words[0])
    return f"Set the weather to {words[0]}" if realm.edition.since(1, 13) else f"Changing to {words[0]} weather"


def difficulty(_realm: Realm, words: list[str]) -> str:
    """Do ``/difficulty peaceful``. It changes nothing here."""
    return f"The difficulty has been set to {words[0].capitalize()}"


def _replace(realm: Realm, slot: str, words: list[str], prefix: str) -> str:
    index = int(slot.removeprefix(prefix))
    if not slot.startswith(prefix) or index not in range(SLOTS):
        raise ValueError(slot)
    stack = Stack(block_name(realm, words[0]), int(words[1]) if len(words) > 1 else 1)
    realm.player.hotbar[index] = None if stack.block == AIR else stack
    if realm.edition.since(1, 13):
        return f"Replaced a slot on {realm.player_name} with [{display_name(stack.block)}]"
    return f"Replaced slot {slot} with {stack.count} * [{display_name(stack.block)}]"
