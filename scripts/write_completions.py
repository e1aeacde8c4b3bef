"""Write the list of all verbs and options that shells complete from: mc_nested/cli/completion/verbs.json.

Usage: python scripts/write_completions.py
"""

import sys
from pathlib import Path

import typer

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from mc_nested.arena.scenario_file import shipped_scenarios
from mc_nested.cli.app import app_for
from mc_nested.cli.completion import verbs
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import shipped_presets
from mc_nested.studies.arm import AGENTS


def written() -> str:
    """The text of the file, of the command as it is now."""
    names = {
        "scenario": shipped_scenarios(),
        "names": shipped_scenarios(),
        "preset": shipped_presets(),
        "presets": shipped_presets(),
        "agent": list(AGENT_SPECS),
        "agents": list(AGENTS),
    }
    return verbs.text_of(verbs.verb_of(typer.main.get_command(app_for([])), names))


if __name__ == "__main__":
    file = Path(verbs.__file__).with_name(verbs.FILE)
    file.write_text(written(), encoding="utf-8", newline="\n")
    print(f"written: {file}")
