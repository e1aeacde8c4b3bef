"""Draws scripts/rehearsal.png, README's picture of the rehearsal window: the diamond, half built.

    python scripts/draw_rehearsal.py [OUT]

On Linux it needs a display with OpenGL; Xvfb's will do: xvfb-run -a python scripts/draw_rehearsal.py
"""

import sys
from pathlib import Path

import cv2
import moderngl
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.profile.arena import Arena
from sim.client.client import VirtualClient
from sim.client.game.realm import Stack
from sim.window.glfw_window import open_glfw_window
from sim.window.window_picture import WindowPicture

SIZE = (854, 480)
BUILT = 13
PITCH = 27.0


def main() -> int:
    """Draw it; the exit code."""
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("rehearsal.png")
    arena = Arena.around((0, 64, 0), "south")
    x, y, z = arena.block_of((7, 0))
    client = VirtualClient(size=SIZE, floor_block="grass_block", feet=(x + 0.5, float(y), z - 0.9), pitch=PITCH)
    scenario = load_scenario("diamond")
    for cell in sorted(scenario.design, key=lambda cell: cell[1])[:BUILT]:
        client.realm.world.put(arena.block_of(cell), "stone")
    for across in range(-1, 16):
        for right, forward in ((across, -1), (across, 15), (-1, across), (15, across)):
            client.realm.world.put((x + 7 - right, y - 1, z + forward), "glowstone")
    client.realm.player.hotbar[:2] = [Stack("oak_planks", 64), Stack("stone", 64)]
    client.realm.player.slot = 1
    client.clock.sleep(0.5)
    with open_glfw_window("Minecraft", SIZE) as window:
        context = moderngl.create_context(require=330)
        picture = WindowPicture(context, client)
        picture.has_changed()
        picture.draw()
        pixels = np.frombuffer(context.screen.read(window.size, 3, alignment=1), np.uint8)
        cv2.imwrite(str(out), pixels.reshape(*window.size[::-1], 3)[::-1, :, ::-1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
