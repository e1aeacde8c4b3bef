"""Programs that a test puts on the PATH, in the place of npm, node and apt-get."""

import sys
from pathlib import Path


def write_program(folder: Path, name: str, code: str = "") -> None:
    path = folder / name
    path.write_text(f"#!{sys.executable}\nimport os, shutil, sys\n{code}\n")
    path.chmod(0o755)


def silent(_line: str) -> None:
    """Say nothing: progress that nobody reads."""
