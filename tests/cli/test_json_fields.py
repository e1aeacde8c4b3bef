"""--json prints the fields that --help names, for every verb that has it."""

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import platformdirs
import pytest

from mc_nested.cli import profiles
from mc_nested.cli.app import HIDDEN, VERBS, app_with
from mc_nested.cli.output import epilog_of, json_fields
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import font_of
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.f3_screen import F3Screen
from tests.cli.running import run, verbs_of

COMMANDS = dict(verbs_of(app_with({**VERBS, **HIDDEN})))


def fields_of(verb: str) -> dict[str, str]:
    return json_fields(COMMANDS[verb].callback)


def test_every_verb_with_json_declares_its_fields() -> None:
    has_json = {verb for verb, each in COMMANDS.items() if any("--json" in option.opts for option in each.params)}
    lists = {"runs", "profiles", "recordings"}
    assert {verb for verb in COMMANDS if fields_of(verb)} == has_json - lists
    assert {f"{verb} list" for verb in lists} < has_json


def test_help_ends_with_the_fields(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "evaluate", "--help") == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert shown.endswith("materials: that each trial chose; steps: that each trial took.")
    assert epilog_of(COMMANDS["rehearse"].callback) is None


def printed(capsys: pytest.CaptureFixture[str], *words: str | Path) -> dict[str, Any]:
    capsys.readouterr()
    assert run(*words, "--json") in (0, 1), "1 is the doctor's, where a row fails"
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("verb", ["runs evaluate", "play", "runs show"])
def test_json_of_evaluate_play_and_show_has_the_declared_fields(
    verb: str, trained: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert printed(capsys, *verb.split(), trained).keys() == fields_of(verb).keys()


def test_json_of_a_training_has_the_declared_fields_alone_and_in_a_team(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = printed(capsys, "train", "--episodes", "2", "--out", tmp_path / "run")
    assert found.keys() == fields_of("train").keys()
    assert (found["builders"], found["live"]) == (None, None)
    found = printed(capsys, "train", "--builders", "2", "--episodes", "2", "--out", tmp_path / "team")
    assert found.keys() == fields_of("train").keys()
    assert found["builders"] == 2


def test_json_of_runs_list_has_the_declared_fields(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = printed(capsys, "runs", "list", trained.parent)
    assert found.keys() == fields_of("runs list").keys()
    assert {*found["runs"][0], "files"} == fields_of("runs show").keys()


def test_json_of_profiles_has_the_declared_fields(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    monkeypatch.setattr(profiles, "window_of", lambda _: None)
    save_profile(Profile(), profile_folder() / "mine.toml")
    found = printed(capsys, "profiles")
    assert found.keys() == fields_of("profiles list").keys()
    assert printed(capsys, "profiles", "show", "mine").keys() == fields_of("profiles show").keys()
    assert {*found["profiles"][0], "files"} == fields_of("profiles show").keys()


def test_json_of_scenarios_has_only_declared_fields(capsys: pytest.CaptureFixture[str]) -> None:
    (line,) = printed(capsys, "scenarios", "line")["scenarios"]
    meaning = fields_of("scenarios")["scenarios"]
    assert [name for name in line if name not in meaning] == []
    assert (line["fewest_steps"], line["is_exact"], line["builder_steps"]) == (13, True, 13)
    assert [row.count("#") for row in line["design"]] == [0, 0, *[1] * 11, 0, 0]


def test_json_of_read_has_the_declared_fields(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    screen = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, -65.0)
    grey = np.full((480, 854, 3), 60, np.uint8)
    cv2.imwrite(str(tmp_path / "sky.png"), paint(grey, screen, font_of(drawn_atlas())))
    cv2.imwrite(str(tmp_path / "font.png"), drawn_atlas())
    found = printed(capsys, "read", tmp_path / "sky.png", "--font", tmp_path / "font.png")
    assert found.keys() == fields_of("read").keys()


def test_json_of_the_doctor_has_the_declared_fields(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    found = printed(capsys, "doctor")
    assert found.keys() == fields_of("doctor").keys()
    assert found["checks"][0].keys() == {"name", "status", "detail", "fix"}
