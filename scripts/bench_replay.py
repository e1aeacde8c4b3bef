"""Measures whether what is recorded replays alike: random actions on the virtual client, recorded, then replayed.

    python scripts/bench_replay.py [--actions 10000] [--seed 0] [--json]

Exit code 1 if a reading or a decision differs, or an action was not followed to its end.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

from rich.console import Console

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.live.recording.overview import overview_of
from mc_nested.live.recording.replay import replay
from scripts.recorded_play import FONT, record_play


def main() -> int:
    """Record, replay and print the figures."""
    parser = argparse.ArgumentParser(description="Whether what is recorded replays alike.")
    parser.add_argument("--actions", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="mc-nested-replay-") as temporary:
        folder = Path(temporary) / "recording"
        began = time.monotonic()
        failed = record_play(folder, options.actions, seed=options.seed)
        recorded = time.monotonic()
        seen = replay(folder, FONT)
        figures = {
            "actions": seen.actions,
            "followed": seen.followed,
            "failed": len(failed),
            "readings": seen.readings,
            "read_anew": seen.read_anew,
            "differences": len(seen.differences),
            "recorded_in_s": round(recorded - began, 1),
            "replayed_in_s": round(time.monotonic() - recorded, 1),
            "mb": round(overview_of(folder).size / 1e6, 1),
        }
    if options.json:
        print(json.dumps(figures))
    else:
        Console().print(figures)
    return 0 if not seen.differences and seen.followed == seen.actions - len(failed) else 1


if __name__ == "__main__":
    sys.exit(main())
