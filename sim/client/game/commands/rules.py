"""Commands about the world's rules: game rules, time, weather and difficulty."""

from sim.client.game.realm import Realm

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
