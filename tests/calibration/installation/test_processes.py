"""Running games and their folders, by command line or working folder; an unknown state never counts as closed."""

import os
import shutil
import sys
from pathlib import Path

import pytest

from calibration.installation.processes import Process, folders_played, may_have_open, running_processes

PLAIN = "/usr/lib/jvm/java-17/bin/java -Xmx2G -cp libs net.minecraft.client.main.Main"
PRISM = "/usr/bin/java -jar /usr/share/prismlauncher/NewLaunch.jar org.prismlauncher.EntryPoint"


@pytest.fixture
def games(tmp_path: Path) -> tuple[Path, Path]:
    """Return two game folders, one with a space in its name."""
    folders = tmp_path / ".minecraft", tmp_path / "My Pack" / "minecraft"
    for folder in folders:
        folder.mkdir(parents=True)
    return folders


def test_game_has_the_folder_on_its_command_line_open(games: tuple[Path, Path]) -> None:
    here, there = games
    for line in (f"{PLAIN} --gameDir {there} --assetsDir /a", f'"javaw.exe" net.minecraft.Main --gameDir "{there}"'):
        game = Process(line, folder=here)
        assert may_have_open(game, there)
        assert not may_have_open(game, here)
        assert folders_played([game]) == [there]


def test_game_without_a_folder_on_its_command_line_has_its_working_folder_open(games: tuple[Path, Path]) -> None:
    here, there = games
    game = Process(PRISM, folder=there)
    assert may_have_open(game, there)
    assert not may_have_open(game, here)
    assert folders_played([game]) == [there]


def test_game_with_no_known_folder_may_have_any_folder_open_but_is_played_in_none(games: tuple[Path, Path]) -> None:
    game = Process(PRISM)
    assert all(may_have_open(game, folder) for folder in games)
    assert folders_played([game]) == []


@pytest.mark.parametrize(
    "command",
    [
        "/usr/bin/java -jar jenkins.war",
        "vim /home/ada/.minecraft/options.txt",
        "grep -r minecraft javadoc",
        "/opt/Minecraft Launcher/minecraft-launcher",
        "",
    ],
)
def test_other_programs_have_no_game_folder_open(command: str, games: tuple[Path, Path]) -> None:
    assert not may_have_open(Process(command, folder=games[0]), games[0])
    assert folders_played([Process(command, folder=games[0])]) == []


@pytest.mark.skipif(sys.platform == "win32", reason="Windows lets only administrators make links, Wine nobody")
def test_the_processes_of_linux_are_read(tmp_path: Path, games: tuple[Path, Path]) -> None:
    for number, words in ((7, PLAIN.split()), (8, ["bash"]), (9, [])):
        (tmp_path / "proc" / str(number)).mkdir(parents=True)
        (tmp_path / "proc" / str(number) / "cmdline").write_bytes(b"".join(word.encode() + b"\0" for word in words))
    (tmp_path / "proc" / "7" / "cwd").symlink_to(games[1])
    (tmp_path / "proc" / "10").mkdir()  # ended since it was listed
    (tmp_path / "proc" / "meminfo").write_text("no process", "utf-8")
    found = running_processes("linux", tmp_path / "proc")
    assert found is not None
    assert {(each.command, each.folder) for each in found} == {("", None), ("bash", None), (PLAIN, games[1])}
    assert folders_played(found) == [games[1]]


def test_unreadable_process_list_is_unknown_and_not_empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert running_processes("linux", tmp_path / "proc") is None
    monkeypatch.setenv("PATH", str(tmp_path))
    assert running_processes("windows") is None


if sys.platform.startswith("linux"):

    def test_running_processes_include_this_one() -> None:
        found = running_processes("linux")
        assert found
        assert any(each.folder == Path(os.path.realpath(".")) and "pytest" in each.command for each in found)


if shutil.which("ps"):

    def test_process_query_for_macos_finds_this_process_here_too() -> None:
        found = running_processes("macos")
        assert found
        assert any("pytest" in each.command for each in found)
