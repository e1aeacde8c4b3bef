"""The window's picture: the world below, the GUI above, drawn by OpenGL.

The GUI is to the pixel what the client's painter draws. The part of the window that it covers is split into triangles:
each pixel is in one of them at most.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

import moderngl
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Block
from sim.client.client import VirtualClient
from sim.client.drawing.layers import LayeredPicture, Rect, intersection
from sim.client.drawing.painter import ViewLayers
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import Eye, View
from sim.window.frame_pacer import SmoothEye
from sim.window.world_scene import WorldScene

TILE = 16
"""The side of a tile, in pixels: a tile with anything in it is covered whole."""


def triangles(rects: Sequence[Rect], size: tuple[int, int]) -> NDArray[np.float32]:
    """Return the corners (n, 2) of triangles that cover the rectangles' tiles, in a window of ``size`` pixels.

    Rectangles are in pixels from the upper left corner; corners are OpenGL's, from -1 to 1, y upwards.
    """
    width, height = size
    is_covered = np.zeros((-(-height // TILE), -(-width // TILE)), bool)
    for rect in rects:
        if (inside := intersection(rect, (0, 0, width, height))) is not None:
            left, top, right, bottom = inside
            is_covered[top // TILE : -(-bottom // TILE), left // TILE : -(-right // TILE)] = True
    corners = [corner for row, tiles in enumerate(is_covered) for corner in _row_corners(row, tiles.tolist())]
    ends = np.array(corners, np.float32).reshape(-1, 2) * (2 * TILE)
    return np.asarray(ends / (width, height) * (1, -1) + (-1, 1), np.float32)


def _row_corners(row: int, tiles: list[bool]) -> Iterator[tuple[int, int]]:
    """Yield two triangles for each run of covered tiles in a row, in tiles."""
    at = 0
    for is_covered, run in groupby(tiles):
        end = at + len(list(run))
        if is_covered:
            yield from ((at, row), (end, row), (end, row + 1), (at, row), (end, row + 1), (at, row + 1))
        at = end


_VERTEX = """
#version 330
in vec2 corner;
void main() { gl_Position = vec4(corner, 0.0, 1.0); }
"""

# Drawn over black and over white, a layer shows how much of what is behind it can be seen: 1 - (white - black).
_FRAGMENT = """
#version 330
uniform sampler2D over_black; uniform sampler2D over_white; uniform int height;
out vec4 pixel;
void main() {
    ivec2 at = ivec2(gl_FragCoord.x, height - 1 - int(gl_FragCoord.y));
    vec3 black = texelFetch(over_black, at, 0).rgb, white = texelFetch(over_white, at, 0).rgb;
    pixel = vec4(black, 1.0 - clamp(white.g - black.g, 0.0, 1.0));
}
"""


class GuiOverlay:
    """The GUI of a window of one size; it draws over what the framebuffer in use shows.

    Args:
        context: the window's.
        size: width and height in framebuffer pixels.
        layers: what a view's GUI is made of.
    """

    def __init__(self, context: moderngl.Context, size: tuple[int, int], layers: ViewLayers) -> None:
        self._context, self._layers = context, layers
        width, height = size
        self._backgrounds = [np.full((height, width, 3), shade, np.uint8) for shade in (0, 255)]
        self._pictures = [LayeredPicture(background) for background in self._backgrounds]
        self._textures = [context.texture(size, 3, alignment=1) for _ in self._backgrounds]
        for texture in self._textures:
            texture.swizzle = "BGR1"
        program = context.program(vertex_shader=_VERTEX, fragment_shader=_FRAGMENT)
        program["over_black"], program["over_white"], program["height"] = 0, 1, height
        self._program, self._size = program, size
        self._corners = context.buffer(reserve=8, dynamic=True)
        self._array = context.vertex_array(program, [(self._corners, "2f", "corner")])
        self._count = 0
        self._shown: View | None = None

    def show(self, view: View) -> None:
        """Show the GUI of a view; the world behind it stays visible."""
        if view == self._shown:
            return
        self._shown = view
        layers = self._layers.of(view)
        self._cover([layer.rect for layer in layers])
        for picture, background, texture in zip(self._pictures, self._backgrounds, self._textures, strict=True):
            picture.show(background, layers)
            texture.write(picture.grab())

    def show_picture(self, picture: Frame) -> None:
        """Show a picture (height, width, 3), blue green red, that hides the world."""
        self._shown = None
        self._cover([(0, 0, *self._size)])
        for texture in self._textures:
            texture.write(np.ascontiguousarray(picture))

    def draw(self) -> None:
        """Draw it over the framebuffer in use."""
        for unit, texture in enumerate(self._textures):
            texture.use(unit)
        self._context.enable(moderngl.BLEND)
        self._context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._array.render(moderngl.TRIANGLES, self._count)
        self._context.disable(moderngl.BLEND)

    def _cover(self, rects: Sequence[Rect]) -> None:
        """Draw only where these rectangles are: most of the world has nothing over it."""
        corners = triangles(rects, self._size)
        self._count = len(corners)
        if len(corners):
            self._corners.orphan(corners.nbytes)
            self._corners.write(corners.tobytes())

    def release(self) -> None:
        """Free what OpenGL holds for it."""
        for texture in self._textures:
            texture.release()
        self._array.release()
        self._corners.release()
        self._program.release()


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
        """Take what this frame shows from the client; return whether it differs from the last one."""
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
