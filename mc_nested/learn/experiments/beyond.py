"""What the paper says it could do and didn't try, as runs: images, several main actions, many of them, cooperation."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from mc_nested.arena.cooperative.team import MOST_BUILDERS
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import ScenarioTable, load_scenario, paper_scenarios, scenario_of, table_of
from mc_nested.learn.agents import AGENT_SPECS, AgentName
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.learn.experiments.experiment_folder import ExperimentConfig
from mc_nested.learn.experiments.jobs import Builders, Job
from mc_nested.learn.preset import Preset, load_preset

Topic = Literal["images", "parts", "materials", "cooperation"]

FEW = 3
"""Trials of images on the zigzag and the diamond, which take long."""

TEAM_EPISODES = 1500
"""Training episodes of a team."""

COUNTS = (2, 4, 8)
"""Numbers of main actions that are compared."""

TOGETHER = 5
"""Trials that train as one job: the same however many processes there are, so that seconds can be compared."""

NAMES = ("wood", "dirt", "clay", "glass", "sandstone", "cobblestone", "bricks", "stone")
BLOCKS = ("oak_planks", "dirt", "clay", "glass", "sandstone", "cobblestone", "bricks", "stone")
"""The most materials of the family; wood and stone are the paper's."""


TEAMS: list[tuple[int, Networks]] = [
    (1, "shared"),
    *((count, kind) for count in range(2, MOST_BUILDERS + 1) for kind in NETWORKS),
]
"""Numbers of builders, and how they learn."""

TUNED = "nested, tuned"
"""The nested agent with settings that solve the flag."""


def team_name(builders: int, networks: Networks) -> str:
    """The name of a team's arm."""
    return "1 builder" if builders == 1 else f"{builders} builders, {networks}"


COMPARED: Mapping[Topic, Sequence[str]] = {
    "images": ("images", "numbers"),
    "parts": (TUNED, *AGENT_SPECS),
    "materials": tuple(AGENT_SPECS),
    "cooperation": [team_name(*team) for team in TEAMS],
}
"""The arms on each design of a topic, by name."""


class Arm(BaseModel):
    """Trainings that are the same but for their trial; complete, no other file is needed.

    ``builders`` share an arena, and learn as ``networks`` says; otherwise ``agent`` builds alone. With
    ``stop_at_optimum`` a trial ends at its first greedy episode at the optimum.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    topic: Topic
    name: str
    agent: AgentName = "nested"
    builders: Annotated[int, Field(ge=1, le=MOST_BUILDERS)] | None = None
    networks: Networks = "shared"
    preset_name: str
    preset: Preset
    scenario: ScenarioTable
    trials: Annotated[int, Field(ge=1)]
    stop_at_optimum: bool = False

    @model_validator(mode="after")
    def _check_end(self) -> "Arm":
        if self.builders and self.stop_at_optimum:
            raise ValueError("builders in one arena train for all their episodes: leave out stop_at_optimum")
        return self

    @property
    def team(self) -> Builders | None:
        """Who shares an arena; None where an agent builds alone."""
        return Builders(self.builders, self.networks) if self.builders else None

    @property
    def group(self) -> str:
        """What its runs count for."""
        return f"{self.topic}: {self.name}"

    def loaded_scenario(self) -> Scenario:
        """Its scenario; ScenarioError if it can't be built."""
        return scenario_of(self.scenario, self.scenario.name)


def _turn(arm: Arm) -> tuple[bool, bool, int, int]:
    """The slowest arms come first."""
    return (
        arm.preset.states == "numbers",
        not (arm.builders or arm.stop_at_optimum),
        -arm.preset.episodes,
        -(arm.builders or 1),
    )


def _check_arms(arms: list[Arm]) -> list[Arm]:
    """ValueError unless each topic's designs have all that are compared on them, each once."""
    for topic, names in COMPARED.items():
        own = [arm for arm in arms if arm.topic == topic]
        designs = {arm.scenario.name for arm in own}
        found = sorted((arm.scenario.name, arm.name) for arm in own)
        if not designs or found != sorted((design, name) for design in designs for name in names):
            raise ValueError(f"topic {topic} needs {', '.join(names)} on each of its designs, each once")
    return arms


