"""The steps of the guided run, in their order."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from calibration.arena.build import build_arena
from calibration.arena.stand import NEAR_MIDDLE, check_standing
from calibration.clicks.find import find_some_clicks
from calibration.cross_check import cross_check
from calibration.font.find import find_font, sources_for, sources_here
from calibration.font.sources import FontSources
from calibration.proof import prove
from calibration.run_steps import Step
from calibration.step import Bench, Found
from calibration.walk.measure import walk
from mc_nested.arena.rules import Cell
from mc_nested.live.profile import Profile


def guided_steps(
    font: Path | None = None,
    sources: Callable[[str | None], FontSources] = sources_here,
    *,
    standing: Cell = NEAR_MIDDLE,
    is_server_allowed: bool = False,
    path: Path | None = None,
) -> list[Step]:
    """All of them; buttons that aren't found, and a clipboard that can't be reached, don't end the run.

    ``font`` and ``sources`` are as ``font.sources_for`` takes them; ``standing`` is the cell that the player stands on.
    ``path`` is the profile's file, as ``build_arena`` takes it. UserError for a cell outside the arena.
    """
    check_standing(standing)

    def with_font(bench: Bench, profile: Profile) -> Found:
        return find_font(bench, profile, sources_for(bench, profile, font, sources))

    return [
        Step("font", with_font),
        Step("arena", partial(build_arena, path=path, standing=standing, is_server_allowed=is_server_allowed)),
        Step("walk", partial(walk, is_server_allowed=is_server_allowed)),
        Step("clicks", find_some_clicks, is_needed=False),
        Step("cross-check", cross_check, is_needed=False),
        Step("proof", partial(prove, is_server_allowed=is_server_allowed)),
    ]
