"""Plays random actions in a rehearsal window, each checked against what its client says, and prints the figures.

    python scripts/benches/rehearsal_play.py PROFILE TRUTH [--actions 100] [--seed 0]

A process of its own for rehearsal.py: a program keeps to the display that it was started on.
"""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import numpy as np
from rich.console import Console
from rich.progress import track

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.opening import Opening
from mc_nested.live.profile.store import load_profile
from mc_nested.live.session import open_live_game
from scripts.benches.played import figures_of, play_in
from scripts.rehearsal_window import RehearsalTruth


def main() -> int:
    """Play, and print one JSON object; 1 if anything was wrong."""
    parser = argparse.ArgumentParser(description="Random actions in a rehearsal window, each checked.")
    parser.add_argument("profile")
    parser.add_argument("truth", type=Path)
    parser.add_argument("--actions", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    scenario = load_scenario("diamond")
    arena = load_profile(options.profile).marked_arena()
    truth = RehearsalTruth(options.truth, arena)
    with open_live_game(scenario, Opening(options.profile, lambda line: print(line, file=sys.stderr))) as (game, _):
        steps = track(range(options.actions), "actions", console=Console(stderr=True))
        played = play_in(game, truth, scenario, steps, np.random.default_rng(options.seed))
    print(json.dumps(figures_of(played)))
    return 1 if played.wrong_cells or played.wrong_blocks else 0


if __name__ == "__main__":
    sys.exit(main())
