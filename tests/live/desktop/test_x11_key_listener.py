"""An X server's keys, heard by their places, under a layout that types other letters there."""

import subprocess
import sys

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("keys of an X server", allow_module_level=True)

from tests.live.desktop.real_windows.probed import glfw_probed


@pytest.mark.window
@pytest.mark.parametrize("layout", ["us", "fr", "ru"])
def test_keys_are_heard_by_their_places_and_typed_text_is_not_heard(layout: str, x_screen: dict[str, str]) -> None:
    subprocess.run(["setxkbmap", layout], env=x_screen, check=True)
    assert glfw_probed(x_screen, "listener")["heard"] == [
        *(["w", True], ["w", False], ["left.shift", True], ["left.shift", False]),
        *(["f12", True], ["f12", False], ["/", True], ["/", False]),
    ]


@pytest.mark.window
@pytest.mark.parametrize("layout", ["us", "fr", "ru"])
def test_the_panic_key_and_hotkeys_are_heard_by_their_places_under_any_layout(
    layout: str, x_screen: dict[str, str]
) -> None:
    subprocess.run(["setxkbmap", layout], env=x_screen, check=True)
    report = glfw_probed(x_screen, "hotkeys")
    assert report["stopped"] == ["the panic key was pressed"]
    assert report["hotkeys"] == ["q"]
