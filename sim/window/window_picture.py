"""The window's picture: the world below, the GUI above."""

from dataclasses import dataclass

import moderngl

from mc_nested.live.model.reading import Block
from sim.client.client import VirtualClient
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import Eye, View
from sim.window.frame_pacer import SmoothEye
from sim.window.gui_overlay import GuiOverlay
from sim.window.world_scene import WorldScene


@dataclass(frozen=True)
class Shown:
    """All that a frame depends on; ``eye`` is None outside a world."""

    view: View
    size: tuple[int, int]
    is_black: bool
    eye: Eye | None
    target: Block | None
    revision: int


class WindowPicture:
    """Draws what a client's desktop shows, a frame at a time.

    Args:
        context: OpenGL's, current in this thread.
        client: what is shown.
    """

    def __init__(self, context: moderngl.Context, client: VirtualClient) -> None:
        self._context, self._client = context, client
        self._scene = WorldScene(context)
        self._eye = SmoothEye(client.game)
        self._size = client.window.size
        self._shown: Shown | None = None
        self._overlay = self._new_overlay()

    def has_changed(self) -> bool:
        """Take what this frame shows from the client; whether it differs from the last one."""
        client = self._client
        view = client.display.seen()
        eye, target = None, None
        if view.menu.name in IN_WORLD:
            eye = self._eye.at(client.clock.now())
            hit = client.game.target_block(client.game.reach()) if view.hotbar else None
            target = hit.block if hit else None
        shown = Shown(view, client.window.size, client.display.is_black(), eye, target, client.realm.world.revision)
        before, self._shown = self._shown, shown
        return shown != before

    def draw(self) -> None:
        """Draw what ``has_changed`` took."""
        shown = self._shown
        if shown is None:
            return
        if shown.size != self._size:
            self._size = shown.size
            self._overlay.release()
            self._overlay = self._new_overlay()
        self._context.viewport = (0, 0, *shown.size)
        if shown.is_black:
            self._context.clear()
            return
        if shown.eye is not None:
            self._scene.draw(self._client.realm, shown.eye, shown.size, shown.target)
            self._overlay.show(shown.view)
        else:
            self._overlay.show_picture(self._client.display.painter.grab(shown.view))
        self._overlay.draw()

    def _new_overlay(self) -> GuiOverlay:
        return GuiOverlay(self._context, self._size, self._client.new_layers())
