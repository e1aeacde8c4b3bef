"""Keys and text on Windows, through user32's SendInput: keys by scancode, text by the layout's keys.

A scancode is what GLFW, and so the game, knows a key by. Text is typed as a person types it: by the keys of the layout
of the window in front, with Shift or AltGr, and with Caps Lock counted in. Only a character that no key of the layout
makes is sent as a Unicode character: under Wine GLFW takes such a one for a key, too, the one whose scancode is the
character's low byte, and never sees that key released (FACTS: Input and windows).
"""

import ctypes
import sys
from ctypes import wintypes

from mc_nested.errors import DesktopError
from mc_nested.live.model.keys import CHARACTERS, EXTENDED, PLACES, KeyPlace, Layout

assert sys.platform == "win32"  # noqa: S101  mypy learns from it that the rest is for Windows alone

_INPUT_KEYBOARD = 1
_EXTENDED_KEY, _KEY_UP, _UNICODE, _SCANCODE = 1, 2, 4, 8
"""KEYEVENTF_EXTENDEDKEY, _KEYUP, _UNICODE and _SCANCODE (winuser.h)."""


class _MouseInput(ctypes.Structure):
    """MOUSEINPUT, never sent: the largest member of the union, which gives INPUT its size."""

    _fields_ = (
        ("dx", wintypes.LONG),
        ("dy", wintypes.LONG),
        ("mouseData", wintypes.DWORD),
        ("dwFlags", wintypes.DWORD),
        ("time", wintypes.DWORD),
        ("dwExtraInfo", ctypes.c_size_t),
    )


class _KeyInput(ctypes.Structure):
    """KEYBDINPUT."""

    _fields_ = (
        ("wVk", wintypes.WORD),
        ("wScan", wintypes.WORD),
        ("dwFlags", wintypes.DWORD),
        ("time", wintypes.DWORD),
        ("dwExtraInfo", ctypes.c_size_t),
    )


class _AnyInput(ctypes.Union):
    _fields_ = (("mouse", _MouseInput), ("key", _KeyInput))


class _Input(ctypes.Structure):
    """INPUT."""

    _fields_ = (("type", wintypes.DWORD), ("of", _AnyInput))


_user32 = ctypes.WinDLL("user32", use_last_error=True)
_send_input = _user32.SendInput
_send_input.argtypes = (wintypes.UINT, ctypes.POINTER(_Input), ctypes.c_int)
_send_input.restype = wintypes.UINT
_user32.GetForegroundWindow.restype = wintypes.HWND
_user32.GetWindowThreadProcessId.argtypes = (wintypes.HWND, ctypes.POINTER(wintypes.DWORD))
_user32.GetWindowThreadProcessId.restype = wintypes.DWORD
_user32.GetKeyboardLayout.argtypes = (wintypes.DWORD,)
_user32.GetKeyboardLayout.restype = wintypes.HKL
_user32.VkKeyScanExW.argtypes = (wintypes.WCHAR, wintypes.HKL)
_user32.VkKeyScanExW.restype = ctypes.c_short
_user32.MapVirtualKeyExW.argtypes = (wintypes.UINT, wintypes.UINT, wintypes.HKL)
_user32.MapVirtualKeyExW.restype = wintypes.UINT
_user32.ToUnicodeEx.argtypes = (
    *(wintypes.UINT, wintypes.UINT, ctypes.c_char_p, wintypes.LPWSTR),
    *(ctypes.c_int, wintypes.UINT, wintypes.HKL),
)

_SHIFT, _ALT_GR = 1, 6
"""VkKeyScanEx's bits: Shift; and Ctrl with Alt, which is AltGr."""
_LEFT_SHIFT, _RIGHT_ALT = (0xA0, 0x2A, 0), (0xA5, 0x38, _EXTENDED_KEY)
_MODIFIERS = {0: (), _SHIFT: (_LEFT_SHIFT,), _ALT_GR: (_RIGHT_ALT,), _SHIFT | _ALT_GR: (_LEFT_SHIFT, _RIGHT_ALT)}
"""The keys to hold for them."""
_VK_SHIFT, _VK_CONTROL, _VK_MENU, _VK_CAPS_LOCK = 0x10, 0x11, 0x12, 0x14
_TO_SCANCODE, _TO_VIRTUAL_KEY = 0, 3
"""MAPVK_VK_TO_VSC, and MAPVK_VSC_TO_VK_EX, which tells left from right."""
_LEAVES_MESSAGES = 0
"""PM_NOREMOVE."""
_CHANGES_NOTHING = 4
"""ToUnicodeEx's flag that leaves dead keys as they are."""

