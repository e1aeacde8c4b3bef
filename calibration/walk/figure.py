"""The walk's curve as a picture: hold time against displacement, and how far off the fit each hold ended."""

import io
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from calibration.step import Picture
from calibration.walk.fit import Pace
from calibration.walk.gauge import Gauge
from mc_nested.live.walk import TICK_S, Gait

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE_IN, DPI = (10.0, 4.2), 100

COLOURS: dict[Gait, str] = {"walk": "#1f5fa8", "sneak": "#b8561b"}


def picture_of_walk(gauge: Gauge) -> Picture:
    """The curve, left, and the residuals, right: (420, 1000, 3)."""
    # Loaded here alone, for its time, and for the warnings that it prints where no folder takes its settings.
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE_IN, dpi=DPI, layout="constrained")
    curve, residuals = figure.subplots(1, 2)
    paces: dict[Gait, Pace] = {"walk": gauge.walking, "sneak": gauge.sneaking}
    for gait, pace in paces.items():
        _draw_curve(curve, gauge, gait, pace)
        ends = [(each.track.covered[-1], each.end_off) for each in gauge.good if each.track.gait == gait]
        residuals.plot(*zip(*ends, strict=True), "o", color=COLOURS[gait], markersize=4, alpha=0.7)
    curve.set(xlabel="key held, seconds", ylabel="blocks until standstill", title="How far a hold leads")
    curve.legend(frameon=False)
    residuals.axhline(0, color="0.6", linewidth=0.8)
    widest = max(0.002, 1.2 * max(abs(each.end_off) for each in gauge.good))
    residuals.set(
        xlabel="blocks until standstill",
        ylabel="blocks, measured less fitted",
        ylim=(-widest, widest),
        title=f"Residuals: {gauge.off:.4f} blocks RMS",
    )
    for axes in (curve, residuals):
        axes.grid(color="0.9")
        axes.set_axisbelow(True)
    note = "each dot a hold; the line is what a whole number of ticks covers, a step for each"
    return Picture("How far a held key walks", _drawn(figure), note)


def _drawn(figure: "Figure") -> NDArray[np.uint8]:
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return np.asarray(cv2.imdecode(np.frombuffer(file.getvalue(), np.uint8), cv2.IMREAD_COLOR), np.uint8)


def _draw_curve(axes: "Axes", gauge: Gauge, gait: Gait, pace: Pace) -> None:
    holds = [each for each in gauge.good if each.track.gait == gait]
    most = max(each.ticks for each in holds)
    ticks = np.arange(most + 1)
    axes.step(
        ticks * TICK_S, [pace.covered(int(each)) for each in ticks], where="mid", color=COLOURS[gait], linewidth=1
    )
    axes.plot(
        [each.track.held_s for each in holds],
        [each.track.covered[-1] for each in holds],
        "o",
        color=COLOURS[gait],
        markersize=4,
        alpha=0.7,
        label=f"{gait}: {pace.steady / TICK_S:.3f} blocks a second",
    )
