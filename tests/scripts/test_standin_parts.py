"""What is fetched, and what is refused, with stand-ins for npm, node and apt-get on the PATH."""

import base64
import hashlib
import io
import os
import re
import sys
import tarfile
from pathlib import Path

import pytest

from scripts import standin_parts as parts
from scripts.standin_parts import MissingError, Pack

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the stand-in is for Linux")

FILES = {"package/public/index.js": b"js", "package/public/a/b.png": b"png", "package/other": b"no"}


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that is the whole PATH, for programs that `write_program` puts there."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def write_program(folder: Path, name: str, code: str) -> None:
    path = folder / name
    path.write_text(f"#!{sys.executable}\nimport os, shutil, sys\n{code}\n")
    path.chmod(0o755)


def write_pack(path: Path, files: dict[str, bytes]) -> Pack:
    """An archive as npm packs it, and the Pack that pins it."""
    with tarfile.open(path, "w:gz") as archive:
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    digest = base64.b64encode(hashlib.sha512(path.read_bytes()).digest()).decode()
    return Pack("thing", "1.0.0", f"sha512-{digest}", re.compile(r"package/public/(.+)"))


def npm_that_packs(folder: Path, archive: Path) -> None:
    write_program(folder, "npm", f"assert sys.argv[1:] == ['pack', 'thing@1.0.0']\nshutil.copy({str(archive)!r}, '.')")


def silent(_line: str) -> None:
    """Progress that nobody reads."""


def test_a_pack_is_fetched_once_and_only_the_wanted_files_are_unpacked(tmp_path: Path, programs: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", FILES)
    npm_that_packs(programs, tmp_path / "thing.tgz")
    folder = parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log")
    found = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert found == {"index.js": b"js", "a/b.png": b"png"}
    (programs / "npm").unlink()
    assert parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log") == folder


def test_a_pack_with_another_hash_is_refused_and_not_unpacked(tmp_path: Path, programs: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", FILES)
    write_pack(tmp_path / "thing.tgz", {**FILES, "package/public/index.js": b"other"})
    npm_that_packs(programs, tmp_path / "thing.tgz")
    with pytest.raises(MissingError, match="not the file that is pinned"):
        parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log")
    assert not (tmp_path / "cache" / pack.folder).exists()
    assert not list((tmp_path / "cache").rglob("index.js"))


def test_a_pack_that_leads_out_of_its_folder_is_refused(tmp_path: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", {"package/public/../../outside": b"x"})
    with pytest.raises(MissingError, match="leads out"):
        parts.unpack(tmp_path / "thing.tgz", pack.wanted, tmp_path / "a" / "b")
    assert not (tmp_path / "outside").exists()


def test_npm_that_fails_is_reported_in_one_line(tmp_path: Path, programs: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", FILES)
    write_program(programs, "npm", "sys.exit('no network')")
    with pytest.raises(MissingError, match=r"could not fetch thing 1\.0\.0") as failure:
        parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log")
    assert "\n" not in str(failure.value)
    assert "no network" in (tmp_path / "log").read_text()


def test_the_server_is_installed_once_for_a_lock_file(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "source"
    source.mkdir()
    (source / "package.json").write_text("{}")
    (source / "package-lock.json").write_text("1")
    monkeypatch.setattr(parts, "NODE_FOLDER", source)
    write_program(programs, "npm", f"os.mkdir('node_modules'); open({str(tmp_path / 'calls')!r}, 'a').write('x')")
    for _ in range(2):
        assert parts.install_server(tmp_path, silent, tmp_path / "log").is_dir()
    (source / "package-lock.json").write_text("2")
    parts.install_server(tmp_path, silent, tmp_path / "log")
    assert (tmp_path / "calls").read_text() == "xx"


def test_a_user_who_is_not_root_gets_the_command_to_run(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_program(programs, "apt-get", "raise SystemExit('must not run')")
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    with pytest.raises(MissingError, match="sudo apt-get install --no-install-recommends nodejs npm xvfb chromium"):
        parts.install_programs(silent, tmp_path / "log")
    assert not (tmp_path / "log").exists()


def test_root_gets_what_is_missing_and_nothing_else(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    calls = tmp_path / "calls"
    write_program(programs, "apt-get", f"open({str(calls)!r}, 'a').write(' '.join(sys.argv[1:]) + '\\n')")
    write_program(programs, "node", "print('v20.1.0')")
    for name in ("npm", "Xvfb", "google-chrome"):
        write_program(programs, name, "")
    parts.install_programs(silent, tmp_path / "log")
    assert calls.read_text().splitlines() == ["update", "install -y --no-install-recommends xdotool"]


@pytest.mark.parametrize("says", ["v16.20.2", "nonsense", ""])
def test_a_node_that_is_too_old_is_refused(says: str, programs: Path) -> None:
    write_program(programs, "node", f"print({says!r})")
    with pytest.raises(MissingError, match="needs Node 18 or later"):
        parts.check_node()
