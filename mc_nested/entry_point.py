"""What ``gymnasium.make`` and ``make_vec`` make of "mc_nested/Arena-v0", in the simulator or in a running game.

    gymnasium.make("mc_nested/Arena-v0", scenario="diamond")
    gymnasium.make("mc_nested/Arena-v0", scenario="house.schem", layer=2)
    gymnasium.make("mc_nested/Arena-v0", scenario="line", backend="live", profile="default")
    gymnasium.make_vec("mc_nested/Arena-v0", num_envs=8, scenario="line")

``import mc_nested`` registers this module by its name; it is loaded when the first env is made.
"""

import sys
import weakref
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from typing import Any

from gymnasium.vector import AutoresetMode, VectorEnv

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv, NextStepAutoreset
from mc_nested.arrays import Int64s
from mc_nested.design_files.load import load_any_scenario
from mc_nested.errors import ScenarioError, UserError
from sim.grid import GridGame, GridVectorEnv

OpenLive = Callable[..., AbstractContextManager[tuple[Game, Any]]]
"""Opens a running game, as ``live.session.open_live_game`` does."""

SIM, LIVE = "sim", "live"


class MadeArenaEnv(ArenaEnv):
    """An ArenaEnv that opens its game itself, and closes it: with ``close()``, when dropped, or as the program ends.

    Args:
        scenario: a shipped design's name; a file: TOML, .schem, .schematic, .litematic, .nbt or .png; or a Scenario.
            What a person should know about a file's design is a line on standard error.
        render_mode: "rgb_array" or "ansi"; None draws nothing.
        layer: the layer of a schematic, 0 the lowest; None for the lowest that has blocks.
        backend: "sim", the headless simulator, or "live", the window of a running game. A live game asks you on
            standard error to switch to it, and waits until it is in front.
        profile: the name or the file of a live game's profile.
        record: a new folder for a live game's recording, or "off"; None for one among mc-nested recordings.
        server_allowed: whether a live game is played that others may share.
        open_live: opens the running game; None for the one on this desktop.

    Raises:
        ScenarioError: the scenario can't be used.
        UserError: there is no such backend; its kinds ProfileError, FontError, DesktopError and RecordingError: the
            live game can't be played, or recorded there. One line each.
        LiveError: the live game did not come to the front.
    """

    def __init__(
        self,
        scenario: str | Path | Scenario = "line",
        render_mode: str | None = None,
        *,
        layer: int | None = None,
        backend: str = SIM,
        profile: str = "default",
        record: str | Path | None = None,
        server_allowed: bool = False,
        open_live: OpenLive | None = None,
    ) -> None:
        loaded = _loaded(scenario, layer)
        opened = ExitStack()
        self._close = weakref.finalize(self, opened.close)
        game: Game = GridGame(loaded)
        if _is_live(backend):
            game, _ = opened.enter_context(_live(loaded, profile, record, open_live, server_allowed=server_allowed))
        super().__init__(game, loaded, render_mode)

    def close(self) -> None:
        """Close the game; of a live one every key is up then. A second call does nothing."""
        self._running = False
        self._close()


def made_vector_env(
    num_envs: int = 1,
    scenario: str | Path | Scenario = "line",
    render_mode: str | None = None,
    *,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    layer: int | None = None,
    backend: str = SIM,
    **live: Any,
) -> VectorEnv[Int64s, Int64s, Any]:
    """Make what ``gymnasium.make_vec`` returns: arenas in NumPy arrays, or one live game.

    ``reset(options={"material": name})`` chooses for all, a list of indices for each. ``info`` holds the score alone.
    With parts, actions are (num_envs, 2), each beside a material, and ``info`` holds ``earned`` and ``chooses``, too.

    Args:
        num_envs: how many arenas; a live game is one.
        scenario: as MadeArenaEnv takes it.
        render_mode: as MadeArenaEnv takes it; ``render`` returns one picture or text for each arena.
        autoreset_mode: "NextStep", or "Disabled", where ``reset(options={"reset_mask": ...})`` begins an episode.
        layer: as MadeArenaEnv takes it.
        backend: "sim" or "live".
        **live: what MadeArenaEnv takes for a live game.

    Raises:
        UserError: a live game should be several arenas, or the autoreset mode is another; and what MadeArenaEnv raises.
    """
    mode = AutoresetMode(autoreset_mode)
    if mode is AutoresetMode.SAME_STEP:
        raise UserError(
            'autoreset_mode "SameStep" needs vectorization_mode="sync": '
            'there it is one of the vector_kwargs, {"autoreset_mode": "SameStep"}'
        )
    arenas: VectorEnv[Int64s, Int64s, Any]
    if _is_live(backend):
        if num_envs != 1:
            raise UserError(f"a live game is one arena, not {num_envs}: leave out num_envs, or name 1")
        arenas = ArenaVectorEnv([MadeArenaEnv(scenario, render_mode, layer=layer, backend=backend, **live)])
    else:
        arenas = GridVectorEnv([_loaded(scenario, layer)] * num_envs, render_mode)
    return NextStepAutoreset(arenas) if mode is AutoresetMode.NEXT_STEP else arenas


def _loaded(scenario: str | Path | Scenario, layer: int | None) -> Scenario:
    if isinstance(scenario, Scenario):
        if layer is not None:
            raise ScenarioError(f"{scenario.name} is a Scenario, which has one layer: leave out layer=")
        return scenario
    loaded = load_any_scenario(scenario, layer, option="layer=")
    for note in loaded.notes:
        _say(note)
    return loaded.scenario


def _is_live(backend: str) -> bool:
    if backend not in (SIM, LIVE):
        raise UserError(f'there is no backend {backend!r}: choose "{SIM}" or "{LIVE}"')
    return backend == LIVE


def _live(
    scenario: Scenario, profile: str, record: str | Path | None, open_live: OpenLive | None, *, server_allowed: bool
) -> AbstractContextManager[tuple[Game, Any]]:
    # Imported here: who learns in the simulator needs nothing that reads a screen.
    from mc_nested.live.session import Opening, open_live_game

    opening = Opening(profile, _say, f"env-{scenario.name}", record, is_server_allowed=server_allowed)
    return (open_live or open_live_game)(scenario, opening)


def _say(line: str) -> None:
    print(line, file=sys.stderr)
