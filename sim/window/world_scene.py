"""The world in three dimensions, through OpenGL: the floor, the blocks, the one looked at, and the one in the hand."""

from dataclasses import dataclass

import moderngl

from mc_nested.live.model.reading import Block
from sim.client.drawing.block_colours import block_colour
from sim.client.game.realm import Realm
from sim.client.game.world import block_of
from sim.window.camera import Matrix, held_block, projection, view
from sim.window.cubes import FAR, Floats, cubes, floor_square, outline, row_of, unit_cube

SKY = (0.47, 0.65, 1.0)

_VERTEX = """
#version 330
uniform mat4 camera;
in vec3 corner; in vec3 normal; in vec3 offset; in vec3 colour;
out vec3 at; out vec3 towards; out vec3 shade;
void main() {
    at = corner + offset;
    towards = normal;
    shade = colour;
    gl_Position = camera * vec4(at, 1.0);
}
"""

_FRAGMENT = """
#version 330
uniform vec3 eye; uniform vec3 sky; uniform float far; uniform vec3 origin;
in vec3 at; in vec3 towards; in vec3 shade;
out vec4 pixel;
float noise(vec3 dot3) { return fract(sin(dot(dot3, vec3(12.9898, 78.233, 37.719))) * 43758.5453); }
void main() {
    // A grain of 16 x 16 dots a face, as in the game's pictures, and a darker rim, so that cells can be told apart.
    vec3 within = at - 0.01 * towards;
    float grain = 0.88 + 0.16 * noise(floor((within + origin) * 16.0));
    vec3 inside = fract(within);
    vec2 face = abs(towards.y) > 0.5 ? inside.xz : abs(towards.x) > 0.5 ? inside.zy : inside.xy;
    vec2 rim = min(face, 1.0 - face);
    float edge = min(rim.x, rim.y) < 0.03125 ? 0.82 : 1.0;
    float light = towards.y > 0.5 ? 1.0 : towards.y < -0.5 ? 0.5 : abs(towards.z) > 0.5 ? 0.8 : 0.62;
    float fog = smoothstep(0.35 * far, far, distance(at, eye));
    pixel = vec4(mix(min(shade * grain * edge * light, 1.0), sky, fog), 1.0);
}
"""

_BLACK = """
#version 330
out vec4 pixel;
void main() { pixel = vec4(0.0, 0.0, 0.0, 1.0); }
"""

_GRAIN = 64
"""Blocks after which the grain repeats: a larger number would leave the noise too few digits."""

_LOWER = 0.002
"""Blocks by which the floor is drawn lower than what is built into it."""


@dataclass(frozen=True)
class Eye:
    """Where the camera is: its position in blocks, its view in degrees."""

    position: tuple[float, float, float]
    yaw: float
    pitch: float


class WorldScene:
    """Draws a realm into the framebuffer in use."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._blocks = context.program(vertex_shader=_VERTEX, fragment_shader=_FRAGMENT)
        self._lines = context.program(vertex_shader=_VERTEX, fragment_shader=_BLACK)

    def draw(self, realm: Realm, eye: Eye, size: tuple[int, int], target: Block | None) -> None:
        """The world as seen from ``eye``, in a window of ``size`` pixels; ``target`` is outlined."""
        world, player = realm.world, realm.player
        origin = block_of(eye.position)
        x, y, z = (part - own for part, own in zip(eye.position, origin, strict=True))
        perspective = projection(*size)
        self._context.clear(*SKY, depth=1.0)
        self._context.enable(moderngl.DEPTH_TEST)
        self._look(perspective @ view((x, y, z), eye.yaw, eye.pitch), (x, y, z), origin)
        floor = row_of((0.0, world.floor - origin[1] - _LOWER, 0.0), block_colour(world.floor_block))
        self._render(self._blocks, floor_square(), floor)
        self._render(self._blocks, unit_cube(), cubes(world.built(), origin))
        if target is not None:
            at = (float(target[0] - origin[0]), float(target[1] - origin[1]), float(target[2] - origin[2]))
            self._render(self._lines, outline(), row_of(at, (0, 0, 0)), moderngl.LINES)
        self._context.disable(moderngl.DEPTH_TEST)
        stack = player.hotbar[player.slot]
        if stack is not None:
            self._look(perspective @ held_block(), (0.0, 0.0, 0.0), (0, 0, 0))
            # In front of everything: a cube needs no depths where its far sides are left out.
            self._context.enable(moderngl.CULL_FACE)
            self._render(self._blocks, unit_cube(), row_of((0.0, 0.0, 0.0), block_colour(stack.block)))
            self._context.disable(moderngl.CULL_FACE)

    def _look(self, camera: Matrix, eye: tuple[float, float, float], origin: Block) -> None:
        for program in (self._blocks, self._lines):
            program["camera"] = tuple(float(part) for part in camera.T.flat)
        self._blocks["eye"] = eye
        self._blocks["sky"] = SKY
        self._blocks["far"] = float(FAR)
        self._blocks["origin"] = tuple(float(part % _GRAIN) for part in origin)

    def _render(self, program: moderngl.Program, shape: Floats, rows: Floats, mode: int = moderngl.TRIANGLES) -> None:
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
