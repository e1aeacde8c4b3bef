"""The window's picture: the world below, the GUI above."""

import moderngl

from sim.client.client import VirtualClient
from sim.client.game.screens import IN_WORLD
from sim.window.gui_overlay import GuiOverlay
from sim.window.smooth_eye import SmoothEye
from sim.window.world_scene import WorldScene


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
        self._overlay = self._new_overlay()

    def draw(self) -> None:
        """Draw this frame."""
        client, size = self._client, self._client.window.size
        if size != self._size:
            self._size = size
            self._overlay.release()
            self._overlay = self._new_overlay()
        self._context.viewport = (0, 0, *size)
        if client.display.is_black():
            self._context.clear()
            return
        view = client.display.seen()
        if view.menu.name in IN_WORLD:
            target = client.game.target_block(client.game.reach()) if view.hotbar else None
            eye = self._eye.at(client.clock.now())
            self._scene.draw(client.realm, eye, size, target.block if target else None)
            self._overlay.show(view)
        else:
            self._overlay.show_picture(client.display.painter.grab(view))
        self._overlay.draw()

    def _new_overlay(self) -> GuiOverlay:
        return GuiOverlay(self._context, self._size, self._client.new_layers())
