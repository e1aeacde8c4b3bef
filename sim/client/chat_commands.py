"""Chat commands in the syntax of each version, with what the game answers (FACTS: Commands; Answers)."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.live.reading import Block
from sim.client.realm import SLOTS, Realm, Stack
from sim.client.region_commands import Refused, clone, execute, testforblocks
from sim.client.world import AIR, block_of

FILL_LIMIT = 32768
_TIMES = {"day": 1000, "noon": 6000, "night": 13000, "midnight": 18000}
_SELF = ("@s", "@p", "@a")
_BEFORE_1_13 = {"planks", "grass", "wool", "log"}
_SINCE_1_13 = {"oak_planks", "birch_planks", "grass_block", "white_wool", "oak_log", "smooth_stone"}
_ALWAYS = {AIR, "stone", "dirt", "cobblestone", "glass", "sand", "bedrock", "tnt", "obsidian", "lapis_block"}
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


@dataclass(frozen=True)
class Answer:
    """A line in the chat."""

    text: str
    is_error: bool = False


def run(line: str, realm: Realm) -> list[Answer]:
    """Do what a line typed into the chat says, and give the game's answers."""
    if not line.startswith("/"):
        return [Answer(f"<{realm.player_name}> {line}")] if line.strip() else []
    name, *words = line[1:].split() or [""]
    command = _COMMANDS.get(name.removeprefix("minecraft:"))
    try:
        if command is None or not _is_known(name, realm):
            return _unknown(line, realm)
        if not realm.has_cheats:
            if realm.edition.since(1, 13):
                return _unknown(line, realm)
            raise Refused("You do not have permission to use this command")
        answer = command(realm, words)
    except Refused as refusal:
        return [Answer(str(refusal), is_error=True)]
    except (ValueError, IndexError):
        return _wrong(line, realm)
    is_said = answer and realm.rule("sendCommandFeedback", "send_command_feedback", True)
    return [Answer(answer)] if is_said else []


def _is_known(name: str, realm: Realm) -> bool:
    if name in ("item", "replaceitem"):
        return (name == "item") == realm.edition.since(1, 17)
    if name == "testforblocks":
        return not realm.edition.since(1, 13)
    return True


def _unknown(line: str, realm: Realm) -> list[Answer]:
    edition = realm.edition
    if not edition.since(1, 13):
        return [Answer("Unknown command. Try /help for a list of commands", is_error=True)]
    if not edition.since(1, 14):
        return [Answer("Unknown command", is_error=True), _here(line)]
    joint = ". See" if edition.since(1, 21, 9) else ", see"
    return [Answer(f"Unknown or incomplete command{joint} below for error", is_error=True), _here(line)]


def _wrong(line: str, realm: Realm) -> list[Answer]:
    if not realm.edition.since(1, 13):
        return [Answer(f"Usage: /{line[1:].split()[0]}", is_error=True)]
    return [Answer("Incorrect argument for command", is_error=True), _here(line)]


def _here(line: str) -> Answer:
    typed = line[1:]
    return Answer(f"{'...' if len(typed) > 10 else ''}{typed[-10:]}<--[HERE]", is_error=True)


def _teleport(realm: Realm, words: list[str]) -> str:
    if words and not re.match(r"[-~\d.]", words[0]):
        words = _of_self(realm, words)
    if len(words) not in (3, 5):
        raise ValueError("a place, and perhaps a view")
    player = realm.player
    x, y, z = (
        _coordinate(word, part, centred=axis != 1)
        for axis, (word, part) in enumerate(zip(words, player.feet, strict=False))
    )
    player.go_to((x, y, z))
    if len(words) == 5:
        player.look(_coordinate(words[3], player.yaw), _coordinate(words[4], player.pitch))
    shown = (f"{part:.6f}" if realm.edition.since(1, 13) else f"{part:.2f}" for part in (x, y, z))
    return f"Teleported {realm.player_name} to {', '.join(shown)}"


def _fill(realm: Realm, words: list[str]) -> str:
    low, high = _block(realm, words[:3]), _block(realm, words[3:6])
    name = _block_name(realm, words[6])
    count = 1
    for one, other in zip(low, high, strict=True):
        count *= abs(one - other) + 1
    if count > FILL_LIMIT:
        raise Refused(f"Too many blocks in the specified area (maximum {FILL_LIMIT}, specified {count})")
    changed = realm.world.fill(low, high, name)
    new = realm.edition.since(1, 13)
    if not changed:
        raise Refused("No blocks were filled" if new else "No blocks filled")
    return f"Successfully filled {changed} {_blocks(realm)}" if new else f"{changed} blocks filled"


def _blocks(realm: Realm) -> str:
    return "block(s)" if realm.edition.since(1, 20) else "blocks"


def _setblock(realm: Realm, words: list[str]) -> str:
    x, y, z = block = _block(realm, words[:3])
    new = realm.edition.since(1, 13)
    if not realm.world.put(block, _block_name(realm, words[3])):
        raise Refused("Could not set the block" if new else "The block couldn't be placed")
    return f"Changed the block at {x}, {y}, {z}" if new else "Block placed"


def _gamemode(realm: Realm, words: list[str]) -> str:
    short = {"0": "survival", "s": "survival", "1": "creative", "c": "creative"}
    mode = words[0] if realm.edition.since(1, 13) else short.get(words[0], words[0])
    if mode == "creative":
        realm.player.mode = "creative"
    elif mode == "survival":
        realm.player.mode = "survival"
    else:
        raise ValueError(mode)
    return f"Set own game mode to {mode.capitalize()} Mode"


