"""The world in three dimensions, through OpenGL: the floor, the blocks, the one looked at, and the one in the hand."""

from collections.abc import Mapping

import moderngl
import numpy as np

from mc_nested.arrays import Float32s
from mc_nested.live.model.reading import Block
from sim.client.drawing import world_shapes
from sim.client.drawing.world_shapes import (
    FAR,
    GRAIN_BLOCKS,
    Matrix,
    block_colour,
    cubes,
    floor_square,
    grain,
    held_block,
    outline,
    projection,
    row_of,
    unit_cube,
    view,
)
from sim.client.game.realm import Realm
from sim.client.game.view import Eye
from sim.client.game.world import block_of

_VERTEX = """
#version 330
uniform mat4 camera; uniform vec3 origin;
in vec3 corner; in vec3 normal; in vec3 offset; in vec3 colour;
out vec2 on_face; flat out vec3 shade;
void main() {
    vec3 at = corner + offset + origin;
    on_face = abs(normal.y) > 0.5 ? at.xz : abs(normal.x) > 0.5 ? at.zy : at.xy;
    float level = normal.y > 0.5 ? TOP : BOTTOM;
    float upright = abs(normal.z) > 0.5 ? NORTH_AND_SOUTH : EAST_AND_WEST;
    float light = abs(normal.y) > 0.5 ? level : upright;
    shade = colour * light;
    gl_Position = camera * vec4(corner + offset, 1.0);
}
"""

# gl_FragCoord.w is 1 over the distance ahead.
_FRAGMENT = """
#version 330
uniform sampler2D grain; uniform vec3 sky; uniform float far;
in vec2 on_face; flat in vec3 shade;
out vec4 pixel;
void main() {
    float fog = clamp((1.0 / gl_FragCoord.w - FOG_FROM * far) / ((1.0 - FOG_FROM) * far), 0.0, 1.0);
    pixel = vec4(mix(shade * texture(grain, on_face / GRAIN).r, sky, fog), 1.0);
}
"""

_BLACK = """
#version 330
out vec4 pixel;
void main() { pixel = vec4(0.0, 0.0, 0.0, 1.0); }
"""

_CONSTANTS = {
    "GRAIN": GRAIN_BLOCKS,
    "FOG_FROM": world_shapes.FOG_FROM,
    "TOP": world_shapes.TOP,
    "BOTTOM": world_shapes.BOTTOM,
    "NORTH_AND_SOUTH": world_shapes.NORTH_AND_SOUTH,
    "EAST_AND_WEST": world_shapes.EAST_AND_WEST,
}

_LOWER = 0.002
"""Blocks by which the floor is drawn lower than what is built into it."""


def _with_constants(shader: str) -> str:
    defined = "".join(f"\n#define {name} {float(value)}" for name, value in _CONSTANTS.items())
    return shader.replace("#version 330", "#version 330" + defined)


class WorldScene:
    """Draws a realm into the framebuffer in use."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        dots = grain()
        self._grain = context.texture(dots.shape, 1, np.round(dots * 255).astype(np.uint8).tobytes())
        self._grain.build_mipmaps()
        self._grain.filter = (moderngl.NEAREST_MIPMAP_NEAREST, moderngl.NEAREST)
        vertex = _with_constants(_VERTEX)
        self._blocks = context.program(vertex_shader=vertex, fragment_shader=_with_constants(_FRAGMENT))
        self._lines = context.program(vertex_shader=vertex, fragment_shader=_BLACK)
        self._built: tuple[Mapping[Block, str], Block] = ({}, (0, 0, 0))
        self._cubes = cubes(*self._built)

    def draw(self, realm: Realm, eye: Eye, size: tuple[int, int], target: Block | None) -> None:
        """Draw the world as seen from ``eye``, in a window of ``size`` pixels; ``target`` is outlined."""
        world, player = realm.world, realm.player
        origin = block_of(eye.position)
        x, y, z = (part - own for part, own in zip(eye.position, origin, strict=True))
        perspective = projection(*size)
        self._context.clear(*world_shapes.SKY, depth=1.0)
        self._context.enable(moderngl.DEPTH_TEST)
        self._look(perspective @ view((x, y, z), eye.yaw, eye.pitch), origin)
        floor = row_of((0.0, world.floor - origin[1] - _LOWER, 0.0), block_colour(world.floor_block))
        self._render(self._blocks, floor_square(), floor)
        self._render(self._blocks, unit_cube(), self._cubes_of(world.seen(), origin))
        if target is not None:
            at = (float(target[0] - origin[0]), float(target[1] - origin[1]), float(target[2] - origin[2]))
            self._render(self._lines, outline(), row_of(at, (0, 0, 0)), moderngl.LINES)
        self._context.disable(moderngl.DEPTH_TEST)
        stack = player.hotbar[player.slot]
        if stack is not None:
            self._look(perspective @ held_block(), (0, 0, 0))
            # In front of everything: a cube needs no depths where its far sides are left out.
            self._context.enable(moderngl.CULL_FACE)
            self._render(self._blocks, unit_cube(), row_of((0.0, 0.0, 0.0), block_colour(stack.block)))
            self._context.disable(moderngl.CULL_FACE)

    def _cubes_of(self, built: Mapping[Block, str], origin: Block) -> Float32s:
        """Return what ``cubes`` makes of it, made anew only for another mapping or origin."""
        if built is not self._built[0] or origin != self._built[1]:
            self._built, self._cubes = (built, origin), cubes(built, origin)
        return self._cubes

    def _look(self, camera: Matrix, origin: Block) -> None:
        for program in (self._blocks, self._lines):
            program["camera"] = tuple(float(part) for part in camera.T.flat)
        self._blocks["sky"], self._blocks["far"], self._blocks["grain"] = world_shapes.SKY, float(FAR), 0
        # The grain repeats with the blocks, so only the part within it counts; small numbers keep their digits.
        self._blocks["origin"] = tuple(float(part % GRAIN_BLOCKS) for part in origin)
        self._grain.use(0)

    def _render(
        self, program: moderngl.Program, shape: Float32s, rows: Float32s, mode: int = moderngl.TRIANGLES
    ) -> None:
        """Draw a shape (corners, 6) once a row (x, y, z, red, green, blue)."""
        if not len(rows):
            return
        corners, instances = self._context.buffer(shape.tobytes()), self._context.buffer(rows.tobytes())
        names = ("normal", "colour") if program is self._blocks else ("", "")
        shape_format, row_format = ("3f 3f", "3f 3f/i") if program is self._blocks else ("3f 12x", "3f 12x/i")
        array = self._context.vertex_array(
            program,
            [
                (corners, shape_format, *filter(None, ("corner", names[0]))),
                (instances, row_format, *filter(None, ("offset", names[1]))),
            ],
        )
        array.render(mode, instances=len(rows))
        for each in (array, corners, instances):
            each.release()
