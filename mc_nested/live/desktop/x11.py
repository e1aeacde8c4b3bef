"""The game's window and the clipboard on an X server, Xwayland among them, with a window manager or without one."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from Xlib import X, Xatom
from Xlib.display import Display
from Xlib.error import ConnectionClosedError, DisplayError, XauthError, XError
from Xlib.xobject.drawable import Window

from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.desktop.window import TitledWindow, check_shown, closed_error, game_window, minimised_error
from mc_nested.live.desktop.x11_clipboard import X11Clipboard
from mc_nested.live.desktop.xwayland import (
    ALLOW,
    PANIC,
    WindowCamera,
    is_rootless,
    is_wayland_session,
    is_xwayland,
    no_x11_window_error,
    no_x_server_error,
)
from mc_nested.live.devices import DesktopArea, Frame


@contextmanager
def open_window(title: str) -> Iterator["X11Window"]:
    """Yield the one window whose title matches, as ``DesktopSystem.open_window``."""
    display = _connect()
    try:
        windows = _titled_windows(display)
        try:
            chosen = game_window(title, [described for _, described in windows])
        except NoWindowError as error:
            raise (no_x11_window_error(error) if is_xwayland(display) else error) from None
        kind = RootlessWindow if is_rootless(display) else X11Window
        window = kind(display, windows[chosen][0], windows[chosen][1].title)
        window.client_area()
        yield window
    finally:
        with suppress(ConnectionClosedError):  # the X server may have ended first
            display.close()


def session_kind() -> str:
    """Return what this session is, in words; raise DesktopError where there is no X server."""
    display = _connect()
    try:
        is_one, is_pictured = is_xwayland(display), not is_rootless(display)
    finally:
        display.close()
    if not is_one:
        return f"X11, display {os.environ['DISPLAY']}"
    if is_pictured:
        return f"Xwayland in one window, display {os.environ['DISPLAY']}; {PANIC}"
    return f"Xwayland, display {os.environ['DISPLAY']}; {ALLOW}"


def open_clipboard() -> X11Clipboard:
    """Return the X server's clipboard, not read yet."""
    return X11Clipboard()


class X11Window:
    """A window, queried each time; a round trip to the X server takes some tens of microseconds."""

    def __init__(self, display: Display, window: Window, title: str) -> None:
        self._display = display
        self._root = display.screen().root
        self._window = window
        self._title = title

    def title(self) -> str:
        with self._if_open():
            self._title = _title_of(self._display, self._window)
        return self._title

    def client_area(self) -> DesktopArea:
        with self._if_open():
            if self._window.get_attributes().map_state != X.IsViewable or self._is_minimised():
                raise minimised_error(self._title)
            size = self._window.get_geometry()
            corner = self._root.translate_coords(self._window, 0, 0)
        area = DesktopArea(corner.x, corner.y, size.width, size.height)
        check_shown(area, self._title)
        return area

    def is_in_front(self) -> bool:
        # The X server is asked, not the window manager's _NET_ACTIVE_WINDOW: there may be no window manager, and while
        # one of its own menus or overviews takes the keys, that property still names the game.
        with self._if_open():
            focus = self._display.get_input_focus().focus
            if focus == X.NONE:
                return False
            # With the focus on the root or on an ancestor, keys go to the window that the pointer is over.
            holder = self._root if focus == X.PointerRoot else focus
            return _is_within(holder, self._window) or (
                _is_within(self._window, holder) and self._window in _under_pointer(self._root)
            )

    def _is_minimised(self) -> bool:
        """Return whether it is minimised: GNOME shows such a window to the X server as before, but says so."""
        states = self._window.get_full_property(self._display.get_atom("_NET_WM_STATE"), Xatom.ATOM)
        return states is not None and self._display.get_atom("_NET_WM_STATE_HIDDEN") in states.value

    @contextmanager
    def _if_open(self) -> Iterator[None]:
        try:
            yield
        except (XError, ConnectionClosedError) as error:
            raise closed_error(self._title) from error


class RootlessWindow(X11Window):
    """A window of a rootless Xwayland, which takes its own pictures: the screen can't be pictured there."""

    def __init__(self, display: Display, window: Window, title: str) -> None:
        super().__init__(display, window, title)
        self._camera = WindowCamera(display, window)

    def picture(self, area: DesktopArea) -> Frame:
        """Return this window's pixels in that area of the desktop, whatever covers them.

        Raise DesktopError where it has closed.
        """
        with self._if_open():
            return self._camera(area)


def _connect() -> Display:
    name = os.environ.get("DISPLAY")
    if not name:
        if is_wayland_session():
            raise no_x_server_error()
        raise DesktopError("no display (DISPLAY is not set): run this in the desktop session that shows the game")
    try:
        return Display(name)
    except (DisplayError, XauthError, ConnectionClosedError, OSError) as error:
        raise DesktopError(
            f"no display (DISPLAY={name} can't be reached): run this in the desktop session that shows the game"
        ) from error


def _titled_windows(display: Display) -> list[tuple[Window, TitledWindow]]:
    root = display.screen().root
    managed = root.get_full_property(display.intern_atom("_NET_CLIENT_LIST"), X.AnyPropertyType)
    if managed is not None and len(managed.value):
        windows = [display.create_resource_object("window", each) for each in managed.value]
    else:
        windows = list(_shown_below(root))
    titled = [(window, _described_if_open(display, window)) for window in windows]
    return [(window, described) for window, described in titled if described.title]


def _shown_below(window: Window) -> Iterator[Window]:
    try:
        children = window.query_tree().children
    except XError:  # closed since it was listed
        return
    for child in children:
        if _is_shown(child):
            yield child
            yield from _shown_below(child)


def _is_shown(window: Window) -> bool:
    try:
        return bool(window.get_attributes().map_state == X.IsViewable)
    except XError:  # closed since it was listed
        return False


def _described_if_open(display: Display, window: Window) -> TitledWindow:
    try:
        return TitledWindow(_title_of(display, window), " ".join(window.get_wm_class() or ()))
    except XError:  # closed since it was listed
        return TitledWindow("")


def _title_of(display: Display, window: Window) -> str:
    for atom in (display.intern_atom("_NET_WM_NAME"), Xatom.WM_NAME):
        text = window.get_full_text_property(atom)
        if text:
            return text if isinstance(text, str) else text.decode("utf-8", "replace")
    return ""


def _is_within(window: Window, outer: Window) -> bool:
    """Return whether ``window`` is ``outer`` or lies below it in the tree of windows."""
    each = window
    while each != outer:
        parent = each.query_tree().parent
        if not isinstance(parent, Window):
            return False
        each = parent
    return True


def _under_pointer(root: Window) -> list[Window]:
    chain = [root]
    while True:
        child = chain[-1].query_pointer().child
        if not isinstance(child, Window):
            return chain
        chain.append(child)
