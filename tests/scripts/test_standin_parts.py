"""The stand-in's packages are fetched or refused, with stand-ins for npm and node on the PATH."""

import base64
import hashlib
import io
import re
import sys
import tarfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from scripts import standin_parts as parts
from scripts.programs import MissingError
from scripts.standin_parts import Pack
from tests.scripts.fake_programs import silent, write_program

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the stand-in is for Linux")

FILES = {"package/public/index.js": b"js", "package/public/a/b.png": b"png", "package/other": b"no"}


def write_pack(path: Path, files: dict[str, bytes]) -> Pack:
    """Write an archive as npm packs it, and return the Pack that pins it."""
    with tarfile.open(path, "w:gz") as archive:
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    digest = base64.b64encode(hashlib.sha512(path.read_bytes()).digest()).decode()
    return Pack("thing", "1.0.0", f"sha512-{digest}", re.compile(r"package/public/(.+)"))


def npm_that_packs(folder: Path, archive: Path) -> None:
    write_program(folder, "npm", f"assert sys.argv[1:] == ['pack', 'thing@1.0.0']\nshutil.copy({str(archive)!r}, '.')")


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


def test_a_pack_that_leads_out_of_its_folder_is_refused(tmp_path: Path, programs: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", {"package/public/../../outside": b"x"})
    npm_that_packs(programs, tmp_path / "thing.tgz")
    with pytest.raises(MissingError, match="leads out of its folder"):
        parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log")
    assert not list(tmp_path.rglob("outside"))


def test_npm_that_fails_is_reported_in_one_line(tmp_path: Path, programs: Path) -> None:
    pack = write_pack(tmp_path / "thing.tgz", FILES)
    write_program(programs, "npm", "sys.exit('no network')")
    with pytest.raises(MissingError, match=r"could not fetch thing 1\.0\.0") as failure:
        parts.fetch(pack, tmp_path / "cache", silent, tmp_path / "log")
    assert "\n" not in str(failure.value)
    assert "no network" in (tmp_path / "log").read_text()


def test_packages_of_a_lock_file_are_installed_once(tmp_path: Path, programs: Path) -> None:
    source = tmp_path / "source"
    source.mkdir()
    (source / "package.json").write_text("{}")
    (source / "package-lock.json").write_text("1")
    write_program(programs, "npm", f"os.mkdir('node_modules'); open({str(tmp_path / 'calls')!r}, 'a').write('x')")
    for _ in range(2):
        assert parts.install_locked("it", source, tmp_path / "node", silent, tmp_path / "log").is_dir()
    (source / "package-lock.json").write_text("2")
    parts.install_locked("it", source, tmp_path / "node", silent, tmp_path / "log")
    assert (tmp_path / "calls").read_text() == "xx"


def test_packages_that_several_want_at_once_are_installed_by_one(tmp_path: Path, programs: Path) -> None:
    source = tmp_path / "source"
    source.mkdir()
    for name in ("package.json", "package-lock.json"):
        (source / name).write_text("{}")
    calls = f"open({str(tmp_path / 'calls')!r}, 'a').write('x')"
    write_program(programs, "npm", f"import time; os.mkdir('node_modules'); time.sleep(0.3); {calls}")

    def install(_: int) -> bool:
        return parts.install_locked("it", source, tmp_path / "node", silent, tmp_path / "log").is_dir()

    with ThreadPoolExecutor(4) as together:
        assert list(together.map(install, range(4))) == [True] * 4
    assert (tmp_path / "calls").read_text() == "x"


@pytest.mark.parametrize("says", ["v16.20.2", "nonsense", ""])
def test_a_node_that_is_too_old_is_refused(says: str, programs: Path) -> None:
    write_program(programs, "node", f"print({says!r})")
    with pytest.raises(MissingError, match="needs Node 18 or later"):
        parts.check_node()
