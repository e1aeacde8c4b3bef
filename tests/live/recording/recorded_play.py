"""Random play on the virtual client, recorded, and what a recording's calls say in the plainest way: for tests."""

import itertools
import threading
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit

from mc_nested.arena.action import Action
from mc_nested.arena.game import Following
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.errors import LiveError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Clock
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile
from mc_nested.live.recording.recording_file import TimedCall, read_recording
from mc_nested.live.recording.run_recorder import open_recorder
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.game_screen import WindowScreen
from scripts.benches.person import Hands
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas

STEPS_AN_EPISODE = 25
FONT = font_of(drawn_atlas())


def said_nothing(line: str) -> None:
    """Fail: a recorder has nothing to say while the disk takes everything."""
    raise AssertionError(line)


def scenario_facts(scenario: Scenario) -> dict[str, str]:
    """Return the scenario, as a recording says it."""
    return {"scenario": tomlkit.dumps(table_of(scenario).model_dump(exclude_none=True))}


def drawn(rng: np.random.Generator, scenario: Scenario) -> Following:
    """Return a random action; in a scenario with parts, with a random material."""
    action = Action(int(rng.integers(8)))
    return action, int(rng.integers(len(scenario.materials))) if scenario.parts else None


class StallingClock:
    """A clock of a busy computer: each ``every``-th sleep ends too late, and the watchdog wakes up first."""

    def __init__(self, clock: Clock, every: int, late_s: float = 0.4) -> None:
        self._clock, self._every, self._late_s = clock, every, late_s
        self._sleeps = 0
        self.controller: InputController | None = None

    def now(self) -> float:
        return self._clock.now()

    def sleep_until(self, at: float) -> None:
        self._sleeps += 1
        is_late = self._sleeps % self._every == 0
        self._clock.sleep_until(at + self._late_s * is_late)
        if is_late and self.controller:
            watchdog = threading.Thread(target=self.controller.release_overdue)
            watchdog.start()
            watchdog.join()


def _switch(controller: InputController, hands: Hands, is_theirs: bool) -> None:
    """Take over, or give back, as the thread that listens to the keys does."""
    listener = threading.Thread(target=controller.switch_over)
    listener.start()
    listener.join()
    if is_theirs:
        hands.play(hands.do([Action.L, Action.LD]))


def record_play(
    folder: Path,
    actions: int,
    client: VirtualClient | None = None,
    seed: int = 0,
    scenario_name: str = "diamond",
    *,
    is_told: bool = False,
    stalls_every: int | None = None,
    switches: Iterable[float] = (),
) -> list[LiveError]:
    """Record random actions into a folder, and return the errors of those that failed.

    With ``is_told`` each is announced beside the one before it; with ``stalls_every`` that many sleeps lie between two
    stalls. ``switches`` are the seconds after which a person takes over, or gives back, from a thread of their own, and
    walks to the left meanwhile. The last frames of a game that is given up are kept beside the folder.
    """
    client = client or VirtualClient(seed=seed)
    scenario = load_scenario(scenario_name)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena)
    rng, failed = np.random.default_rng(seed), []
    facts = scenario_facts(scenario)
    with open_recorder(folder, "test", said_nothing, profile, client.devices, facts) as recording:
        assert recording
        clock = StallingClock(client.devices.clock, stalls_every) if stalls_every else None
        devices = recording.devices(replace(client.devices, clock=clock or client.devices.clock))
        controller = InputController(devices, InputTable(), recording.hands)
        hands = Hands(client, arena)
        for is_back, in_s in enumerate(switches):
            client.clock.call_at(client.clock.now() + in_s, partial(_switch, controller, hands, is_back % 2 == 0))
        if clock:
            clock.controller = controller
        connection = GameConnection(
            devices,
            controller,
            WindowScreen(devices.display, FONT, version=client.settings.version),
            journal=recording,
            on_screen=recording.screen,
        )
        with LiveGame(scenario, profile, connection, evidence=folder.parent / "evidence") as game:
            done = 0
            for episode in itertools.count():
                game.reset(episode % len(scenario.materials))
                now = drawn(rng, scenario)
                for left in reversed(range(min(STEPS_AN_EPISODE, actions - done))):
                    then = drawn(rng, scenario) if left else None
                    try:
                        game.act(*now, then if is_told else None)
                    except LiveError as error:
                        failed.append(error)
                        break
                    done += 1
                    now = then or now
                    if done == actions:
                        return failed
    return failed


def timed(path: Path) -> Iterator[tuple[float, list[Any]]]:
    """Return a recording's calls, each at the last time that its clock had told."""
    now = 0.0
    for each in read_recording(path):
        if isinstance(each, TimedCall):
            now = each.call[1] if each.call[0] in ("now", "sleep") else now
            yield now, each.call
