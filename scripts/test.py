"""README's second command: every check that a commit must pass, in the project's own environment.

Usage: python scripts/test.py
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from scripts import environment

CHECKS = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["mypy"],
    "import contracts": ["lint-imports"],
    "tests": ["pytest"],
}


def main() -> int:
    """Run every check, whatever the others say; 1 where one failed."""
    python = environment.main_python(extras=["dev"])
    outcome = {}
    for name, command in CHECKS.items():
        print(f"\n== {name}: {' '.join(command)}", flush=True)
        began = time.monotonic()
        code = environment.run([python.parent / command[0], *command[1:]])
        outcome[name] = code, time.monotonic() - began
    print()
    for name, (code, seconds) in outcome.items():
        print(f"{'failed' if code else 'passed'}  {name} ({seconds:.0f} s)")
    return 1 if any(code for code, _ in outcome.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
