"""``--fix``: safe values, a backup that nothing overwrites, and never while the game may be open."""

import json
import sys
import zipfile
from pathlib import Path

import pytest

from calibration.doctor.examination import Examination
from calibration.doctor.repair import repair
from calibration.installation.processes import Process
from mc_nested.errors import ProfileError
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable
from sim.client.client import VirtualClient
from tests.calibration.doctor.examined import GOOD, Computer, calibrated, opened, statuses
from tests.calibration.doctor.test_examination import no_session, no_window, several

BAD = (
    GOOD.replace("pauseOnLostFocus:false", "pauseOnLostFocus:true")
    .replace("autoJump:false", "autoJump:true")
    .replace("guiScale:2", "guiScale:0")
    .replace("lang:en_us", "lang:de_de")
)
OLD = (
    "guiScale:9\r\nlang:en_us\r\npauseOnLostFocus:true\r\nautoJump:true\r\nfullscreen:true\r\n"
    "key_key.forward:17\r\nkey_key.use:-99\r\n"
)


@pytest.fixture
def computer(tmp_path: Path) -> Computer:
    return Computer(tmp_path, BAD)


def repaired_in(computer: Computer, found: Examination) -> tuple[bool, str]:
    """Repair what the doctor found; return whether anything was changed, and the last line that was said."""
    is_done = repair(found, computer.said.append)
    return is_done, computer.said[-1]


def files_beside(computer: Computer) -> list[str]:
    return sorted(file.name for file in computer.options.parent.iterdir() if file != computer.entries)


def test_repair_writes_safe_values_and_keeps_a_backup_of_the_file(computer: Computer) -> None:
    computer.save(Profile(screen=ScreenTable(font=str(computer.font))))
    found = computer.examined(no_window)
    seen = statuses(found)
    assert [seen[name] for name in ("autoJump", "pauseOnLostFocus", "guiScale", "language")] == [
        *("fail", "warn", "warn", "warn")
    ]
    is_done, said = repaired_in(computer, found)
    assert is_done
    assert "autoJump true -> false" in said
    assert computer.options.read_text("utf-8") == GOOD
    assert (computer.options.parent / "options.txt.before-1").read_text("utf-8") == BAD
    after = statuses(computer.examined(no_window))
    assert {after[name] for name in ("autoJump", "pauseOnLostFocus", "guiScale", "language")} == {"pass"}


def test_the_options_of_1_12_are_repaired_in_their_own_form(computer: Computer) -> None:
    computer.options.write_bytes(OLD.encode())
    assert repaired_in(computer, computer.examined(no_window))[0]
    expected = OLD.replace("true", "false").replace("guiScale:9", "guiScale:2")
    assert computer.options.read_bytes() == expected.encode()


def test_the_options_of_26_3_are_repaired_too_and_any_scale_of_the_debug_screen_stays(computer: Computer) -> None:
    spoilt = (
        GOOD.replace("toggleUse:false", "toggleUse:true")
        .replace("toggleAttack:false", "toggleAttack:true")
        .replace("saveChatDrafts:false", "saveChatDrafts:true")
        .replace("chatVisibility:0", "chatVisibility:2")
        .replace("Opacity:0.5", "Opacity:0.1")
        .replace("ChatOnly:true", "ChatOnly:false")
        .replace("friends:key.keyboard.unknown", "friends:key.keyboard.o")
        .replace("debugGuiScale:0", "debugGuiScale:-1")
    )
    computer.options.write_text(spoilt, "utf-8")
    assert repaired_in(computer, computer.examined(no_window))[0]
    repaired = GOOD.replace("Opacity:0.5", "Opacity:0.1").replace("debugGuiScale:0", "debugGuiScale:-1")
    assert computer.options.read_text("utf-8") == repaired


def test_repair_sets_an_invalid_debug_screen_scale_to_the_default(computer: Computer) -> None:
    computer.options.write_text(GOOD.replace("debugGuiScale:0", "debugGuiScale:half"), "utf-8")
    assert repaired_in(computer, computer.examined(no_window))[0]
    assert computer.options.read_text("utf-8") == GOOD


