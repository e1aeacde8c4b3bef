"""OpenGL and the client's own drawing show the same world; only the grain of the blocks is the window's alone."""

import sys

import numpy as np
import pytest

from sim.client.client import VirtualClient
from sim.client.drawing.painter import SEEN
from sim.client.game.realm import Stack
from sim.client.game.view import Eye

if sys.platform != "linux":
    pytest.skip("a display of an X server", allow_module_level=True)

pytestmark = pytest.mark.window

SIZE = (854, 480)


@pytest.mark.parametrize(("pitch", "yaw"), [(65.0, 0.0), (30.0, -130.0), (0.0, 75.0)])
def test_the_window_and_the_client_draw_the_same_world(
    pitch: float, yaw: float, display: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import moderngl

    from sim.window.world_scene import WorldScene

    monkeypatch.setenv("DISPLAY", display["DISPLAY"])
    client = VirtualClient(world=SEEN, size=SIZE, pitch=pitch, yaw=yaw)
    for block, name in (((0, 64, 2), "stone"), ((1, 64, -3), "sand"), ((-4, 64, 1), "dirt"), ((1, 63, 1), "obsidian")):
        client.realm.world.put(block, name)
    client.realm.player.hotbar[0] = Stack("oak_planks", 64)
    client.game.hides_hud = True
    client.clock.sleep(0.3)
    with moderngl.create_context(standalone=True, require=330) as context:
        picture = context.simple_framebuffer(SIZE, 3)
        picture.use()
        WorldScene(context).draw(client.realm, Eye(client.realm.eye(), yaw, pitch), SIZE, None)
        read = np.frombuffer(picture.read(components=3), np.uint8)
    by_window = read.reshape(SIZE[1], SIZE[0], 3)[::-1, :, ::-1].astype(int)
    away = np.abs(by_window - client.display.grab()).max(2)
    assert away.mean() < 8
    assert np.mean(away > 40) < 0.02
