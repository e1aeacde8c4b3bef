"""The calibration steps, registered in the order in which ``mc-nested calibrate all`` runs them."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from calibration.acceptance_test import run_acceptance_test
from calibration.arena.build import build_arena
from calibration.arena.mark import check_standing
from calibration.calibrate_all import CalibrationStep
from calibration.clicks.find import find_clicks_unattended
from calibration.cross_check import cross_check
from calibration.font.find import find_font, sources_for, sources_here
from calibration.font.sources import FontSources
from calibration.walk.measure import walk
from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.live.profile.arena import near_middle


def registered_steps(
    font: Path | None = None,
    sources: Callable[[str | None], FontSources] = sources_here,
    *,
    size: int = DEFAULT_SIZE,
    standing: Cell | None = None,
    path: Path | None = None,
) -> list[CalibrationStep]:
    """Return all steps. Missing buttons and an unreachable clipboard don't end the run.

    ``font`` and ``sources`` are as in ``font.sources_for``. ``size``, ``standing`` and ``path`` are as in
    ``build_arena``. UserError as ``check_standing``.
    """
    check_standing(near_middle(size) if standing is None else standing, size)
    return [
        CalibrationStep("font", lambda opened, own: find_font(opened, own, sources_for(opened, own, font, sources))),
        CalibrationStep("arena", partial(build_arena, path=path, size=size, standing=standing)),
        CalibrationStep("walk", walk),
        CalibrationStep("clicks", find_clicks_unattended, is_needed=False),
        CalibrationStep("cross-check", cross_check, is_needed=False),
        CalibrationStep("proof", run_acceptance_test),
    ]