def test_repair_sets_the_profiles_gui_scale(computer: Computer) -> None:
    calibrated = CalibratedTable(date="2026-11-21", gui_scale=3)
    computer.save(Profile(screen=ScreenTable(font=str(computer.font)), calibrated=calibrated))
    repaired_in(computer, computer.examined(no_window))
    assert "guiScale:3\n" in computer.options.read_text("utf-8")


OF_26_3 = GOOD.replace("version:3465", "version:5023")
"""An options.txt by which the installed version has entries of the debug screen."""


def uncalibrated(computer: Computer, entries: str | None) -> Computer:
    """Return the computer with 26.3 installed, never calibrated, with that debug-profile.json or none."""
    computer.save(Profile(screen=ScreenTable(font=str(computer.font))))
    computer.options.write_text(OF_26_3, "utf-8")
    computer.entries.unlink()
    if entries is not None:
        computer.entries.write_text(entries, "utf-8")
    return computer


def test_repair_writes_a_debug_profile_with_the_needed_entries_if_there_was_none(computer: Computer) -> None:
    found = uncalibrated(computer, None).examined(no_window)
    assert statuses(found)["debug entries"] == "fail"
    is_done, said = repaired_in(computer, found)
    assert is_done
    assert said == f"{computer.entries}: looking_at_block_state switched on; there was none"
    written = json.loads(computer.entries.read_bytes())
    assert (written["DataVersion"], len(written["custom"])) == (4671, 10)
    assert computer.options.read_text("utf-8") == OF_26_3
    assert statuses(computer.examined(no_window))["debug entries"] == "pass"
    assert not repaired_in(computer, computer.examined(no_window))[0]


@pytest.mark.parametrize(
    "before", ['{"profile":"performance"}', "damaged", '{"DataVersion":5023,"custom":{"a:b":"never"}}']
)
def test_repair_replaces_the_debug_profile_and_keeps_a_backup(before: str, computer: Computer) -> None:
    is_done, said = repaired_in(computer, uncalibrated(computer, before).examined(no_window))
    assert is_done
    kept = computer.entries.with_name("debug-profile.json.before-1")
    assert said.endswith(f"switched on; as it was: {kept}")
    assert kept.read_text("utf-8") == before
    assert statuses(computer.examined(no_window))["debug entries"] == "pass"


def test_repair_takes_the_data_version_from_the_installed_versions_jar(computer: Computer) -> None:
    uncalibrated(computer, None)
    computer.save(Profile(calibrated=calibrated().model_copy(update={"version": "26.3"})))
    computer.options.write_text(OF_26_3.replace("version:5023\n", ""), "utf-8")
    jar = computer.options.parent / "versions" / "26.3" / "26.3.jar"
    jar.parent.mkdir(parents=True)
    with zipfile.ZipFile(jar, "w") as file:
        file.writestr("version.json", '{"id":"26.3","world_version":5023}')
    assert repaired_in(computer, computer.examined(no_window))[0]
    assert json.loads(computer.entries.read_bytes())["DataVersion"] == 5023


def test_debug_profile_that_changed_since_the_examination_is_left_alone(computer: Computer) -> None:
    found = uncalibrated(computer, None).examined(no_window)
    computer.entries.write_text("{}", "utf-8")
    with pytest.raises(ProfileError, match="has changed meanwhile"):
        repair(found, computer.said.append)
    assert computer.entries.read_text("utf-8") == "{}"


def test_no_backup_is_ever_overwritten(computer: Computer) -> None:
    repaired_in(computer, computer.examined(no_window))
    computer.options.write_text(BAD.replace("lang:de_de", "lang:fr_fr"), "utf-8")
    repaired_in(computer, computer.examined(no_window))
    assert files_beside(computer) == ["options.txt", "options.txt.before-1", "options.txt.before-2"]
    assert "lang:de_de" in (computer.options.parent / "options.txt.before-1").read_text("utf-8")


