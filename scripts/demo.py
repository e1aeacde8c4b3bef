"""README's first command: train the nested agent on the line in the simulator, and look at what it builds.

Usage: python scripts/demo.py
"""

import sys
from datetime import datetime
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from scripts import environment


def main() -> int:
    """Install, train until a greedy evaluation is at the optimum, and show what was built; returns the exit code."""
    python = environment.main_python()
    run = environment.ROOT / "runs" / f"demo-{datetime.now():%Y%m%d-%H%M%S}"
    mc_nested: list[str | Path] = [python, "-m", "mc_nested.cli"]
    print("\nTraining the nested agent on the line, until a greedy episode builds all of it:\n", flush=True)
    trained = environment.run(
        [*mc_nested, "train", "--scenario", "line", "--episodes", "1000", "--stop-at-optimum", "--out", run]
    )
    if trained:
        return trained
    print("\nWhat the trained agent builds:\n", flush=True)
    return environment.run([*mc_nested, "play", run])


if __name__ == "__main__":
    sys.exit(main())
