"""FACTS.md: every number that names it as its source names a section that is there."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("mc_nested", "sim", "calibration", "tests")
SOURCE = re.compile(r"[(]FACTS: ([^;)\n]+)")


def test_every_section_of_facts_that_the_code_cites_exists() -> None:
    sections = set(re.findall(r"^## (.+)$", (ROOT / "mc_nested/live/FACTS.md").read_text("utf-8"), re.MULTILINE))
    files = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]
    named = {name for path in files for name in SOURCE.findall(path.read_text("utf-8"))}
    assert named
    assert named <= sections
