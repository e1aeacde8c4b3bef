"""Handle keys, buttons and the mouse on each screen when they reach the game (FACTS: Keys)."""

from collections.abc import Callable

from sim.client.game.game import VirtualGame
from sim.client.game.screens import FRIENDS, menu

DEGREES_A_PIXEL = 0.15
"""How far a movement of the mouse by a pixel turns the view, at the game's own sensitivity (FACTS: Keys)."""

DOUBLE_CLICK_S = 0.25

_F3_LETTERS = frozenset("abcdfghilnpqstv")
_FRIENDS = "o"
_FRIENDS_OPEN_OVER = frozenset({"world", "pause", "paused", "title"})
_CONTROL = ("left.control", "right.control", "ctrl")


class Controls:
    """Passes events on to the game.

    Args:
        game: what is controlled.
        read_clipboard: reads the desktop's clipboard.
        write_clipboard: writes it.
    """

    def __init__(
        self, game: VirtualGame, read_clipboard: Callable[[], str], write_clipboard: Callable[[str], None]
    ) -> None:
        self._game = game
        self._read_clipboard, self._write_clipboard = read_clipboard, write_clipboard
        self.pauses_unfocused = game.options.pause_on_lost_focus
        """``pauseOnLostFocus``, which F3+P changes."""
        self._f3_used = False
        self._f3_keys = {"esc", "f6"} if game.edition.since(1, 21, 9) else {"esc"}
        self._last_click = (-1.0, (-1, -1))

    def key(self, key: str, *, is_down: bool) -> None:
        """A key, by its place on a US keyboard, goes down or up. What it types comes as a character, too."""
        game = self._game
        if not is_down:
            game.keys.physical.discard(key)
            game.keys.release(key)
            if key == "f3" and not self._f3_used and game.is_in_world:
                game.has_f3 = not game.has_f3
            return
        game.keys.physical.add(key)
        if key == _FRIENDS and game.edition.since(26, 2) and game.screen in _FRIENDS_OPEN_OVER:
            game.open_friends()
        elif game.screen == "world":
            self._in_world(key)
        elif game.screen == "chat":
            self._in_chat(key)
        else:
            self._in_menu(key)
        if key == "f3":
            self._f3_used = game.screen != "world"

    def character(self, text: str) -> None:
        """Take a character, which a key typed or a program sent; together with Ctrl none counts."""
        game = self._game
        if game.keys.physical.intersection(_CONTROL):
            return
        if game.screen == "chat":
            game.chat.insert(text)
        elif game.screen == "debug_options":
            game.searched += text

    def button(
        self, button: str, position: tuple[int, int], size: tuple[int, int], now: float, *, is_down: bool
    ) -> None:
        """A mouse button goes down or up at ``position`` in a window of ``size``, both in GUI pixels."""
        game, name = self._game, f"{button} button"
        if not is_down:
            game.keys.physical.discard(name)
            game.keys.release(name)
            return
        game.keys.physical.add(name)
        if game.screen == "world":
            game.keys.press(name)
        elif button == "left":
            self._click(position, size, now)

    def turn(self, right: float, down: float) -> None:
        """Turn the view: the mouse moved by so many pixels while the game holds it."""
        player = self._game.realm.player
        player.look(player.yaw + right * DEGREES_A_PIXEL, player.pitch + down * DEGREES_A_PIXEL)

    def lose_focus(self) -> None:
        """Release every key: another window came to the front."""
        self._game.keys.physical.clear()
        self._game.keys.forget()

    def stay_unfocused(self) -> None:
        """Pause, if the player set that: the window has been without focus for a while."""
        if self.pauses_unfocused and self._game.screen == "world":
            self._game.open("pause")

    def _in_world(self, key: str) -> None:
        game = self._game
        if key != "f3" and "f3" in game.keys.physical and (key in _F3_LETTERS or key in self._f3_keys):
            self._f3_used = True
            self._combine(key)
        elif key == "esc":
            game.open("pause")
        elif key == "f1":
            game.hides_hud = not game.hides_hud
        else:
            game.keys.press(key)

    def _combine(self, key: str) -> None:
        """Do what F3 together with another key does."""
        game = self._game
        player = game.realm.player
        if key == "c" and game.edition.since(1, 13) and not game.is_info_reduced:
            position = " ".join(f"{part:.2f}" for part in (*player.feet, player.yaw, player.pitch))
            self._write_clipboard(f"/execute in minecraft:overworld run tp @s {position}")
            game.chat.say("[Debug]: Copied location to clipboard", game.ticks)
        elif key == "d":
            game.chat.clear()
        elif key == "p":
            self.pauses_unfocused = not self.pauses_unfocused
            state = "enabled" if self.pauses_unfocused else "disabled"
            game.chat.say(f"[Debug]: Pause on lost focus: {state}", game.ticks)
        elif key == "f6":
            game.open("debug_options")
        elif key == "esc":
            game.open("paused" if game.edition.since(1, 14) else "pause")

    def _in_chat(self, key: str) -> None:
        game = self._game
        if key == "esc":
            game.leave_chat()
        elif key == "enter":
            line = (game.chat.typed or "").strip()
            game.chat.close(keeps_draft=False)
            game.open("world")
            if line:
                game.send(line)
        elif key == "backspace":
            game.chat.backspace()
        elif game.keys.physical.intersection(_CONTROL):
            if key == "v":
                game.chat.insert(self._read_clipboard())
            elif key == "a":
                game.chat.is_selected = True

    def _in_menu(self, key: str) -> None:
        game = self._game
        if key == "esc":
            self._escape()
        elif key == "e" and game.screen == "inventory":
            game.open("world")
        elif key == "backspace" and game.screen == "debug_options":
            game.searched = game.searched[:-1]
        elif key == _FRIENDS and game.screen in FRIENDS:
            game.close_friends()
        elif key == "enter" and game.screen == "worlds" and game.is_world_chosen and game.edition.since(1, 16):
            game.do("enter_selected")

    def _escape(self) -> None:
        """Esc closes a screen over the world, and the lists; after a death or a disconnection it does nothing."""
        game = self._game
        if game.screen in ("pause", "paused", "inventory", "debug_options"):
            game.open("world")
        elif game.screen in FRIENDS:
            game.close_friends()
        elif game.screen in ("worlds", "servers"):
            game.open("title")

    def _click(self, position: tuple[int, int], size: tuple[int, int], now: float) -> None:
        game = self._game
        before, self._last_click = self._last_click, (now, position)
        for button in menu(game.view().menu, game.edition, *size).buttons:
            if not button.is_active or not button.contains(*position):
                continue
            twice = button.does == "select_world" and now - before[0] < DOUBLE_CLICK_S and button.contains(*before[1])
            game.do("enter_world" if twice else button.does)
            return
