"""Everything a player on Windows does, under Wine: read, doctor, calibrate, play, serve, in a rehearsal window.

Beside one other window at most: they are drawn in real time. What was built is judged by what the client says.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import pytest
import tomlkit

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import parse_profile
from mc_nested.workers.cluster.keys import make_keys
from scripts.rehearsal_window import TruthReader, mc_nested, write_font
from scripts.window_display import wait_until
from scripts.windows_parts import windows_path
from scripts.windows_session import Session
from sim.client.client import VirtualClient
from tests.learn.made_experiments import DOT, scenario_text
from tests.workers.cluster.dask_programs import scheduler, tls_words

pytestmark = pytest.mark.wine

OPENING_S = 60.0
CALIBRATION_S = 300.0
PLAY_S = 200.0


@dataclass(frozen=True)
class Rehearsal:
    """A rehearsal window, and the folder with its font, its truth and the profile, by this system's names."""

    windows: Session
    folder: Path

    @property
    def truth(self) -> TruthReader:
        """The world as it truly is."""
        return TruthReader(self.folder / "truth.json")

    @property
    def profile(self) -> Path:
        return self.folder / "profile.toml"

    def arena(self) -> Arena:
        """Return the arena of the profile; its font's path is a Windows one, which means nothing here."""
        profile = tomlkit.parse(self.profile.read_text(encoding="utf-8"))
        profile["screen"].pop("font")
        return parse_profile(tomlkit.dumps(profile), str(self.profile)).marked_arena()

    def command(self, *arguments: str | Path, timeout_s: float) -> tuple[int, str]:
        """Return the exit code and the words of ``mc-nested``; files are named as Windows names them."""
        words = [windows_path(word) if isinstance(word, Path) else word for word in arguments]
        return self.windows.python("-m", "mc_nested.cli", *words, timeout_s=timeout_s)


@pytest.fixture(scope="module")
def rehearsal(windows: Session, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Rehearsal]:
    found = Rehearsal(windows, tmp_path_factory.mktemp("rehearsal"))
    font, truth = found.folder / "font.png", found.folder / "truth.json"
    write_font(font)
    words = ["--truth", windows_path(truth), "--font", windows_path(font)]
    with windows.started("-m", "mc_nested.cli", "rehearse", *words) as window:
        assert wait_until(lambda: truth.exists() or window.has_ended, OPENING_S)
        assert not window.has_ended, window.printed()
        yield found


@pytest.fixture(scope="module")
def calibrated(rehearsal: Rehearsal) -> Rehearsal:
    """Return the rehearsal with its profile, made from nothing without a hand."""
    words = ("calibrate", "all", "--yes", "--profile", rehearsal.profile, "--font", rehearsal.folder / "font.png")
    code, said = rehearsal.command(*words, timeout_s=CALIBRATION_S)
    assert code == 0, said
    return rehearsal


def test_picture_of_the_debug_screen_is_read_with_the_clients_position(windows: Session, tmp_path: Path) -> None:
    client = VirtualClient(capture_latency_s=(0.0, 0.0))
    client.clock.sleep(1.0)
    picture, font = tmp_path / "f3.png", tmp_path / "font.png"
    cv2.imwrite(str(picture), client.display.grab())
    write_font(font)
    words = ("read", windows_path(picture), "--font", windows_path(font), "--json")
    code, said = windows.python("-m", "mc_nested.cli", *words, timeout_s=60)
    assert code == 0, said
    assert json.loads(said)["xyz"] == pytest.approx(client.realm.player.feet, abs=0.001)


def test_doctor_without_a_profile_passes_the_windows_rows_and_skips_the_profiles(rehearsal: Rehearsal) -> None:
    code, said = rehearsal.command("doctor", "--json", "--profile", rehearsal.profile, timeout_s=90)
    assert code == 1
    rows = {check["name"]: check for check in json.loads(said[said.index("{") :])["checks"]}
    for name in ("session", "game's window", "in front", "clipboard"):
        assert rows[name]["status"] == "pass", rows[name]
    assert rows["profile"]["status"] == "skip"


def test_a_line_is_built_block_by_block_and_no_key_stays_down(calibrated: Rehearsal, tmp_path: Path) -> None:
    scenario = load_scenario("line")
    run = tmp_path / "run"
    mc_nested("train", "--preset", "tuned", "--stop-at-optimum", "--out", run, env={})
    code, said = calibrated.command("play", run, "--backend", "live", "--profile", calibrated.profile, timeout_s=PLAY_S)
    assert code == 0, said
    assert f"score {scenario.optimum:g} of {scenario.optimum:g}" in said
    arena = calibrated.arena()
    block = scenario.materials[scenario.material_index(said.split(", in ")[1].split(",")[0])].block
    assert calibrated.truth.standing(arena) == {arena.block_of(cell): block for cell in scenario.design}
    assert calibrated.truth.keys_left_down() == []


def test_doctor_with_a_calibrated_profile_passes_profile_font_screen_and_input(calibrated: Rehearsal) -> None:
    code, said = calibrated.command("doctor", "--json", "--profile", calibrated.profile, timeout_s=120)
    rows = {check["name"]: check for check in json.loads(said[said.index("{") :])["checks"]}
    assert code == 0, said
    for name in ("profile", "font", "debug screen", "position line", "input"):
        assert rows[name]["status"] == "pass", rows[name]


def test_game_on_windows_is_served_to_a_learner_on_this_system_over_tls(calibrated: Rehearsal, tmp_path: Path) -> None:
    design, run = tmp_path / "design.toml", tmp_path / "run"
    design.write_text(scenario_text(DOT), "utf-8")
    pc, learner = make_keys(tmp_path / "keys", ["pc", "learner"])
    with scheduler(tmp_path, *tls_words(learner)) as url:
        words = ("train", "serve", "--scheduler", url, "--keys", windows_path(pc), "--name", "pc")
        profile = ("--profile", windows_path(calibrated.profile), "--evidence", windows_path(tmp_path / "evidence"))
        with calibrated.windows.started("-m", "mc_nested.cli", *words, *profile) as game:
            cluster = ("--games", url, "--keys", learner)
            live = ("--backend", "live", "--preset", "model-based", "--scenario", design, "--episodes", "2")
            mc_nested("train", *live, *cluster, "--out", run, env={}, timeout_s=PLAY_S)
            said = game.printed()
    assert json.loads((run / "summary.json").read_text("utf-8"))["episodes_done"] == [2], said
    assert "pc has joined" in said
    assert "episode 2: score" in said
    assert calibrated.truth.keys_left_down() == []
