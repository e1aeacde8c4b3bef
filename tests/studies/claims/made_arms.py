"""Made-up arms in which every score is known."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond import with_materials
from mc_nested.studies.claims.arm_results import ArmResults, Arms
from mc_nested.studies.outcome import Evaluated, RunOutcome
from mc_nested.studies.trial import Trial

LINE = load_scenario("line")
PAPER = load_preset("paper").model_copy(update={"episodes": 360})

OPTIMUM = 21.0


def trial_of(scores: Sequence[float], steps_each: int = 100) -> list[Evaluated]:
    """Return a trial that was evaluated every 30 episodes, at the same cost between evaluations."""
    return [
        Evaluated(
            episode=30 * number,
            score=score,
            material="stone",
            steps=20,
            trained_steps=steps_each * number,
            updates=90 * number,
        )
        for number, score in enumerate(scores, 1)
    ]


def arm(
    topic: str,
    name: str,
    trials: Sequence[Sequence[Evaluated]],
    scenario: str = "line",
    materials: int = 2,
    networks: int = 2,
    stops: bool = False,
    team: tuple[int | None, Networks] = (None, "shared"),
) -> ArmResults:
    """Return the results of an arm on a design of that name, whose optimum is 21."""
    design = replace(with_materials(LINE, materials), name=scenario)
    made = Arm(
        f"{topic}: {name}",
        PAPER,
        [design],
        len(trials),
        labels={"topic": topic, "agent": name},
        stop_at_optimum=stops,
        builders=team[0],
        networks=team[1],
    )
    return ArmResults(
        [
            Trial(
                made,
                design,
                number,
                RunOutcome(
                    evaluations=list(rows),
                    score=rows[-1].score,
                    updates=rows[-1].updates or 0,
                    env_steps=rows[-1].trained_steps or 0,
                    replay_bytes=1_000_000,
                ),
                networks,
                1000 * networks,
                2.5 / len(trials),
            )
            for number, rows in enumerate(trials)
        ]
    )


def around(mean: float, trials: int = 10, spread: float = 0.5) -> list[list[Evaluated]]:
    """Return trials of twelve evaluations, half of them ``spread`` above the mean and half below."""
    signs = [1 if trial % 2 else -1 for trial in range(trials)]
    return [trial_of([mean + sign * spread] * 12) for sign in signs]


def many_main_actions(
    topic: str, counts: Sequence[int], means: Callable[[str, str, int], float] = lambda *_: 15.0, trials: int = 10
) -> Arms:
    """Return the three agents' arms with so many main actions each."""
    arms = []
    for count in counts:
        networks = {"nested": 2, "hierarchical": 1 + count, "single": 1}
        arms += [
            arm(topic, name, around(means(topic, name, count), trials), f"line, {count} {topic}", count, networks[name])
            for name in networks
        ]
    return {each.key: each for each in arms}


def whole(means: Callable[[str, str, int], float] = lambda *_: 15.0, trials: int = 10, image_trials: int = 3) -> Arms:
    """Return every arm that a run of --beyond has.

    ``means`` has the mean of a topic's agent with so many materials or builders.
    """
    arms = []
    for design in ("line", "zigzag", "diamond"):
        own = trials if design == "line" else image_trials
        arms += [
            arm("images", name, around(means("images", name, 0), own), design, stops=True)
            for name in ("images", "numbers")
        ]
    arms.append(arm("parts", "nested, tuned", around(means("parts", "tuned", 0), trials), "flag", stops=True))
    arms += [
        arm("parts", name, around(means("parts", name, 0), trials), "flag")
        for name in ("nested", "hierarchical", "single")
    ]
    arms += many_main_actions("materials", (2, 4, 8), means, trials).values()
    alone = around(means("cooperation", "alone", 1), trials)
    arms.append(arm("cooperation", "1 builder", alone, team=(1, "shared")))
    for count in (2, 3, 4):
        for kind in NETWORKS:
            scores = around(means("cooperation", kind, count), trials)
            arms.append(arm("cooperation", f"{count} builders, {kind}", scores, team=(count, kind)))
    return {each.key: each for each in arms}