def _gamerule(realm: Realm, words: list[str]) -> str:
    name, value = words[0].removeprefix("minecraft:"), words[1]
    known = _RULES.values() if realm.edition.since(1, 21, 11) else _RULES
    if name not in known or not (value in ("true", "false") or value.isdigit()):
        raise ValueError(name)
    realm.rules[name] = value
    if realm.edition.since(1, 13):
        return f"Gamerule {name} is now set to: {value}"
    return f"Game rule {name} has been updated to {value}"


def _time(realm: Realm, words: list[str]) -> str:
    if words[0] != "set":
        raise ValueError(words[0])
    realm.day_time = _TIMES[words[1]] if words[1] in _TIMES else int(words[1])
    return f"Set the time to {realm.day_time}"


def _weather(realm: Realm, words: list[str]) -> str:
    if words[0] not in ("clear", "rain", "thunder"):
        raise ValueError(words[0])
    return f"Set the weather to {words[0]}" if realm.edition.since(1, 13) else f"Changing to {words[0]} weather"


def _difficulty(_realm: Realm, words: list[str]) -> str:
    return f"The difficulty has been set to {words[0].capitalize()}"


def _give(realm: Realm, words: list[str]) -> str:
    block, *rest = _of_self(realm, words)
    stack = Stack(_block_name(realm, block), int(rest[0]) if rest else 1)
    realm.player.take(stack)
    return f"Gave {stack.count} [{_display_name(stack.block)}] to {realm.player_name}"


def _clear(realm: Realm, words: list[str]) -> str:
    if words:
        _of_self(realm, words)
    count = sum(stack.count for stack in realm.player.hotbar if stack)
    if not count:
        raise Refused(f"No items were found on player {realm.player_name}")
    realm.player.hotbar[:] = [None] * SLOTS
    return f"Removed {count} items from player {realm.player_name}"


def _item(realm: Realm, words: list[str]) -> str:
    """From 1.17 on: ``/item replace entity @s hotbar.0 with minecraft:stone 64``."""
    if words[:2] != ["replace", "entity"] or words[4] != "with":
        raise ValueError(words)
    _of_self(realm, words[2:3])
    return _put(realm, words[3], words[5:], "hotbar.")


def _replaceitem(realm: Realm, words: list[str]) -> str:
    """Before 1.17: ``/replaceitem entity @s hotbar.0 minecraft:stone 64``, in 1.12 with ``slot.`` and data behind."""
    if words[0] != "entity":
        raise ValueError(words[0])
    _of_self(realm, words[1:2])
    return _put(realm, words[2], words[3:], "hotbar." if realm.edition.since(1, 13) else "slot.hotbar.")


def _put(realm: Realm, slot: str, item: list[str], prefix: str) -> str:
    index = int(slot.removeprefix(prefix))
    if not slot.startswith(prefix) or index not in range(SLOTS):
        raise ValueError(slot)
    stack = Stack(_block_name(realm, item[0]), int(item[1]) if len(item) > 1 else 1)
    realm.player.hotbar[index] = None if stack.block == AIR else stack
    if realm.edition.since(1, 13):
        return f"Replaced a slot on {realm.player_name} with [{_display_name(stack.block)}]"
    return f"Replaced slot {slot} with {stack.count} * [{_display_name(stack.block)}]"


def _effect(realm: Realm, words: list[str]) -> str:
    if realm.edition.since(1, 13) and words[0] not in ("give", "clear"):
        raise ValueError(words[0])
    if words[0] == "clear":
        return f"Removed every effect from {realm.player_name}"
    return f"Applied effect {words[2] if words[0] == 'give' else words[1]} to {realm.player_name}"


def _kill(realm: Realm, words: list[str]) -> str:
    if words and words[0].startswith("@e"):
        raise Refused("No entity was found")
    raise ValueError(realm.player_name)


def _execute(realm: Realm, words: list[str]) -> str:
    def run_words(realm: Realm, words: list[str]) -> str:
        return _COMMANDS[words[0]](realm, words[1:])

    return execute(realm, words, run_words, _block_name)


def _of_self(realm: Realm, words: list[str]) -> list[str]:
    """The words behind the player that they begin with, who must be the only one there is."""
    if words[0] not in (*_SELF, realm.player_name):
        raise Refused("No player was found")
    return words[1:]


def _coordinate(word: str, own: float, *, centred: bool = False) -> float:
    if word.startswith("~"):
        return own + float(word[1:] or 0)
    # A whole number is moved to the block's middle, but for the height (FACTS: Commands).
    return float(word) + (0.5 if centred and re.fullmatch(r"-?\d+", word) else 0.0)


def _block(realm: Realm, words: list[str]) -> Block:
    x, y, z = (
        own + int(word[1:] or 0) if word.startswith("~") else int(word)
        for word, own in zip(words, block_of(realm.player.feet), strict=True)
    )
    return x, y, z


def _block_name(realm: Realm, word: str) -> str:
    name = word.removeprefix("minecraft:")
    if name not in _ALWAYS | (_SINCE_1_13 if realm.edition.since(1, 13) else _BEFORE_1_13):
        raise Refused(f"Unknown block type '{word}'")
    return name


def _display_name(block: str) -> str:
    return {"planks": "Oak Wood Planks"}.get(block, block.replace("_", " ").title())


_COMMANDS: dict[str, Callable[[Realm, list[str]], str]] = {
    "tp": _teleport,
    "teleport": _teleport,
    "fill": _fill,
    "setblock": _setblock,
    "gamemode": _gamemode,
    "gamerule": _gamerule,
    "time": _time,
    "weather": _weather,
    "difficulty": _difficulty,
    "give": _give,
    "clear": _clear,
    "item": _item,
    "replaceitem": _replaceitem,
    "effect": _effect,
    "kill": _kill,
    "clone": clone,
    "testforblocks": testforblocks,
    "execute": _execute,
}
