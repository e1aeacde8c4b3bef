"""README's second command: every check that a commit must pass, in the project's own environment.

Usage: python scripts/test.py
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from scripts import environment

EXTRAS = ["dev", "bench"]
"""What is installed beside the project: bench brings stable-baselines3, which an example and the benchmark train."""

REAL = "standin or realtime or window or wine"
"""The markers of the tests that play in real time: never two of them at once."""

OTHERS = f"slow or {REAL}"
"""The markers of the tests that the unit suite leaves out."""

KERNELS = [
    "tests/learn/dqn/compiled_engine/test_adam.py",
    "tests/learn/dqn/compiled_engine/test_cell_networks.py",
    "tests/learn/dqn/compiled_engine/test_products.py",
    "tests/learn/imagination/test_arena_step.py",
    "tests/learn/imagination/test_built_values.py",
    "tests/learn/imagination/test_imagined_task.py",
    "tests/learn/imagination/test_practice_kernel.py",
    "tests/learn/imagination/test_table_learner.py",
    "tests/sim/test_grid.py",
]
"""Tests of compiled code that is quick enough in plain Python, where an index out of bounds is an error."""

CHECKS = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["mypy"],
    "import contracts": ["lint-imports"],
    "documentation": ["mkdocs", "build", "--strict"],
    "compiled code in plain Python": ["pytest", *KERNELS, "--cov", "--cov-report=", "--cov-fail-under=0"],
    "unit tests": ["pytest", "-n", "2", "-m", f"not ({OTHERS})", "--cov", "--cov-append", "--cov-report="],
    "branch coverage": ["coverage", "report", "--skip-covered"],
    "slow tests": ["pytest", "-n", "2", "-m", f"slow and not ({REAL})"],
    "real-time tests": ["pytest", "-m", REAL],
}


VARIABLES = {
    "compiled code in plain Python": {"NUMBA_DISABLE_JIT": "1"},
    "documentation": {"NO_MKDOCS_2_WARNING": "1"},  # it says that mkdocs-material ends in 2027
}
"""Environment variables of a check."""


def main() -> int:
    """Run every check, even after one failed; 1 where any failed."""
    python = environment.main_python(EXTRAS)
    outcome = {}
    for name, command in CHECKS.items():
        print(f"\n== {name}: {' '.join(command)}", flush=True)
        began = time.monotonic()
        code = environment.run([python.parent / command[0], *command[1:]], VARIABLES.get(name))
        outcome[name] = code, time.monotonic() - began
    print()
    for name, (code, seconds) in outcome.items():
        print(f"{'failed' if code else 'passed'}  {name} ({seconds:.0f} s)")
    return 1 if any(code for code, _ in outcome.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
