"""Main actions that are objectives: regions of the arena to build in next, from its halves to its cells.

What the paper's section 6 believes of many main actions (claims/beyond.py), where each of them is of use in turn.
"""

from dataclasses import replace

from mc_nested.arena.scenario import Material, Part, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond import arm_of, report
from mc_nested.studies.study import Study, StudyOptions, with_episodes

COUNTS = (2, 4, 16, 64, 225)
"""Numbers of regions: two halves, four quarters, 4 x 4, 8 x 8, and each cell of an arena of 15 by 15."""

CHOOSE_EVERY = 12
"""Steps without a block after which the main agent chooses again."""

EPISODES = 1500


def with_objectives(scenario: Scenario, count: int) -> Scenario:
    """Return the scenario with so many regions in the place of its materials: a score is the blocks on the design."""
    return replace(
        scenario,
        name=f"{scenario.name}, {count} objectives",
        materials=tuple(Material(f"region {number}", 0.0, "stone") for number in range(1, count + 1)),
        parts=(Part(scenario.design, (0.0,) * count),),
        choose_every=CHOOSE_EVERY,
        regions=True,
    )


def arms(options: StudyOptions) -> list[Arm]:
    """Return the three agents with each number of objectives, on the diamond.

    Its blocks lie in every half and quarter, and in 6 fields of 16: where to build matters, and 16 blocks are enough
    for chance to find some. Of the six of the islands next to none were found among 16 regions.
    """
    paper = load_preset("paper").model_copy(update={"encoding": "one-hot"})
    preset, diamond = with_episodes(paper, options.episodes), load_scenario("diamond")
    return [
        arm_of("objectives", agent, preset, [with_objectives(diamond, count)], options.trials, agent=agent)
        for count in COUNTS
        for agent in AGENT_SPECS
    ]


STUDY = Study(
    name="objectives",
    what="Compare the three agents where the main agent chooses among 2 to 225 regions to build in. The defaults take "
    "about a quarter of an hour on two cores.",
    options={"trials": 10, "episodes": EPISODES, "seed": 0},
    arms=arms,
    report=report,
    files={"report": "objectives.md", "plot": "objectives.png", "rows": "objectives.csv"},
)
