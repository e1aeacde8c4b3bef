"""The clipboard of a real X server: what is written is read by any program, and outlives the one that wrote it."""

import gc
import subprocess
import sys
import time
import warnings
from collections.abc import Iterator

import pytest

from mc_nested.errors import ClipboardError

if not sys.platform.startswith("linux"):
    pytest.skip("the clipboard of an X server", allow_module_level=True)

from Xlib import X, Xatom
from Xlib.display import Display
from Xlib.protocol import event

from mc_nested.live.desktop.x11_clipboard import MOST_BYTES, X11Clipboard

COPIED = "/execute in minecraft:overworld run tp @s 0.50 64.00 0.50 0.00 65.00"
TEXTS = [
    "/execute in minecraft:overworld run tp @s 0.50 64.00 0.50 0.00 65.00",
    "two\nlines, ü and 木",
    "x" * MOST_BYTES,
]


@pytest.fixture
def clipboard(x_server: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> X11Clipboard:
    monkeypatch.setenv("DISPLAY", x_server["DISPLAY"])
    return X11Clipboard()


@pytest.mark.standin
def test_a_clipboard_to_which_nothing_was_copied_is_empty(clipboard: X11Clipboard) -> None:
    assert clipboard.read() == ""


@pytest.mark.standin
@pytest.mark.parametrize("text", TEXTS, ids=["one line", "any letters", "the longest"])
def test_a_written_text_is_read_back(clipboard: X11Clipboard, text: str) -> None:
    clipboard.write("before")
    clipboard.write(text)
    assert clipboard.read() == text


@pytest.mark.standin
def test_a_text_outlives_the_program_that_wrote_it(clipboard: X11Clipboard) -> None:
    code = "from mc_nested.live.desktop.x11_clipboard import X11Clipboard as C; C().write('put back')"
    subprocess.run([sys.executable, "-c", code], check=True)
    assert clipboard.read() == "put back"


@pytest.mark.standin
def test_an_empty_text_empties_the_clipboard(clipboard: X11Clipboard) -> None:
    clipboard.write("before")
    clipboard.write("")
    assert clipboard.read() == ""


@pytest.mark.standin
def test_a_text_longer_than_the_limit_is_refused_and_the_clipboard_keeps_its_text(clipboard: X11Clipboard) -> None:
    clipboard.write("before")
    with pytest.raises(ClipboardError, match="too long"):
        clipboard.write("x" * (MOST_BYTES + 1))
    assert clipboard.read() == "before"


@pytest.fixture
def owner(clipboard: X11Clipboard) -> Iterator[Display]:
    """Return another program that owns the clipboard, and hasn't answered yet."""
    assert clipboard.read() == ""
    display = Display()
    window = display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
    window.set_selection_owner(display.intern_atom("CLIPBOARD"), X.CurrentTime)
    display.sync()
    yield display
    display.close()


@pytest.mark.standin
def test_reading_gives_up_on_an_owner_that_does_not_answer(clipboard: X11Clipboard, owner: Display) -> None:
    began = time.monotonic()
    with pytest.raises(ClipboardError, match="doesn't answer"):
        clipboard.read()
    assert time.monotonic() - began < 5
    assert owner.pending_events()


@pytest.mark.standin
def test_reading_a_picture_is_an_error(owner: Display) -> None:
    reader = subprocess.Popen(
        [sys.executable, "-c", "from mc_nested.live.desktop.x11_clipboard import X11Clipboard as C; C().read()"],
        stderr=subprocess.PIPE,
        text=True,
    )
    for _ in ("UTF8_STRING", "STRING"):
        request = owner.next_event()
        assert request.type == X.SelectionRequest
        assert request.target in (owner.intern_atom("UTF8_STRING"), Xatom.STRING)
        request.requestor.send_event(
            event.SelectionNotify(
                time=request.time,
                requestor=request.requestor,
                selection=request.selection,
                target=request.target,
                property=X.NONE,
            )
        )
        owner.flush()
    _, error = reader.communicate(timeout=10)
    assert "something other than text" in error


@pytest.mark.standin
def test_a_display_that_has_gone_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", ":9999")
    with warnings.catch_warnings():
        # python-xlib leaves the socket of a connection that failed to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        with pytest.raises(ClipboardError, match="display"):
            X11Clipboard().read()
        gc.collect()
