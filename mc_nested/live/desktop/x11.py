"""The game's window and the clipboard on an X server, with a window manager or without one."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from Xlib import X, Xatom
from Xlib.display import Display
from Xlib.error import ConnectionClosedError, DisplayError, XauthError, XError
from Xlib.ext import randr
from Xlib.xobject.drawable import Window

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.window import (
    ClientArea,
    check_shown,
    closed_error,
    matching_title,
    minimised_error,
)
from mc_nested.live.desktop.x11_clipboard import X11Clipboard

_WAYLAND = (
    "this is a Wayland session, whose windows can be neither pictured nor driven: "
    'log out and choose an X11 session (often "... on Xorg") at the login screen'
)


@contextmanager
def open_window(title: str) -> Iterator["X11Window"]:
    """The one window whose title matches the regular expression ``title``, for as long as the context lasts.

    Raises:
        DesktopError: no display, a Wayland session, no window of that title or several, or a minimised one.
    """
    display = _connect()
    try:
        windows = _titled_windows(display)
        chosen = matching_title(title, [name for _, name in windows])
        window = X11Window(display, *windows[chosen])
        window.client_area()
        yield window
    finally:
        with suppress(ConnectionClosedError):  # the X server may have ended first
            display.close()


def session_kind() -> str:
    """What this session is, in words; DesktopError where its windows can be neither pictured nor driven."""
    _connect().close()
    return f"X11, display {os.environ['DISPLAY']}"


def open_clipboard() -> X11Clipboard:
    """The X server's clipboard, not read yet."""
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

    def client_area(self) -> ClientArea:
        with self._if_open():
            if self._window.get_attributes().map_state != X.IsViewable:
                raise minimised_error(self._title)
            size = self._window.get_geometry()
            corner = self._root.translate_coords(self._window, 0, 0)
        area = ClientArea(corner.x, corner.y, size.width, size.height)
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

    @contextmanager
    def _if_open(self) -> Iterator[None]:
        try:
            yield
        except (XError, ConnectionClosedError) as error:
            raise closed_error(self._title) from error


def _connect() -> Display:
    name = os.environ.get("DISPLAY")
    if not name:
        if os.environ.get("WAYLAND_DISPLAY") or os.environ.get("XDG_SESSION_TYPE") == "wayland":
            raise DesktopError(_WAYLAND)
        raise DesktopError("no display (DISPLAY is not set): run this in the desktop session that shows the game")
    try:
        display = Display(name)
    except (DisplayError, XauthError, ConnectionClosedError, OSError) as error:
        raise DesktopError(
            f"no display (DISPLAY={name} can't be reached): run this in the desktop session that shows the game"
        ) from error
    # The session's variables alone are not enough: a separate X server may run inside a Wayland session.
    if _is_xwayland(display):
        display.close()
        raise DesktopError(_WAYLAND)
    return display


def _is_xwayland(display: Display) -> bool:
    """Whether the X server only serves windows to a Wayland compositor; pictures of its screen are black."""
    if display.query_extension("XWAYLAND") is not None:  # from 23.1 on
        return True
    if display.query_extension("RANDR") is None:
        return False
    root = display.screen().root
    screens = randr.get_screen_resources_current(root)
    names = (randr.get_output_info(root, each, screens.config_timestamp).name for each in screens.outputs)
    return any(name.startswith("XWAYLAND") for name in names)


def _titled_windows(display: Display) -> list[tuple[Window, str]]:
    root = display.screen().root
    managed = root.get_full_property(display.intern_atom("_NET_CLIENT_LIST"), X.AnyPropertyType)
    if managed is not None and len(managed.value):
        windows = [display.create_resource_object("window", each) for each in managed.value]
    else:
        windows = list(_shown_below(root))
    titled = [(window, _title_if_open(display, window)) for window in windows]
    return [(window, title) for window, title in titled if title]


def _shown_below(window: Window) -> Iterator[Window]:
    try:
        children = window.query_tree().children
        shown = [each for each in children if each.get_attributes().map_state == X.IsViewable]
    except XError:  # closed since it was listed
        return
    for child in shown:
        yield child
        yield from _shown_below(child)


def _title_if_open(display: Display, window: Window) -> str:
    try:
        return _title_of(display, window)
    except XError:  # closed since it was listed
        return ""


def _title_of(display: Display, window: Window) -> str:
    for atom in (display.intern_atom("_NET_WM_NAME"), Xatom.WM_NAME):
        text = window.get_full_text_property(atom)
        if text:
            return text if isinstance(text, str) else text.decode("utf-8", "replace")
    return ""


def _is_within(window: Window, outer: Window) -> bool:
    """Whether ``window`` is ``outer`` or lies below it in the tree of windows."""
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
