"""The contract of every game's devices, asked in the same words of the virtual client and of a real window.

As a program it asks the real window of this display, and prints the answers: devices_contract.py TRUTH_FILE.
"""

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

from mc_nested.live.desktop import open_desktop
from mc_nested.live.devices import Devices
from mc_nested.live.model.kinematics import TICK_S
from scripts.rehearsal_window import TruthReader
from sim.client.client import VirtualClient
from sim.window.rehearsal import truth_of

SOON_S = 0.5
CLICKS = 20
MENU_POINT = (120, 80)

Truth = Callable[[], dict[str, Any]]
"""What is so in the game: its screen, the player's feet, yaw and pitch, the block in hand, the keys that are down."""


def answers(devices: Devices, truth: Truth) -> dict[str, Any]:
    """Return what comes of keys, clicks, text, the mouse and the clipboard, one after the other, in a new world."""
    keyboard, pointer, clock = devices.keyboard, devices.pointer, devices.clock
    found: dict[str, Any] = {}

    def wait(seconds: float = SOON_S) -> None:
        clock.sleep_until(clock.now() + seconds)

    def tap(*keys: str) -> None:
        for key in keys:
            keyboard.press(key)
            wait(TICK_S)
        for key in reversed(keys):
            keyboard.release(key)
        wait()

    found["title"], found["size"] = devices.display.title(), devices.display.size()
    found["picture"] = devices.display.grab().shape
    keyboard.press("w")
    wait(4 * TICK_S)
    found["down"] = truth()["keys_down"]
    keyboard.release("w")
    wait(1.0)
    feet = truth()["feet"]
    found["walked on"], found["aside"] = 0.3 < feet[2] - 0.5 < 1.6, feet[0] - 0.5
    for _ in range(CLICKS):
        pointer.press("right")
        wait(TICK_S)
        pointer.release("right")
        wait(TICK_S)
    found["view after clicks"] = [truth()["yaw"], truth()["pitch"]]
    tap("t")
    found["after t"] = truth()["screen"]
    keyboard.type("/tp @s 8.5 64 ~-2 90 40")
    wait()
    tap("enter")
    found["sent"] = [truth()["screen"], truth()["feet"][0], truth()["yaw"], truth()["pitch"]]
    tap("t")
    keyboard.type("/item replace entity @s hotbar.0 with stone 64")
    wait()
    tap("enter")
    found["in hand"] = truth()["block_in_hand"]
    tap("2")
    found["second slot"] = truth()["block_in_hand"]
    tap("f3", "c")
    found["copied"] = devices.clipboard.read().split(" run ")[0]
    tap("esc")
    found["after esc"] = truth()["screen"]
    pointer.move(*MENU_POINT)
    wait()
    found["mouse"] = pointer.position()
    tap("esc")
    found["after another"], found["up"] = truth()["screen"], truth()["keys_down"]
    said: dict[str, Any] = json.loads(json.dumps(found))
    return said


def virtual_answers() -> dict[str, Any]:
    """Return the virtual client's answers."""
    client = VirtualClient(floor_block="grass_block")
    return answers(client.devices, lambda: truth_of(client))


def main() -> None:
    """Ask the window of this display."""
    with open_desktop("^Minecraft") as devices:
        deadline = time.monotonic() + 10
        while not devices.display.is_in_front() and time.monotonic() < deadline:
            time.sleep(0.05)
        print(json.dumps(answers(devices, TruthReader(Path(sys.argv[1])).now)))


if __name__ == "__main__":
    main()