class BeyondConfig(ExperimentConfig):
    """Every arm that the report compares, in its order."""

    arms: Annotated[list[Arm], AfterValidator(_check_arms)]

    def cut(self) -> list[Job]:
        """Every arm in jobs of a few trials; images first, which take longest."""
        arms = sorted(self.arms, key=_turn)
        jobs = [job for arm in arms for job in self._jobs_of(arm)]
        return [replace(job, name=f"{number:03d}") for number, job in enumerate(jobs)]

    def _jobs_of(self, arm: Arm) -> list[Job]:
        scenario = arm.loaded_scenario()
        together = [range(first, min(first + TOGETHER, arm.trials)) for first in range(0, arm.trials, TOGETHER)]
        return [
            Job(
                name="",
                spec=AGENT_SPECS[arm.agent],
                preset=arm.preset,
                groups=(arm.group,) * len(trials),
                scenarios=(scenario,) * len(trials),
                trials=tuple(trials),
                seed=self.seed,
                stop_at_optimum=arm.stop_at_optimum,
                builders=arm.team,
            )
            for trials in together
        ]


def with_materials(scenario: Scenario, count: int) -> Scenario:
    """The scenario with so many materials, 2 to 8, whose p are evenly spaced between its own lowest and highest.

    The worst comes first and the best last, as in the paper's: its optimum is the same, whatever their number.
    """
    worths = [material.p for material in scenario.materials]
    low, high = min(worths), max(worths)
    chosen = [number * (len(NAMES) - 1) // (count - 1) for number in range(count)]
    materials = tuple(
        Material(NAMES[index], low + (high - low) * number / (count - 1), BLOCKS[index])
        for number, index in enumerate(chosen)
    )
    return replace(scenario, name=f"{scenario.name}, {count} materials", materials=materials)


def shipped_arms(trials: int, few: int = FEW, most_episodes: int | None = None, device: str | None = None) -> list[Arm]:
    """All arms, of so many trials each, and of images on the zigzag and the diamond of ``few``.

    ``most_episodes`` cuts every training; ``device`` is what images train on. PresetError if the device isn't there.
    """
    image, tuned, paper = (load_preset(name) for name in ("image", "tuned", "paper"))
    arms = [
        *_images(image.changed(device=device), paper, trials, few),
        *_parts(paper, tuned, trials),
        *_materials(paper, trials),
        *_cooperation(paper, trials),
    ]
    return [
        arm.model_copy(update={"preset": _cut(arm.preset, min(most_episodes, arm.preset.episodes))})
        if most_episodes
        else arm
        for arm in arms
    ]


def _images(image: Preset, paper: Preset, trials: int, few: int) -> list[Arm]:
    """Images, and beside them numbered states: the preset paper, which explores as the preset image here."""
    numbers = paper.model_copy(update={"explore_main": image.explore_main, "explore_nested": image.explore_nested})
    arms = []
    for design in paper_scenarios():
        own = trials if design == "line" else few
        for name, preset_name, preset in (("images", "image", image), ("numbers", "paper", numbers)):
            arms.append(
                Arm(
                    topic="images",
                    name=name,
                    preset_name=preset_name,
                    preset=preset,
                    scenario=table_of(load_scenario(design)),
                    trials=own,
                    stop_at_optimum=True,
                )
            )
    return arms


def _parts(paper: Preset, tuned: Preset, trials: int) -> list[Arm]:
    """The paper's agents on the flag, and the nested one with settings that solve it."""
    flag = table_of(load_scenario("flag"))
    solved = Arm(
        topic="parts",
        name=TUNED,
        preset_name="tuned",
        preset=tuned,
        scenario=flag,
        trials=trials,
        stop_at_optimum=True,
    )
    return [solved, *_each_agent("parts", paper, flag, trials)]


def _materials(paper: Preset, trials: int) -> list[Arm]:
    line = load_scenario("line")
    return [
        arm
        for count in COUNTS
        for arm in _each_agent("materials", paper, table_of(with_materials(line, count)), trials)
    ]


def _each_agent(topic: Topic, paper: Preset, scenario: ScenarioTable, trials: int) -> list[Arm]:
    return [
        Arm(topic=topic, name=agent, agent=agent, preset_name="paper", preset=paper, scenario=scenario, trials=trials)
        for agent in AGENT_SPECS
    ]


def _cooperation(paper: Preset, trials: int) -> list[Arm]:
    """Builders on the line: one alone, and two to four, learning in each way."""
    line, preset = table_of(load_scenario("line")), _cut(paper, TEAM_EPISODES)
    return [
        Arm(
            topic="cooperation",
            name=team_name(count, kind),
            builders=count,
            networks=kind,
            preset_name="paper",
            preset=preset,
            scenario=line,
            trials=trials,
        )
        for count, kind in TEAMS
    ]


def _cut(preset: Preset, episodes: int) -> Preset:
    return preset.model_copy(update={"episodes": episodes})
