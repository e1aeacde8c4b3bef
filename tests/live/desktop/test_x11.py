"""Windows of an X server, with the server's answers made up; test_desktop.py has a real one."""

import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import pytest

from mc_nested.errors import DesktopError

if not sys.platform.startswith("linux"):
    pytest.skip("windows of an X server", allow_module_level=True)

from Xlib import X
from Xlib.error import ConnectionClosedError
from Xlib.xobject.drawable import Window

from mc_nested.live.desktop.x11 import RootlessWindow, X11Window
from mc_nested.live.devices import DesktopArea

if TYPE_CHECKING:
    from Xlib.display import Display

TITLE = "Minecraft 1.20.1"
ATOMS = {"_NET_WM_STATE": 300, "_NET_WM_STATE_FOCUSED": 301, "_NET_WM_STATE_HIDDEN": 302}


class FakeWindow(Window):
    """A window in a tree of windows."""

    def __init__(self, parent: "FakeWindow | None" = None) -> None:
        self.parent, self.under_pointer = parent, None
        self.map_state = X.IsViewable
        self.size, self.corner = (320, 240), (60, 40)
        self.is_gone = False
        self.states: list[int] | None = None

    under_pointer: "FakeWindow | None"

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = Window.__hash__

    def query_tree(self) -> Any:
        return SimpleNamespace(parent=self.parent or X.NONE)

    def query_pointer(self) -> Any:
        return SimpleNamespace(child=self.under_pointer or X.NONE)

    def get_attributes(self) -> Any:
        if self.is_gone:
            raise ConnectionClosedError("gone")
        return SimpleNamespace(map_state=self.map_state)

    def get_geometry(self) -> Any:
        if self.is_gone:
            raise ConnectionClosedError("gone")
        return SimpleNamespace(width=self.size[0], height=self.size[1])

    def get_full_property(self, property: int, property_type: int, sizehint: int = 10) -> Any:  # noqa: A002, ARG002 - its own
        assert property == ATOMS["_NET_WM_STATE"]
        return None if self.states is None else SimpleNamespace(value=self.states)

    def translate_coords(self, src_window: Any, _x: int, _y: int) -> Any:
        return SimpleNamespace(x=src_window.corner[0], y=src_window.corner[1])


class Server:
    """An X server with a game's window inside a frame, and another window beside it."""

    def __init__(self) -> None:
        self.root = FakeWindow()
        self.frame = FakeWindow(self.root)
        self.game = FakeWindow(self.frame)
        self.canvas = FakeWindow(self.game)
        self.other = FakeWindow(self.root)
        self.focus: object = self.game
        self.window = X11Window(cast("Display", self), self.game, TITLE)

    def screen(self) -> Any:
        return SimpleNamespace(root=self.root)

    def get_atom(self, name: str) -> int:
        return ATOMS[name]

    def get_input_focus(self) -> Any:
        return SimpleNamespace(focus=self.focus)

    def point_at(self, *chain: FakeWindow) -> None:
        """Put the pointer over these windows, from the root inwards."""
        for outer, inner in zip((self.root, *chain), chain, strict=False):
            outer.under_pointer = inner


def test_a_window_is_in_front_if_it_or_a_child_has_the_focus() -> None:
    server = Server()
    assert server.window.is_in_front()
    server.focus = server.canvas
    assert server.window.is_in_front()


def test_a_window_is_not_in_front_if_another_or_none_has_the_focus() -> None:
    server = Server()
    server.point_at(server.frame, server.game)
    for focus in (server.other, X.NONE):
        server.focus = focus
        assert not server.window.is_in_front()


@pytest.mark.parametrize("holder", ["root", "frame", "pointer root"])
def test_a_window_whose_parent_has_the_focus_is_in_front_under_the_pointer(holder: str) -> None:
    server = Server()
    server.focus = {"root": server.root, "frame": server.frame, "pointer root": X.PointerRoot}[holder]
    server.point_at(server.frame, server.game, server.canvas)
    assert server.window.is_in_front()
    server.point_at(server.other)
    assert not server.window.is_in_front()


def test_the_client_area_is_counted_from_the_root_windows_corner() -> None:
    assert Server().window.client_area() == DesktopArea(60, 40, 320, 240)


def test_a_window_that_is_not_shown_or_has_no_area_is_minimised() -> None:
    server = Server()
    server.game.map_state = X.IsUnmapped
    with pytest.raises(DesktopError, match="minimised"):
        server.window.client_area()
    kept_by_gnome = Server()
    kept_by_gnome.game.states = [ATOMS["_NET_WM_STATE_FOCUSED"]]
    assert kept_by_gnome.window.client_area()
    kept_by_gnome.game.states.append(ATOMS["_NET_WM_STATE_HIDDEN"])
    with pytest.raises(DesktopError, match="minimised"):
        kept_by_gnome.window.client_area()
    empty = Server()
    empty.game.size = (320, 0)
    with pytest.raises(DesktopError, match="minimised"):
        empty.window.client_area()


def test_picturing_a_destroyed_rootless_window_says_that_it_has_closed() -> None:
    server = Server()
    window = RootlessWindow(cast("Display", server), server.game, TITLE)
    server.game.is_gone = True
    with pytest.raises(DesktopError, match=f"'{TITLE}' has closed"):
        window.picture(DesktopArea(60, 40, 320, 240))


def test_asking_a_destroyed_window_for_its_area_says_that_it_has_closed() -> None:
    server = Server()
    server.game.is_gone = True
    with pytest.raises(DesktopError, match=f"'{TITLE}' has closed"):
        server.window.client_area()
