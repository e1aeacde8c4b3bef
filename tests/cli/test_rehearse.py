"""``mc-nested rehearse``: what it refuses; the window itself is in tests/sim/window."""

import sys
from pathlib import Path

import pytest

from tests.cli.running import run


def refused(capsys: pytest.CaptureFixture[str], *words: str | Path) -> str:
    """The one line that says why it isn't rehearsed."""
    assert run("rehearse", *words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    return printed.err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--size", "200x100"], "200x100 has no room for the game: at least 320x240"),
        (["--size", "wide"], "no window has the size 'wide': write width x height in pixels, such as 854x480"),
        (["--version", "1.7.10"], "no version '1.7.10' can be rehearsed: name one from 1.12 to 26.3"),
        (["--size", "99999x99999"], "no screen is as large as 99999x99999: at most 7680x4320"),
        (["--version", "29.9"], "no version '29.9' can be rehearsed"),
        (["--truth", "missing/truth.json"], "missing is no folder: name a file in a folder that exists"),
        (["--version", "newest"], "no version 'newest' can be rehearsed"),
        (["--gui-scale", "9"], "--gui-scale"),
        (["--fps", "1"], "--fps"),
        (["--lag", "-1"], "--lag"),
        (["--font", "nothing.png"], "nothing.png"),
    ],
)
def test_a_mistake_is_one_line(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert says in refused(capsys, *words)


@pytest.mark.parametrize("package", ["glfw", "moderngl"])
def test_a_missing_package_is_named_with_how_to_get_it(
    package: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name.startswith("sim.window")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)
    said = refused(capsys)
    assert package in said
    assert "pip install -c constraints.txt -e '.[rehearse]'" in said


if sys.platform.startswith("linux"):

    def test_without_a_display_it_says_where_to_run_it(
        capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):
            monkeypatch.delenv(name, raising=False)
        said = refused(capsys)
        assert "no window can be opened (X11: " in said
        assert "on Wayland with Xwayland" in said
