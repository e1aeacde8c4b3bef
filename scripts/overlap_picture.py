"""A picture of four blocks on the virtual client: once each action waits for the one before, once they overlap."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.profile.arena import Arena
from scripts.benches.live import live_game
from sim.client.client import VirtualClient

CELLS, SAMPLE_S, REST_S = 4, 0.001, 0.5
TO_LEARN_THE_TICKS = [Action.B, Action.L, Action.R, Action.L, Action.R]
TITLES = {False: "each action waits until the one before is confirmed", True: "the next cell begins meanwhile"}


@dataclass
class Course:
    """In seconds from the first action; ``cells`` is how far back the player was after each of ``ticks``."""

    ticks: list[float] = field(default_factory=list)
    cells: list[float] = field(default_factory=list)
    holds: list[tuple[float, float]] = field(default_factory=list)
    clicks: list[float] = field(default_factory=list)
    stood: list[float] = field(default_factory=list)
    reported: list[float] = field(default_factory=list)


def course_of(*, overlaps: bool) -> Course:
    """Build four blocks backward, from a standstill; the clock is the client's."""
    client, scenario = VirtualClient(seed=4), load_scenario("line")
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    course, was_down = Course(), set[str]()
    with live_game(client, scenario, arena, overlaps=overlaps) as game:
        game.reset(0)
        for action in (*TO_LEARN_THE_TICKS, Action.B):
            game.act(action)
        game.connection.controller.wait(REST_S)
        began, ticks, from_cell = client.clock.now(), -1, client.cell(arena)[1]

        def sample() -> None:
            nonlocal ticks, was_down
            at = client.clock.now() - began
            client.clock.call_at(client.clock.now() + SAMPLE_S, sample)
            if client.game.ticks > ticks:
                ticks = client.game.ticks
                course.ticks.append(at)
                course.cells.append(from_cell - arena.position_of(client.realm.player.feet).forward)
            down = set(client.window.down)
            if "s" in down:
                course.holds.append((course.holds.pop()[0] if "s" in was_down else at, at))
            course.clicks += [at] * ("right button" in down - was_down)
            was_down = down
            course.stood += [at] * (len(client.placed(arena)) - len(course.stood))

        sample()
        for left in reversed(range(CELLS)):
            game.act(Action.BD, None, (Action.BD, None) if left else None)
            course.reported.append(client.clock.now() - began)
    return course


def draw_overlap(out: Path) -> None:
    """Draw both ways, one above the other on one axis of time."""
    figure = Figure(figsize=(9, 5.6), dpi=110, layout="constrained")
    rows = figure.subplots(2, 1, sharex=True)
    for axes, (overlaps, title) in zip(rows, TITLES.items(), strict=True):
        course = course_of(overlaps=overlaps)
        downs, ups = zip(*course.holds, strict=True)
        axes.set_title(f"{title}: {course.reported[-1]:.2f} s", loc="left", fontsize=11)
        axes.plot(course.ticks, course.cells, color="0.55", marker=".", label="position, tick by tick")
        axes.hlines([-0.85] * len(course.holds), downs, ups, "k", linewidth=6, label="key down")
        for label, times, look in (("click", course.clicks, "vw"), ("block stands", course.stood, "sk")):
            where = np.interp(times, course.ticks, course.cells)
            axes.plot(times, where, look[0], mec="k", mfc=look[1], ms=8, label=label)
        axes.vlines(course.reported, -1.2, 4.5, "k", "dotted", label="outcome reported")
        axes.set(yticks=range(CELLS + 1), ylim=(-1.2, 4.5), ylabel="cells back")
        axes.set_yticks([border - 0.5 for border in range(CELLS + 1)], minor=True)
        axes.grid(which="minor", axis="y", color="0.85")
    rows[1].set_xlabel("seconds")
    figure.legend(*rows[0].get_legend_handles_labels(), loc="outside lower center", ncols=5, frameon=False)
    figure.savefig(out, format="png", metadata={"Software": None})
