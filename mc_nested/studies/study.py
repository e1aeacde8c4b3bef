"""What a study is: its options, the arms that they mean, and the report of what came of them.

A new one is a file that declares a Study: the smallest is in tests/studies/test_study.py, with what runs it. SHIPPED
names those that ``mc-nested study`` knows.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from mc_nested.arena.scenario import Scenario
from mc_nested.atomic_file import atomic_write
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.table import Table
from mc_nested.studies.trial import Trial

SHIPPED = ("reproduce", "robustness", "beyond", "objectives", "sweep", "ablation", "benchmark")
"""The studies by name: each is declared in the module of that name, as STUDY."""


@dataclass(frozen=True)
class StudyOptions:
    """What a study was asked for: the values of the options that it takes, and of the others what they are here.

    Args:
        trials: of each arm on each design.
        seed: of all random numbers.
        episodes: of a trial; None for the preset's.
        scenarios: the designs.
        preset: a shipped preset's name, or a file.
        agent: the agents that were named; none for all.
        engine: what computes; None for what the preset says.
        device: where it computes; likewise.
        longer: how many times as long some agents are also trained, 0 for not.
        designs: how many designs are drawn.
        corpus: a file of designs to take instead.
        agents: those that are compared; none for the default ones.
        presets: those of each agent.
        given: the options that were named, not left at their defaults.
        say: tells a person something, in a line.
    """

    trials: int
    seed: int = 0
    episodes: int | None = None
    scenarios: Sequence[Scenario] = ()
    preset: str = "paper"
    agent: Sequence[str] = ()
    engine: str | None = None
    device: str | None = None
    longer: int = 0
    designs: int = 0
    corpus: Path | None = None
    agents: Sequence[str] = ()
    presets: Sequence[str] = ()
    given: frozenset[str] = frozenset()
    say: Callable[[str], None] = print

    def loaded_preset(self) -> Preset:
        """Return the preset with the episodes, the engine and the device asked for; PresetError if it is none."""
        loaded = load_preset(self.preset).changed(engine=self.engine, device=self.device)
        return with_episodes(loaded, self.episodes)


@dataclass(frozen=True)
class Report:
    """What a study has found.

    Args:
        text: its paragraphs, tables and headings, as Markdown.
        figure: its figure.
        tables: its CSV files by name.
        found: what a program may want to know, by name.
        shown: what a person sees at once.
    """

    text: Sequence[str]
    figure: Figure
    tables: Mapping[str, Table]
    found: Mapping[str, Any] = field(default_factory=dict)
    shown: Table | None = None


@dataclass(frozen=True)
class Study:
    """A study.

    Args:
        name: the word after ``mc-nested study``.
        what: what it does, for its help.
        options: the options that it takes, each with its default.
        arms: what is trained; UserError if it can't be what was asked for.
        report: what came of it.
        files: its files by what they are, the first is the one to open.
        further_files: the figure in other formats.
        notes: what its report says beside, of what was asked for.
        folder: what its folder's name begins with.
    """

    name: str
    what: str
    options: Mapping[str, Any]
    arms: Callable[[StudyOptions], Sequence[Arm]]
    report: Callable[[StudyConfig, Sequence[Trial]], Report]
    files: Mapping[str, str]
    further_files: Sequence[str] = ()
    notes: Callable[[StudyOptions], dict[str, str]] = lambda _: {}
    folder: str = ""


def write_report(folder: Path, study: Study, report: Report) -> None:
    """Write the study's files, each atomically, the same for the same results; OSError if the disk refuses."""
    for name, table in report.tables.items():
        table.write(folder / name)
    for name in (*study.files.values(), *study.further_files):
        kind = Path(name).suffix
        if kind in METADATA:
            with matplotlib.rc_context({"svg.hashsalt": Path(name).stem}), atomic_write(folder / name) as unfinished:
                report.figure.savefig(unfinished, format=kind[1:], dpi="figure", metadata=METADATA[kind])
        elif kind == ".md":
            with atomic_write(folder / name) as unfinished:
                unfinished.write_text("\n\n".join(report.text) + "\n", encoding="utf-8", newline="\n")


METADATA: Mapping[str, dict[str, None]] = {".png": {"Software": None}, ".svg": {"Date": None}}
"""What a figure's file doesn't say, so that it is the same whenever it is written."""


def with_episodes(preset: Preset, episodes: int | None) -> Preset:
    """Return the preset with so many episodes; as it is where that is None."""
    return preset if episodes is None else preset.model_copy(update={"episodes": episodes})
