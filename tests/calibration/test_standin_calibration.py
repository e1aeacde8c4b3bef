"""`calibrate all` in a real window, the stand-in's: from a bare profile to the line, built where its server says so."""

import time
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.profile.store import load_profile
from tests.standin_fixture import Standin
from tests.test_end_to_end import built, mc_nested, standing

BARE = """
[window]
title = "^Prismarine Web Client"

[game]
version = "1.18.2"

# It writes names without minecraft:, and draws the chat in a font and at a place of its own.
[blocks]
shown_prefix = ""

[input]
click_s = 0.1
reads_chat = false
"""
"""What no calibration can find out; nothing of font, keys, walk or arena."""

LONGEST_S = 300.0


@pytest.mark.standin
def test_a_bare_profile_is_calibrated_in_five_minutes_and_builds_the_line(standin: Standin, tmp_path: Path) -> None:
    profile = tmp_path / "bare.toml"
    profile.write_text(BARE)
    began = time.monotonic()
    said = mc_nested("calibrate", "all", "--profile", profile, "--font", standin.font, "--yes", env=standin.env)
    assert time.monotonic() - began < LONGEST_S
    found = load_profile(profile)
    assert (found.keys.left, found.keys.right) == ("d", "a"), said
    assert found.calibrated is not None
    assert found.calibrated.window == (1023, 767)
    assert profile.with_name("bare-calibration.html").is_file()

    line, run = load_scenario("line"), tmp_path / "run"
    mc_nested("train", "--scenario", "line", "--stop-at-optimum", "--out", run)
    printed = mc_nested("play", run, "--backend", "live", "--profile", profile, env=standin.env)
    assert f"score {line.optimum:g} of {line.optimum:g}" in printed
    material = printed.split(", in ")[1].split(",")[0]
    arena = found.marked_arena()
    assert standing(standin, arena) == built(arena, line, material)
    assert standin.errors() == []
