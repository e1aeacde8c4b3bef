"""The virtual mouse."""

from collections.abc import Callable

from mc_nested.live.devices import Button
from sim.client.desktop.clock import VirtualClock
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls
from sim.client.game.game import VirtualGame


class VirtualPointer:
    """The desktop's mouse. While the game holds it, it stays in the window's middle and moving it turns the view.

    Args:
        clock: the time of a click.
        window: the window that the mouse is over.
        game: the game, which holds the mouse while its world is played.
        controls: takes clicks and turns.
        scale: gives the GUI scale, framebuffer pixels to a GUI pixel.
    """

    def __init__(
        self,
        clock: VirtualClock,
        window: VirtualWindow,
        game: VirtualGame,
        controls: Controls,
        scale: Callable[[], int],
    ) -> None:
        self._clock, self._window, self._game, self._controls = clock, window, game, controls
        self._scale = scale
        self._ignores_move = False

    @property
    def is_held(self) -> bool:
        """Whether the game keeps the mouse to itself: its world is played, in front."""
        return self._window.is_in_front and self._game.screen == "world"

    def position(self) -> tuple[int, int]:
        return self._middle() if self.is_held else self._window.pointer

    def move(self, x: int, y: int) -> None:
        if not self.is_held:
            self._window.pointer = (x, y)
            self._game.pointer = self._in_gui_pixels(x, y)
            self._ignores_move = True
            return
        if self._ignores_move:
            # The first movement after the game has taken the mouse is lost (FACTS: Keys).
            self._ignores_move = False
            return
        middle = self._middle()
        right, down = x - middle[0], y - middle[1]
        self._window.deliver(lambda: self._controls.turn(right, down))

    def press(self, button: Button) -> None:
        self._window.press(f"{button} button", self._event(button, is_down=True))

    def release(self, button: Button) -> None:
        self._window.release(f"{button} button", self._event(button, is_down=False))

    def _event(self, button: Button, *, is_down: bool) -> Callable[[], None]:
        position, scale = self._in_gui_pixels(*self.position()), self._scale()
        width, height = self._window.size
        gui_size = -(-width // scale), -(-height // scale)
        return lambda: self._controls.button(button, position, gui_size, self._clock.now(), is_down=is_down)

    def _middle(self) -> tuple[int, int]:
        return self._window.size[0] // 2, self._window.size[1] // 2

    def _in_gui_pixels(self, x: int, y: int) -> tuple[int, int]:
        scale = self._scale()
        return x // scale, y // scale
