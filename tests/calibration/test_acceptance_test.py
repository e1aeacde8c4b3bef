"""The acceptance test on the virtual client really builds its design, and notices every error."""

import dataclasses
from pathlib import Path
from typing import cast

import pytest

from calibration.acceptance_test import ACTIONS, SCENARIO, run_acceptance_test
from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.errors import LiveError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Display, Frame, Region
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import BlocksTable, GameVersion, KeysTable, Profile, ScreenTable
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from tests.calibration.contexts import context_over, font_file_in
from tests.sim.client.playing import arena_of


@pytest.fixture(scope="module")
def font(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return font_file_in(tmp_path_factory.mktemp("font"))


def profile_of(client: VirtualClient, font: Path) -> Profile:
    version = GameVersion(version=client.settings.version)
    return Profile(game=version, arena=arena_of(client), screen=ScreenTable(font=str(font)))


def test_acceptance_test_uses_all_eight_actions_and_fills_its_design_by_the_rules() -> None:
    assert sorted(ACTIONS) == list(Action)
    cell, placed = SCENARIO.start, set[Cell]()
    for action in ACTIONS:
        target = rules.moved(cell, action, placed, SCENARIO.size)
        assert target != cell, "each of them moves"
        landing = rules.landing(target, action, placed, SCENARIO.size)
        assert (landing is not None) == (action in rules.PLACES)
        placed |= {landing} if landing else set()
        cell = target
    assert (cell, frozenset(placed)) == (SCENARIO.start, SCENARIO.design)


@pytest.mark.parametrize("seed", range(12))
def test_acceptance_test_names_the_use_item_option_if_use_is_toggled(seed: int, font: Path) -> None:
    client = VirtualClient(version="26.1", seed=seed, options=GameOptions(toggle_use=True))
    with pytest.raises(LiveError, match=r"Options > Controls > Use Item/Place Block"):
        run_acceptance_test(context_over(client), profile_of(client, font))
    assert not client.window.down


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1"])
def test_a_good_profile_passes_and_the_arena_is_left_empty(version: str, font: Path) -> None:
    client = VirtualClient(version=version)
    found = run_acceptance_test(context_over(client), profile_of(client, font))
    assert found.lines[0] == "8 actions, 4 blocks: each where it should be"
    assert (found.samples, len(found.pictures)) == (8, 1)
    assert client.built == {}
    assert not client.window.down


class PushingDisplay:
    """A window whose player is pushed aside in the world, once, when the first block stands."""

    def __init__(self, client: VirtualClient) -> None:
        self._client, self._is_pushed = client, False

    def __getattr__(self, name: str) -> object:
        return getattr(self._client.display, name)

    def grab(self, region: Region | None = None) -> Frame:
        if self._client.built and not self._is_pushed:
            self._is_pushed = True
            x, y, z = self._client.realm.player.feet
            self._client.realm.player.feet = (x + 4.0, y, z)
        return self._client.display.grab(region)


def test_an_agent_that_is_carried_off_once_starts_over(font: Path) -> None:
    client, said = VirtualClient(), list[str]()
    profile = profile_of(client, font)
    context = context_over(client)
    devices = dataclasses.replace(context.devices, display=cast("Display", PushingDisplay(client)))
    pushed = dataclasses.replace(context, connection=GameConnection(devices, context.controller), say=said.append)
    found = run_acceptance_test(pushed, profile)
    assert found.lines[0] == "8 actions, 4 blocks: each where it should be"
    assert [line.rpartition("; ")[2] for line in said] == ["the episode starts over"], said
    assert (client.built, client.window.down) == ({}, set())


class Witness:
    """A window that notes, whenever it is looked at, which cells truly hold a block."""

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        self.seen: set[Cell] = set()
        self._client, self._arena = client, arena

    def size(self) -> tuple[int, int]:
        return self._client.display.size()

    def title(self) -> str:
        return self._client.display.title()

    def is_in_front(self) -> bool:
        return self._client.display.is_in_front()

    def grab(self, region: Region | None = None) -> Frame:
        self.seen |= self._client.placed(self._arena)
        return self._client.display.grab(region)


def test_acceptance_test_really_builds_its_design_before_clearing_it(font: Path) -> None:
    client = VirtualClient()
    profile = profile_of(client, font)
    witness = Witness(client, profile.marked_arena())
    context = context_over(client)
    devices = dataclasses.replace(context.devices, display=witness)
    seen = dataclasses.replace(context, connection=GameConnection(devices, context.controller))
    run_acceptance_test(seen, profile)
    assert witness.seen == SCENARIO.design


@pytest.mark.parametrize(
    "wrong",
    [
        {"keys": KeysTable(left="d", right="a")},
        {"blocks": BlocksTable(shown_prefix="")},
    ],
)
def test_acceptance_test_fails_with_a_wrong_profile(wrong: dict[str, object], font: Path) -> None:
    client = VirtualClient()
    with pytest.raises(LiveError):
        run_acceptance_test(context_over(client), profile_of(client, font).model_copy(update=wrong))
    assert not client.window.down
