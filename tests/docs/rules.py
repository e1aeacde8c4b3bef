"""How each command of the pages is run. One that no rule here knows fails its page's test, by name."""

import re
import shlex
from collections.abc import Callable

from tests.design_files import written

SIZES = {
    "mc-nested reproduce": "--trials 1 --episodes 4 --scenario line",
    "mc-nested study robustness": "--trials 1 --episodes 1 --scenario line",
    "mc-nested study beyond": "--trials 1 --episodes 4",
    "mc-nested study objectives": "--trials 1 --episodes 2",
    "mc-nested study ablation": "--trials 1 --episodes 1 --scenario line",
    "mc-nested study sweep": "--trials 1 --episodes 2 --scenario line",
    "mc-nested study benchmark --agents nested --presets any-design": "--designs 2",
    "mc-nested study benchmark": "--designs 1 --agents nested --presets model-based",
    "mc-nested train --backend live": "--episodes 1",
    "mc-nested train --backend virtual": "--trials 1 --episodes 1",
    "mc-nested train --preset model-based --trials": "--trials 1",
    "mc-nested train --scenario zigzag --trials 90": "--trials 2 --episodes 2",
    "mc-nested train --preset tuned --trials": "--trials 1 --episodes 20",
    "mc-nested train --scenario line --preset image": "--trials 1 --episodes 30",
    "mc-nested train --preset image --states screen --backend virtual": "--trials 1 --episodes 2",
    "mc-nested train --scenario flag --preset tuned": "--trials 1 --episodes 20",
    "mc-nested train --trials 10": "--trials 1 --episodes 30",
    "mc-nested train --scenario line --trials 10": "--episodes 1000",
    "mc-nested train --from line-agent": "--episodes 60",
    "mc-nested train --scenario line --builders 2": "--trials 1 --episodes 20",
    "mc-nested train --preset paper --scenario line --agent nested --trials 10": "--trials 1 --episodes 30",
    "python scripts/examples/nested_dqn.py": "--trials 1 --episodes 60",
    "python scripts/examples/sb3_dqn.py": "--steps 100",
    "python scripts/examples/cleanrl_dqn.py": "--steps 300",
    "python scripts/bench.py any-design": "--designs 1 --seed 1",
    "python scripts/bench.py calibration": "--clients 1 --actions 2",
    "python scripts/bench.py costs": "--trials 1 --episodes 30 --rounds 1",
    "python scripts/bench.py calibration --every-version": "--version 26.3 --actions 2",
    "python scripts/bench.py game-time": "--seeds 1 --scenarios line",
    "python scripts/bench.py learning": "--runs 1 --rounds 1 --slice-s 0.2",
    "python scripts/bench.py live": "--actions 200 --frames 20 --tesseract 0 --builds 1",
    "python scripts/bench.py reader": "--frames 20 --tesseract 0",
    "python scripts/bench.py rehearsal": "--actions 4 --only '60 fps' --json",
    "python scripts/bench.py teach": "--seeds 2",
    "python scripts/draw.py film": "film.gif --scenario line",
    "python scripts/draw.py overlap": "/dev/null",
    "python scripts/draw.py view": ". --seconds 15",
}
"""The smallest sizes, which are appended to a slow command that begins so. The longest beginning that fits counts."""

AS_THEY_ARE = ("mc-nested study benchmark --corpus",)
"""Commands that begin like a long one, and are short."""

