"""README's first command: installs the project in .venv, and runs ``mc-nested demo`` there.

Usage: python scripts/demo.py
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from scripts import environment


def main() -> int:
    """Install the project, and run its demo; returns the exit code."""
    return environment.run([environment.main_python(), "-m", "mc_nested.cli", "demo"])


if __name__ == "__main__":
    sys.exit(main())
