"""Launchers' folders: found on every system from any other, the right one first, and nothing that isn't there."""

import json
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.installation.folders import LAUNCHERS, Platform, System, client_jars, game_folders, jar_version

SUPPORT = "Library/Application Support"
ROAMING = "AppData/Roaming"


def system(home: Path, platform: Platform = "linux", **environment: str) -> System:
    return System(platform, home, environment)


def game(folder: Path, used: float = 1000.0) -> Path:
    """Return a game folder whose options.txt was written at that time."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "options.txt").write_text("lang:en_us\n", "utf-8")
    os.utime(folder / "options.txt", (used, used))
    return folder


def jar(file: Path, content: str = "classes") -> Path:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(content, "utf-8")
    return file


@pytest.mark.parametrize(
    ("platform", "way", "launcher"),
    [
        ("windows", f"{ROAMING}/.minecraft", "Minecraft Launcher"),
        ("macos", f"{SUPPORT}/minecraft", "Minecraft Launcher"),
        ("linux", ".minecraft", "Minecraft Launcher"),
        ("windows", f"{ROAMING}/PrismLauncher/instances/Mine/.minecraft", "Prism Launcher"),
        ("macos", f"{SUPPORT}/PrismLauncher/instances/Mine/minecraft", "Prism Launcher"),
        ("linux", ".local/share/PrismLauncher/instances/Mine/minecraft", "Prism Launcher"),
        (
            "linux",
            ".var/app/org.prismlauncher.PrismLauncher/data/PrismLauncher/instances/Mine/.minecraft",
            "Prism Launcher",
        ),
        ("windows", "Desktop/MultiMC/instances/Mine/.minecraft", "MultiMC"),
        ("macos", "Applications/MultiMC.app/Data/instances/Mine/.minecraft", "MultiMC"),
        ("linux", ".local/share/multimc/instances/Mine/minecraft", "MultiMC"),
        ("windows", f"{ROAMING}/ModrinthApp/profiles/Mine", "Modrinth App"),
        ("macos", f"{SUPPORT}/ModrinthApp/profiles/Mine", "Modrinth App"),
        ("linux", ".local/share/com.modrinth.theseus/profiles/Mine", "Modrinth App"),
        ("windows", "curseforge/minecraft/Instances/Mine", "CurseForge"),
        ("macos", "Documents/curseforge/minecraft/Instances/Mine", "CurseForge"),
        ("linux", "Documents/curseforge/minecraft/Instances/Mine", "CurseForge"),
    ],
)
def test_game_folder_of_each_launcher_is_found(platform: Platform, way: str, launcher: str, tmp_path: Path) -> None:
    folder = game(tmp_path / way)
    found = game_folders(system(tmp_path, platform))
    assert [(each.path, each.launcher, each.options) for each in found] == [(folder, launcher, folder / "options.txt")]


@pytest.mark.parametrize(
    ("platform", "way"),
    [
        ("windows", f"{ROAMING}/.minecraft/versions/1.20.1/1.20.1.jar"),
        ("macos", f"{SUPPORT}/minecraft/versions/1.20.1/1.20.1.jar"),
        ("linux", ".minecraft/versions/1.20.1/1.20.1.jar"),
        (
            "linux",
            ".local/share/PrismLauncher/libraries/com/mojang/minecraft/1.20.1/minecraft-1.20.1-client.jar",
        ),
        ("linux", ".local/share/multimc/libraries/com/mojang/minecraft/1.20.1/minecraft-1.20.1-client.jar"),
        ("macos", f"{SUPPORT}/ModrinthApp/meta/versions/1.20.1/1.20.1.jar"),
        ("windows", f"{ROAMING}/ModrinthApp/meta/versions/1.20.1-0.15.11/1.20.1-0.15.11.jar"),
        ("windows", "curseforge/minecraft/Install/versions/1.20.1/1.20.1.jar"),
    ],
)
def test_each_launchers_client_jar_is_found_and_its_version_known(platform: Platform, way: str, tmp_path: Path) -> None:
    file = jar(tmp_path / way)
    assert client_jars(system(tmp_path, platform), "1.20.1") == [file]
    assert jar_version(file) == "1.20.1"


def test_every_launcher_has_a_folder_on_every_platform() -> None:
    assert len(LAUNCHERS) == 5
    assert all(launcher.roots[platform] for launcher in LAUNCHERS for platform in ("windows", "macos", "linux"))


def test_environment_variable_moves_a_launchers_folder(tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    moved = game(elsewhere / "PrismLauncher" / "instances" / "Mine" / ".minecraft")
    assert [each.path for each in game_folders(system(tmp_path, XDG_DATA_HOME=str(elsewhere)))] == [moved]
    windows = game(elsewhere / ".minecraft")
    assert windows in [each.path for each in game_folders(system(tmp_path, "windows", APPDATA=str(elsewhere)))]


@pytest.mark.parametrize("variable", ["", "data"])
def test_a_variable_without_an_absolute_path_is_ignored(variable: str, tmp_path: Path) -> None:
    folder = game(tmp_path / ".local/share/multimc/instances/Mine/.minecraft")
    assert [each.path for each in game_folders(system(tmp_path, XDG_DATA_HOME=variable))] == [folder]


def test_game_with_the_newest_options_or_log_comes_first(tmp_path: Path) -> None:
    old, new = game(tmp_path / ".minecraft", 5000.0), game(tmp_path / ".local/share/ModrinthApp/profiles/New", 6000.0)
    assert [each.path for each in game_folders(system(tmp_path))] == [new, old]
    log = jar(old / "logs" / "latest.log")
    os.utime(log, (7000.0, 7000.0))
    assert [each.path for each in game_folders(system(tmp_path))] == [old, new]


def test_the_game_of_the_right_version_comes_first_and_one_of_a_wrong_version_last(tmp_path: Path) -> None:
    instances = tmp_path / ".local/share/PrismLauncher/instances"
    right, wrong = game(instances / "Right" / ".minecraft", 1000.0), game(instances / "Wrong" / ".minecraft", 3000.0)
    curse = game(tmp_path / "Documents/curseforge/minecraft/Instances/Pack", 4000.0)
    unknown = game(tmp_path / ".minecraft", 2000.0)
    for folder, version in ((right, "1.20.1"), (wrong, "1.12.2")):
        parts = [{"uid": "org.lwjgl3", "version": "3.3.1"}, {"uid": "net.minecraft", "version": version}]
        (folder.parent / "mmc-pack.json").write_text(json.dumps({"components": parts}), "utf-8")
    (curse / "minecraftinstance.json").write_text('{"gameVersion": "1.19.2"}', "utf-8")
    found = game_folders(system(tmp_path), "1.20.1")
    assert [(each.path, each.version) for each in found] == [
        (right, "1.20.1"),
        (unknown, None),
        (curse, "1.19.2"),
        (wrong, "1.12.2"),
    ]


@pytest.mark.parametrize(
    "broken",
    [
        *("{", "[]", '{"components": 3}', '{"components": [1, {"uid": "net.minecraft"}]}'),
        '{"components": [{"uid": "net.minecraft", "version": 5}]}',
        '{"components": [{"uid": "net.minecraft", "version": ""}]}',
    ],
)
def test_unreadable_launcher_file_leaves_the_version_unknown(broken: str, tmp_path: Path) -> None:
    folder = game(tmp_path / ".local/share/PrismLauncher/instances/Mine/.minecraft")
    (folder.parent / "mmc-pack.json").write_text(broken, "utf-8")
    assert [each.version for each in game_folders(system(tmp_path))] == [None]


def test_folder_without_an_options_file_is_left_out(tmp_path: Path) -> None:
    (tmp_path / ".minecraft" / "options.txt").mkdir(parents=True)
    (tmp_path / ".local/share/PrismLauncher/instances/New/.minecraft").mkdir(parents=True)
    assert game_folders(system(tmp_path)) == []
    assert client_jars(system(tmp_path)) == []


def test_game_folder_reached_by_two_paths_is_listed_once(tmp_path: Path) -> None:
    game(tmp_path / ".local/share/PrismLauncher/instances/Mine/.minecraft")
    (tmp_path / ".local/share/PrismLauncher/instances/Mine/minecraft").symlink_to(".minecraft")
    assert len(game_folders(system(tmp_path))) == 1


def jars_of(home: Path, *versions: str) -> None:
    for version in versions:
        jar(home / ".minecraft" / "versions" / version / f"{version}.jar")


def test_the_plain_jar_of_the_version_comes_first_then_older_ones_then_newer_ones(tmp_path: Path) -> None:
    jars_of(tmp_path, "1.19.4", "1.20", "1.20.1", "1.20.1-forge-47.2.0", "1.12.2", "1.20.2", "26.1", "1.21.10")
    found = [each.stem for each in client_jars(system(tmp_path), "1.20.1")]
    assert found == [
        "1.20.1",
        "1.20.1-forge-47.2.0",
        "1.20",
        "1.19.4",
        "1.12.2",
        "1.20.2",
        "1.21.10",
        "26.1",
    ]


def test_without_a_version_the_newest_jar_comes_first_and_26_1_is_newer_than_1_21(tmp_path: Path) -> None:
    jars_of(tmp_path, "1.9", "1.21.10", "1.21.9", "26.1", "1.21")
    assert [each.stem for each in client_jars(system(tmp_path))] == ["26.1", "1.21.10", "1.21.9", "1.21", "1.9"]


def test_mod_loader_jars_are_not_taken_for_client_jars(tmp_path: Path) -> None:
    jars_of(tmp_path, "fabric-loader-0.15.11-1.20.1")
    jar(tmp_path / ".minecraft/versions/1.20.1/1.20.1.jar", content="")
    assert client_jars(system(tmp_path), "1.20.1") == []


VERSIONS = st.lists(st.tuples(st.integers(1, 30), st.integers(0, 30), st.integers(0, 12)), min_size=1, max_size=6)


@given(numbers=VERSIONS, data=st.data())
def test_jar_of_the_wanted_version_comes_first_among_any_jars(
    numbers: list[tuple[int, int, int]], data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    names = sorted({".".join(str(part) for part in each) for each in numbers})
    home = tmp_path_factory.mktemp("home")
    jars_of(home, *names)
    wanted = data.draw(st.sampled_from(names))
    found = [each.stem for each in client_jars(system(home), wanted)]
    assert found[0] == wanted
    assert sorted(found) == names


def test_this_computer_has_a_known_platform_and_an_absolute_home() -> None:
    here = System.here()
    assert here.platform in ("linux", "macos", "windows")
    assert here.home.is_absolute()
