"""Sends a line through the chat of the game in front, and prints what is said of it.

usage: chat_probe.py FONT LINE. A process of its own, since pyautogui keeps to the display of its import.
"""

import sys
import time
from contextlib import ExitStack

from mc_nested.errors import McNestedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.desktop import open_desktop
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.chat import Chat
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.profile.tables import Profile, ScreenTable

PATIENCE_S = 20.0


def main(font: str, line: str) -> None:
    profile = Profile(screen=ScreenTable(font=font))
    with ExitStack() as opened:
        devices = opened.enter_context(open_desktop(profile.window.title))
        unread = GameConnection(devices, InputController(devices, profile.input))
        connection = opened.enter_context(unread.for_profile(profile))
        end = time.monotonic() + PATIENCE_S
        while not devices.display.is_in_front() and time.monotonic() < end:
            time.sleep(0.1)
        wait_until_standing_still(connection)
        connection.controller.confirm_screen("world")
        try:
            Chat(profile, connection).send(line)
        except McNestedError as error:
            print(error)
        else:
            print("sent")


if __name__ == "__main__":
    main(*sys.argv[1:])