def test_options_file_with_safe_values_is_left_alone(computer: Computer) -> None:
    computer.options.write_text(GOOD, "utf-8")
    is_done, said = repaired_in(computer, computer.examined(no_window))
    assert (is_done, said) == (False, f"nothing to fix: {computer.options} is as it should be")
    assert files_beside(computer) == ["options.txt"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows lets only administrators make links, Wine nobody")
def test_repair_writes_through_a_symbolic_link(computer: Computer) -> None:
    shared = computer.system.home / "shared.txt"
    computer.options.rename(shared)
    computer.options.symlink_to(shared)
    assert repaired_in(computer, computer.examined(no_window))[0]
    assert computer.options.is_symlink()
    assert "autoJump:false" in shared.read_text("utf-8")


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("java net.minecraft.client.main.Main --gameDir {folder} --version 1.20.1", "a game runs that may use"),
        ("java org.prismlauncher.EntryPoint", "a game runs that may use"),
    ],
)
def test_repair_writes_nothing_while_a_game_may_run_in_that_folder(
    command: str, message: str, computer: Computer
) -> None:
    computer.processes = [Process(command.format(folder=computer.options.parent))]
    is_done, said = repaired_in(computer, computer.examined(no_window))
    assert not is_done
    assert message in said
    assert computer.options.read_text("utf-8") == BAD


def test_game_running_in_another_folder_does_not_prevent_the_repair(computer: Computer) -> None:
    computer.processes = [Process("java net.minecraft.client.main.Main --gameDir /elsewhere --version 1.20.1")]
    assert repaired_in(computer, computer.examined(no_window))[0]


def test_repair_writes_nothing_while_a_game_window_is_open(computer: Computer) -> None:
    for found in (computer.examined(opened(VirtualClient())), computer.examined(several)):
        is_done, said = repaired_in(computer, found)
        assert (is_done, said) == (False, "nothing was changed: the game is open: close it, and run this again")
    assert computer.options.read_text("utf-8") == BAD


def test_repair_writes_nothing_unless_the_game_is_known_to_be_closed(computer: Computer) -> None:
    computer.processes = None
    is_done, said = repaired_in(computer, computer.examined(no_window, session=no_session))
    assert not is_done
    assert "nobody knows whether the game is closed" in said
    # Either alone is enough: no window on a desktop that was looked at, or no process that could be it.
    assert repaired_in(computer, computer.examined(no_window))[0]
    computer.options.write_text(BAD, "utf-8")
    computer.processes = []
    assert repaired_in(computer, computer.examined(no_window, session=no_session))[0]


def test_without_options_there_is_nothing_to_fix(computer: Computer) -> None:
    computer.options.unlink()
    assert repaired_in(computer, computer.examined(no_window)) == (False, "nothing to fix: no options.txt was read")


def test_options_file_that_changed_since_the_examination_is_left_alone(computer: Computer) -> None:
    found = computer.examined(no_window)
    computer.options.write_text(GOOD, "utf-8")
    with pytest.raises(ProfileError, match="has changed meanwhile"):
        repair(found, computer.said.append)
    assert files_beside(computer) == ["options.txt"]


@pytest.mark.parametrize(
    ("error", "told"), [(OSError("the disk is full"), ProfileError), (KeyboardInterrupt(), KeyboardInterrupt)]
)
def test_repair_that_fails_or_is_interrupted_leaves_the_file_as_it_was(
    error: BaseException, told: type[BaseException], computer: Computer, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = computer.examined(no_window)

    def break_off(_self: Path, _target: Path) -> Path:
        raise error

    monkeypatch.setattr(Path, "replace", break_off)
    with pytest.raises(told):
        repair(found, computer.said.append)
    assert computer.options.read_text("utf-8") == BAD
    assert not [name for name in files_beside(computer) if name.endswith(".part")]
