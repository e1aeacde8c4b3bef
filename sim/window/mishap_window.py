"""A real window that mishaps happen to."""

from sim.client.client import VirtualClient
from sim.client.settings import Size
from sim.window.glfw_window import GlfwWindow


class MishapWindow:
    """A client in a real window, as mishaps find it: the desktop's part is done to the window itself."""

    def __init__(self, window: GlfwWindow, client: VirtualClient) -> None:
        self._window, self._client = window, client
        self.clock, self.game, self.window = client.clock, client.game, client.window

    def set_front(self, *, is_in_front: bool) -> None:
        self._window.set_front(is_in_front=is_in_front)

    def stall(self, seconds: float) -> None:
        self._client.stall(seconds)

    def freeze(self, seconds: float) -> None:
        self._client.freeze(seconds)

    def blacken(self, seconds: float) -> None:
        self._client.blacken(seconds)

    def resize(self, size: Size) -> None:
        self._window.resize(size)

    def shift_window(self, right: int, down: int) -> None:
        self._window.shift(right, down)
