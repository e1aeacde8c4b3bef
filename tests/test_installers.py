"""The built wheel and sdist, installed by uv and pipx from a folder of packages, as docs/how-to/install.md says.

pip's way is test_wheel.py's. No index is asked: what isn't in the folder isn't found, as without a network.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from scripts.programs import ROOT

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the programs on the PATH are Linux's"),
]

OVERRIDES = "evdev; sys_platform == 'never'\npython3-xlib; sys_platform == 'never'\n"
"""What pynput and pyautogui ask for, and nothing here uses: as in docs/how-to/install.md."""

WITHOUT_COMPILER = ("sh", "env")
"""The programs of a computer that can compile nothing, beside Python."""


@dataclass(frozen=True)
class Offered:
    """The built wheel and sdist, and a folder with every package that they need."""

    wheel: Path
    sdist: Path
    packages: Path


@dataclass(frozen=True)
class Stranger:
    """A person's empty home; ``path`` is where programs are found, ``packages`` where pip finds packages."""

    home: Path
    path: str
    packages: Path | None = None

    def run(self, *command: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a command there; nothing of this environment is inherited."""
        variables = {
            "HOME": str(self.home),
            "PATH": self.path,
            "CC": "cc",
            "UV_CACHE_DIR": str(self.home / "cache"),
            "PIP_CONSTRAINT": str(ROOT / "constraints.txt"),
            "PIP_NO_INDEX": "1",
            "PIP_FIND_LINKS": str(self.packages or ""),
            "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        }
        words = [str(word) for word in command]
        return subprocess.run(words, cwd=self.home, env=variables, capture_output=True, text=True, check=False)

    def uv(self, what: Path, packages: Path, *options: str | Path) -> subprocess.CompletedProcess[str]:
        """Install as a tool with uv."""
        words = ("tool", "install", "--offline", "--no-index", "--find-links", packages, "--python", sys.executable)
        return self.run(sys.executable, "-m", "uv", *words, "-c", ROOT / "constraints.txt", *options, what)

    def check_installed(self) -> None:
        """Check that the command works, and knows its files."""
        command = self.home / ".local" / "bin" / "mc-nested"
        assert self.run(command, "--version").stdout.startswith("mc-nested ")
        shown = self.run(command, "scenarios", "line")
        assert "optimum    21" in shown.stdout, shown.stderr


@pytest.fixture(scope="module")
def offered(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Offered]:
    folder = tmp_path_factory.mktemp("offered")
    packages = folder / "packages"
    fetched = ["-c", str(ROOT / "constraints.txt"), "--dest", str(packages), "hatchling", "pip", "setuptools", "wheel"]
    for command in (
        ["uv", "build", "--quiet", "--out-dir", str(folder), str(ROOT)],
        ["pip", "download", "--quiet", *fetched, str(ROOT)],
    ):
        done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, check=False)
        if done.returncode:
            (pytest.fail if os.environ.get("CI") else pytest.skip)(f"nothing can be fetched: {done.stderr[-500:]}")
    (wheel,), (sdist,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
    yield Offered(wheel, sdist, packages)
    shutil.rmtree(folder)


@pytest.fixture
def stranger(tmp_path: Path) -> Iterator[Stranger]:
    """Return somebody without a C compiler; what was installed is removed at the end, since it is large."""
    home, programs = tmp_path / "home", tmp_path / "programs"
    for folder in (home, programs):
        folder.mkdir()
    for name in WITHOUT_COMPILER:
        (programs / name).symlink_to(shutil.which(name) or name)
    yield Stranger(home, str(programs))
    shutil.rmtree(home)


@pytest.mark.parametrize("kind", ["wheel", "sdist"])
def test_uv_installs_the_tool_without_a_compiler(kind: str, offered: Offered, stranger: Stranger) -> None:
    overrides = stranger.home / "overrides.txt"
    overrides.write_text(OVERRIDES, "utf-8")
    done = stranger.uv(getattr(offered, kind), offered.packages, "--overrides", overrides)
    assert done.returncode == 0, done.stderr
    stranger.check_installed()


@pytest.mark.skipif(shutil.which("cc") is None, reason="pip can't leave out evdev, which is compiled")
def test_pipx_installs_the_sdist(offered: Offered, stranger: Stranger) -> None:
    with_compiler = Stranger(stranger.home, os.environ["PATH"], offered.packages)
    words = ("install", "--backend", "pip", "--python", sys.executable)
    done = with_compiler.run(sys.executable, "-m", "pipx", *words, offered.sdist)
    assert done.returncode == 0, done.stderr
    with_compiler.check_installed()


def test_missing_compiler_is_named_with_the_package_that_needs_it(offered: Offered, stranger: Stranger) -> None:
    done = stranger.uv(offered.wheel, offered.packages)
    assert done.returncode != 0
    assert "`evdev`" in done.stderr
    assert not (stranger.home / ".local" / "bin" / "mc-nested").exists()


def test_without_a_network_the_first_missing_package_is_named(offered: Offered, stranger: Stranger) -> None:
    empty = stranger.home / "empty"
    empty.mkdir()
    with_uv = stranger.uv(offered.wheel, empty)
    assert with_uv.returncode != 0
    assert "not found in the provided package locations" in with_uv.stderr
    with_pip = stranger.run(sys.executable, "-m", "pip", "install", "--target", empty, offered.wheel)
    assert with_pip.returncode != 0
    assert "gymnasium" in with_pip.stdout + with_pip.stderr
    assert list(empty.iterdir()) == []