BY_THE_SUITE = {
    "dask scheduler": "tests/workers/cluster, which start one, with keys and without",
    "dask worker": "tests/workers/cluster",
    "uv ": "tests/test_installers.py",
    "pipx ": "tests/test_installers.py",
    "pytest tests/test_installers.py": "tests/test_installers.py",
    "mc-nested replay 2-actions.mcap": "tests/cli/test_try_it.py",
    "mc-nested train --from-recording": "tests/cli/test_train.py",
    "mc-nested reproduce --cluster": "tests/cli/test_cluster.py",
    "mc-nested train serve": "tests/cli/test_games_training.py",
    "mc-nested study sweep --cluster": "tests/cli/test_cluster.py",
    **dict.fromkeys(
        (
            "mc-nested train --backend live --preset model-based --scenario diamond --stop-at-optimum --games",
            "mc-nested train --backend virtual --preset model-based --stop-at-optimum --games",
        ),
        "tests/cli/test_games_training.py",
    ),
    "mc-nested train --preset any-design --seed": "tests/learn/test_objective_training.py",
    "mc-nested train --preset without-hindsight.toml": "tests/learn/test_objective_training.py",
    "python scripts/bench.py any-design --main": "tests/scripts/benches/test_any_design.py",
    "python scripts/bench.py any-design --run": "tests/scripts/benches/test_any_design.py",
    "python scripts/test.py": "it runs this test",
    "mc-nested train --preset model-based --scenario square": "tests/cli/test_train_large_designs.py",
}
"""Commands that take minutes, and the test with which the suite covers each instead."""

IN_A_WINDOW = tuple(f"python scripts/{words}" for words in ("bench.py rehearsal", "draw.py film", "draw.py view"))
"""Programs that open a rehearsal window on a display of their own."""

MEASURES = "python scripts/bench.py"
"""A program whose exit code 1 may say no more than that a target was missed, as in so few actions on a busy machine.
What was wrong is in its figures, which are JSON."""

CALIBRATE = "mc-nested calibrate all --yes"

NEEDS = {
    "docs/how-to/build-anything.md": (CALIBRATE,),
    "docs/how-to/own-design.md": (CALIBRATE,),
    "docs/how-to/own-learner.md": (CALIBRATE,),
    "docs/how-to/recordings.md": (CALIBRATE,),
    "docs/how-to/train-live.md": (CALIBRATE,),
    "docs/how-to/what-is-wrong.md": (CALIBRATE,),
}
"""What a reader of a page has done before."""

FILES: dict[str, Callable[[], bytes]] = {
    "hut.schem": lambda: written.sponge(written.HUT),
    "plan.png": lambda: written.picture(written.HUT[0]),
}
"""Files that a reader has, as their own programs write them."""

BEFORE = {
    "mc-nested build house --agent --backend live": (CALIBRATE,),
    "mc-nested calibrate arena": (CALIBRATE, "mc-nested calibrate arena --undo"),
    "mc-nested train --from line-agent": (
        "mc-nested train --episodes 60 --out runs/line",
        "mc-nested runs export runs/line --out line-agent",
    ),
    **dict.fromkeys(
        ("mc-nested train --resume runs/two", "mc-nested runs evaluate runs/two"),
        ("mc-nested train --builders 2 --episodes 20 --out runs/two",),
    ),
}
"""What must be done before a command that stands in a text."""

_OF_NO_MATTER = re.compile(r"--(?:trials|episodes|designs|seed) \d+|--out|runs/\w+")

STANDS_FOR = {"--scenario …": "--scenario line"}
"""What a reader puts in place of an ellipsis."""

LIVE = ("calibrate", "doctor", "read", "recordings", "replay", "try-it")
"""Verbs that look at the game's window, or at what was written there."""

LIVE_SNIPPET = 'backend="live"'
"""Words by which a program is known that plays in the game's window."""


def as_run(command: str) -> str:
    """Return the command with its smallest sizes, where it takes long, and its ellipsis filled in."""
    for ellipsis, meant in STANDS_FOR.items():
        command = command.replace(ellipsis, meant)
    if command.startswith(AS_THEY_ARE) or "--resume" in command:
        return command
    begins = max((begin for begin in SIZES if command.startswith(begin)), key=len, default="")
    return f"{command} {SIZES[begins]}" if begins else command


def what_it_does(command: str) -> frozenset[str]:
    """Return a command's words without its sizes, seed and run folder: two commands with the same words do the same."""
    return frozenset(_OF_NO_MATTER.sub("", as_run(command)).split())


def is_live(command: str) -> bool:
    """Return whether it plays in, or looks at, the game's window."""
    words = shlex.split(command)
    return "--backend live" in command or (words[0] == "mc-nested" and words[1] in LIVE)