_LWJGL_2 = {
    **{ord(name.upper()): name for name in CHARACTERS if name.isalnum()},
    **dict(zip(range(0xBA, 0xC1), ";=,-./`", strict=True)),  # VK_OEM_1 to VK_OEM_3
    **dict(zip(range(0xDB, 0xE0), "[\\]'`", strict=True)),  # VK_OEM_4 to VK_OEM_8
}
"""The keys that LWJGL 2 takes virtual keys for, with Shift or without (its WindowsKeycodes)."""

_Event = tuple[int, int, int]
"""A virtual key, or 0; a scancode or a UTF-16 unit; and flags. Only keys named both ways make characters."""


class Win32KeySender:
    """Sends keys and characters as a keyboard's own."""

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        extended = _EXTENDED_KEY if place.scan & EXTENDED else 0
        # Named both ways, as a keyboard's driver does: GLFW goes by the scancode, but lets go of a Shift whose virtual
        # key isn't down, and Wine doesn't find that key by itself.
        key = _user32.MapVirtualKeyExW(place.scan, _TO_VIRTUAL_KEY, _layout_in_front())
        flags = extended | (0 if is_down else _KEY_UP)
        _send((key, place.scan & 0xFF, flags if key else flags | _SCANCODE))

    def layout(self) -> Layout:
        """Return what LWJGL 2 takes each key for, by the virtual keys of the layout in front."""
        layout = _layout_in_front()
        keys = {name: _user32.MapVirtualKeyExW(PLACES[name].scan, _TO_VIRTUAL_KEY, layout) for name in CHARACTERS}
        return {name: (_LWJGL_2.get(key, ""),) * 2 for name, key in keys.items()}

    def type(self, character: str) -> None:
        # All in one call, between whose events no other program's can come.
        _send(*(_layout_events(character) or _unicode_events(character)))


def _unicode_events(character: str) -> list[_Event]:
    """Return events that send the character itself; one beyond 0xFFFF is two units."""
    data = character.encode("utf-16-le")
    units = [int.from_bytes(data[at : at + 2], "little") for at in range(0, len(data), 2)]
    return [(0, unit, flags) for unit in units for flags in (_UNICODE, _UNICODE | _KEY_UP)]


def _layout_events(character: str) -> list[_Event]:
    """Return the keys that make the character in the window in front; none where its layout has no such keys."""
    layout = _layout_in_front()
    found = _user32.VkKeyScanExW(character, layout) if len(character.encode("utf-16-le")) == 2 else -1
    key, held = found & 0xFF, found >> 8
    if found == -1 or held not in _MODIFIERS:
        return []
    scan = _user32.MapVirtualKeyExW(key, _TO_SCANCODE, layout)
    is_caps_lock_on = _is_caps_lock_on()
    for chosen in (held, held ^ _SHIFT):  # a letter under Caps Lock takes the other one
        if scan and _made(key, scan, chosen, layout, is_caps_lock_on=is_caps_lock_on) == character:
            down = [*_MODIFIERS[chosen], (key, scan, 0)]
            return down + [(code, place, flags | _KEY_UP) for code, place, flags in reversed(down)]
    return []


def _layout_in_front() -> int:
    """Return the keyboard layout of the window in front: each thread has its own."""
    layout: int = _user32.GetKeyboardLayout(_user32.GetWindowThreadProcessId(_user32.GetForegroundWindow(), None))
    return layout


def _made(key: int, scan: int, held: int, layout: int, *, is_caps_lock_on: bool) -> str:
    """Return what a key makes with these modifiers held; empty for a dead key."""
    state = bytearray(256)
    for bit, modifier in ((1, _VK_SHIFT), (2, _VK_CONTROL), (4, _VK_MENU)):
        state[modifier] = 0x80 if held & bit else 0
    state[_VK_CAPS_LOCK] = int(is_caps_lock_on)
    made = ctypes.create_unicode_buffer(8)
    count = _user32.ToUnicodeEx(key, scan, bytes(state), made, len(made), _CHANGES_NOTHING, layout)
    return made.value if count == 1 else ""


def _is_caps_lock_on() -> bool:
    # A thread learns of keys pressed elsewhere when it looks for messages.
    _user32.PeekMessageW(ctypes.byref(wintypes.MSG()), None, 0, 0, _LEAVES_MESSAGES)
    return bool(_user32.GetKeyState(_VK_CAPS_LOCK) & 1)


def _send(*events: _Event) -> None:
    """Send key events."""
    inputs = (_Input * len(events))(
        *(_Input(_INPUT_KEYBOARD, _AnyInput(key=_KeyInput(*event, 0, 0))) for event in events)
    )
    if _send_input(len(events), inputs, ctypes.sizeof(_Input)) != len(events):
        raise DesktopError("Windows took no key: close the program that blocks the keyboard, and start again")
