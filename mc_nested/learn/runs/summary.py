"""The results of a training so far, for its folder's summary.json."""

from typing import Any

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.training import Training


def summarise(config: RunConfig, scenario: Scenario, trainer: Training, wall_s: float) -> dict[str, Any]:
    """Return the results of a training so far, for summary.json; scores are r_M, one per trial, of the policy it keeps.

    An unfinished trial has no final score: it has learned since its last greedy evaluation. ``played_to_optimum``
    includes the greedy episodes: in a live game they take as long as any other.
    """
    evaluations = [[row for row in trainer.evaluation_rows if row.trial == trial] for trial in range(config.trials)]
    firsts = [next((row.episode for row in rows if row.score >= scenario.optimum), None) for rows in evaluations]
    team = config.team
    builders = {"builders": len(team.starts), "networks_kind": team.networks, "starts": team.starts} if team else {}
    return {
        "scenario": scenario.name,
        "agent": config.agent,
        "preset": config.preset_name,
        "backend": config.backend,
        **builders,
        "trials": config.trials,
        "seed": config.seed,
        "episodes": config.preset.episodes,
        "optimum": scenario.optimum,
        "final_scores": [
            float(score) if finished else None
            for score, finished in zip(trainer.policy_scores, trainer.runs_finished, strict=True)
        ],
        "episodes_to_optimum": firsts,
        "played_to_optimum": [_played_until(trainer, trial, first) for trial, first in enumerate(firsts)],
        "episodes_done": [int(done) for done in trainer.episodes_done],
        "env_steps": trainer.env_steps,
        "evaluation_steps": trainer.evaluation_steps,
        "updates": trainer.agent.updates,
        "wall_s": round(wall_s, 3),
        "networks": trainer.agent.networks,
        "parameters": trainer.agent.parameters,
    }


def _played_until(trainer: Training, trial: int, episode: int | None) -> dict[str, int] | None:
    if episode is None:
        return None
    played = [row for row in trainer.episode_rows if row.trial == trial and row.episode <= episode]
    greedy = [row for row in trainer.evaluation_rows if row.trial == trial and row.episode <= episode]
    steps = sum(row.steps for row in played) + sum(row.steps for row in greedy)
    return {"episodes": len(played) + len(greedy), "steps": steps}
