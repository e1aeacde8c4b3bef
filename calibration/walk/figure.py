"""The walk's curve as a picture: hold time against displacement, and the error of the fit for each hold."""

import io
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from calibration.context import ReportPicture
from calibration.walk.gait_fit import GaitModel
from calibration.walk.walk_model import EmpiricalWalk, WalkModel
from mc_nested.live.model.kinematics import TICK_S, Gait

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE_IN, DPI = (10.0, 4.2), 100

COLOURS: dict[Gait, str] = {"walk": "#1f5fa8", "sneak": "#b8561b"}


def picture_of_walk(walk_model: WalkModel) -> ReportPicture:
    """Draw the curve, left, and the residuals, right: (420, 1000, 3)."""
    figure = _figure()
    curve, residuals = figure.subplots(1, 2)
    models: dict[Gait, GaitModel] = {"walk": walk_model.walking, "sneak": walk_model.sneaking}
    for gait, model in models.items():
        _draw_curve(curve, walk_model, gait, model)
        ends = [(hold.trace.covered[-1], hold.end_error) for hold in walk_model.good if hold.trace.gait == gait]
        residuals.plot(*zip(*ends, strict=True), "o", color=COLOURS[gait], markersize=4, alpha=0.7)
    curve.set(xlabel="key held, seconds", ylabel="blocks until standstill", title="How far a hold leads")
    curve.legend(frameon=False)
    residuals.axhline(0, color="0.6", linewidth=0.8)
    widest = max(0.002, 1.2 * max(abs(hold.end_error) for hold in walk_model.good))
    residuals.set(
        xlabel="blocks until standstill",
        ylabel="blocks, measured less fitted",
        ylim=(-widest, widest),
        title=f"Residuals: {walk_model.fit_rms:.4f} blocks RMS",
    )
    for axes in (curve, residuals):
        axes.grid(color="0.9")
        axes.set_axisbelow(True)
    note = "each dot is a hold; the line is what a whole number of ticks covers, a step for each"
    return ReportPicture("How far a held key walks", _render(figure), note)


def picture_of_empirical_walk(walk: EmpiricalWalk) -> ReportPicture:
    """Draw the holds, and the line through them: (420, 1000, 3)."""
    figure = _figure()
    axes = figure.subplots()
    ticks = np.arange(1, len(walk.table.covered) + 1)
    axes.plot(ticks * TICK_S, walk.table.covered, color=COLOURS["walk"], linewidth=1)
    ends = [(trace.held_s, trace.covered[-1]) for trace in walk.traces]
    axes.plot(*zip(*ends, strict=True), "o", color=COLOURS["walk"], markersize=4, alpha=0.7)
    axes.set(xlabel="key held, seconds", ylabel="blocks until standstill", title="How far a hold leads")
    axes.grid(color="0.9")
    return ReportPicture("How far a held key walks", _render(figure), "each dot is a hold; the line runs through them")


def _figure() -> "Figure":
    # Imported only here: it is slow, and it prints warnings where it finds no folder for its settings.
    from matplotlib.figure import Figure

    return Figure(figsize=SIZE_IN, dpi=DPI, layout="constrained")


def _render(figure: "Figure") -> NDArray[np.uint8]:
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return np.asarray(cv2.imdecode(np.frombuffer(file.getvalue(), np.uint8), cv2.IMREAD_COLOR), np.uint8)


def _draw_curve(axes: "Axes", walk_model: WalkModel, gait: Gait, model: GaitModel) -> None:
    holds = [hold for hold in walk_model.good if hold.trace.gait == gait]
    most = max(hold.ticks for hold in holds)
    ticks = np.arange(most + 1)
    axes.step(
        ticks * TICK_S, [model.covered(int(each)) for each in ticks], where="mid", color=COLOURS[gait], linewidth=1
    )
    axes.plot(
        [hold.trace.held_s for hold in holds],
        [hold.trace.covered[-1] for hold in holds],
        "o",
        color=COLOURS[gait],
        markersize=4,
        alpha=0.7,
        label=f"{gait}: {model.steady / TICK_S:.3f} blocks a second",
    )
