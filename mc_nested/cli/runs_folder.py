"""Where runs are written, and looked for, unless another folder is named."""

from pathlib import Path

RUNS = Path("runs")
