"""A line typed into the chat: a message, or a command and the game's answer to it (FACTS: Commands; Answers)."""

from collections.abc import Callable
from dataclasses import dataclass

from sim.client.game.commands import blocks, player
from sim.client.game.commands.words import CommandRefusedError
from sim.client.game.realm import Realm

_Command = Callable[[Realm, list[str]], str]


@dataclass(frozen=True)
class Answer:
    """A line in the chat."""

    text: str
    is_error: bool = False


def run(line: str, realm: Realm) -> list[Answer]:
    """Carry out a line typed into the chat, and return the game's answers."""
    if not line.startswith("/"):
        return [Answer(f"<{realm.player_name}> {line}")] if line.strip() else []
    name, *words = line[1:].split() or [""]
    command = _command(name, realm)
    # Without cheats, newer versions don't know the command at all.
    is_hidden = not realm.has_cheats and realm.edition.since(1, 13)
    if command is None or is_hidden or _has_unknown_inside(name, words, realm):
        return _unknown(line, realm)
    try:
        if not realm.has_cheats:
            raise CommandRefusedError("You do not have permission to use this command")
        answer = command(realm, words)
    except CommandRefusedError as refusal:
        return [Answer(str(refusal), is_error=True)]
    except (ValueError, IndexError):
        if not realm.edition.since(1, 13):
            return [Answer(f"Usage: /{line[1:].split()[0]}", is_error=True)]
        return [Answer("Incorrect argument for command", is_error=True), _here(line)]
    is_answered = answer and realm.rule("sendCommandFeedback", "send_command_feedback", True)
    return [Answer(answer)] if is_answered else []


def _command(name: str, realm: Realm) -> _Command | None:
    """Return the command of that name, if this version has it."""
    name = name.removeprefix("minecraft:")
    return _COMMANDS.get(name) if _is_known(name, realm) else None


def _has_unknown_inside(name: str, words: list[str], realm: Realm) -> bool:
    """Return whether a line of 1.13 or later has an /execute of an unknown command: the game refuses to run it."""
    if name.removeprefix("minecraft:") != "execute" or not realm.edition.since(1, 13) or "run" not in words:
        return False
    inner = words[words.index("run") + 1 :]
    return not inner or _command(inner[0], realm) is None or _has_unknown_inside(inner[0], inner[1:], realm)


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
    if not edition.since(1, 16):
        return [Answer("Unknown command", is_error=True), _here(line)]
    joint = ". See" if edition.since(1, 21, 9) else ", see"
    return [Answer(f"Unknown or incomplete command{joint} below for error", is_error=True), _here(line)]


def _here(line: str) -> Answer:
    typed = line[1:]
    return Answer(f"{'...' if len(typed) > 10 else ''}{typed[-10:]}<--[HERE]", is_error=True)


def _execute(realm: Realm, words: list[str]) -> str:
    def run_words(realm: Realm, words: list[str]) -> str:
        command = _command(words[0].removeprefix("/"), realm)
        if command is None:  # from 1.13 on the line was refused before
            raise CommandRefusedError(f"Failed to execute '{' '.join(words)}' as {realm.player_name}")
        return command(realm, words[1:])

    return blocks.execute(realm, words, run_words)


_COMMANDS: dict[str, _Command] = {
    "tp": player.teleport,
    "fill": blocks.fill,
    "gamemode": player.gamemode,
    "gamerule": player.gamerule,
    "time": player.time,
    "weather": player.weather,
    "difficulty": player.difficulty,
    "item": player.item,
    "replaceitem": player.replaceitem,
    "clone": blocks.clone,
    "testforblocks": blocks.testforblocks,
    "execute": _execute,
}
