"""Pictures in which nothing can be read: black ones, and ones of other colours."""

import numpy as np
import pytest

from calibration.doctor.check import CheckName
from calibration.doctor.picture_faults import BLACK, BRIGHT, FAINT, picture_fault
from calibration.doctor.screen_rows import screen_rows
from calibration.doctor.snapshot import ScreenContents, WindowSnapshot
from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Reading
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.font import drawn_atlas
from tests.calibration.contexts import started

FONT = font_of(drawn_atlas())
WINDOW = Fingerprint("Minecraft 26.3", (854, 480))


@pytest.fixture(scope="module")
def shown() -> Frame:
    frame: Frame = started(VirtualClient()).display.grab()
    return frame


def levelled(frame: Frame, darkest: float, brightest: float) -> Frame:
    """The frame with its levels squeezed into that range."""
    found: Frame = (darkest + frame.astype(np.float32) * (brightest - darkest) / 255).astype(np.uint8)
    return found


@pytest.mark.parametrize("level", [0, BLACK])
def test_a_black_picture_names_what_pictures_black(shown: Frame, level: int) -> None:
    fault = picture_fault(np.full_like(shown, level), FONT)
    assert fault is not None
    assert fault.startswith("the window's picture is black: play in a window")
    assert "remote" in fault


@pytest.mark.parametrize(
    ("darkest", "brightest", "says"),
    [(0, 200, FAINT), (0, 120, FAINT), (40, 180, FAINT), (0, 225, FAINT), (90, 255, BRIGHT)],
)
def test_text_of_other_brightness_names_what_changes_colours(
    darkest: int, brightest: int, says: str, shown: Frame
) -> None:
    fault = picture_fault(levelled(shown, darkest, brightest), FONT)
    assert fault is not None
    assert fault.startswith(f"{says}: switch HDR")


def test_a_picture_without_text_has_no_fault_that_is_known() -> None:
    frame = started(VirtualClient(has_f3=False)).display.grab()
    assert picture_fault(frame, FONT) is None
    assert picture_fault(np.full_like(frame, 128), FONT) is None


def test_the_row_of_the_debug_screen_says_it(shown: Frame) -> None:
    contents = ScreenContents("unknown", None, None, Reading(problem="no debug screen: press F3"))
    rows = [
        screen_rows(WindowSnapshot(WINDOW, (854, 480), None, True, contents, picture), FONT)[0]
        for picture in (np.zeros_like(shown), np.full_like(shown, 128))
    ]
    assert [(row.name, row.status) for row in rows] == [(CheckName.DEBUG_SCREEN, "fail")] * 2
    assert [row.detail for row in rows] == ["the window's picture is black", "no debug screen"]
