"""Made-up trials whose every score is known, as the reports of studies take them."""

from collections.abc import Sequence
from dataclasses import replace

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.outcome import Evaluated, RunOutcome
from mc_nested.studies.trial import Trial

LINE = load_scenario("line")
ZIGZAG = replace(LINE, name="zig|zag")
"""Two designs whose optimum is 21; a bar in a name is no bar of a table."""

PAPER = load_preset("paper").model_copy(update={"episodes": 90})


def made_arm(name: str, scenarios: Sequence[Scenario] = (LINE, ZIGZAG), trials: int = 3, **changed: object) -> Arm:
    arm = Arm(name, PAPER, scenarios, trials)
    return replace(arm, **changed)  # type: ignore[arg-type]


def made_trial(
    arm: Arm,
    scenario: Scenario,
    number: int,
    scores: Sequence[tuple[int, float]],
    *,
    updates: int = 1000,
    seconds: float = 1.0,
) -> Trial:
    """Return a trial with those greedy scores, each after so many training episodes; it keeps the last policy."""
    rows = [Evaluated(episode=after, score=score, material="stone", steps=13) for after, score in scores]
    outcome = RunOutcome(evaluations=rows, score=scores[-1][1], updates=updates, env_steps=900)
    return Trial(arm, scenario, number, outcome, networks=2, parameters=3000, seconds=seconds)


def made_config(study: str, trials: Sequence[Trial], seed: int = 0, **notes: str) -> StudyConfig:
    """Return the config of a study of their arms."""
    arms = list({trial.arm.name: trial.arm for trial in trials}.values())
    return config_of(study, arms, trials=arms[0].trials, seed=seed, jobs=1, notes=notes)
