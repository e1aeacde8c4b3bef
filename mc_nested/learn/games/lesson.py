"""What the learner learns from a whole episode that a game has played."""

import numpy as np
from numpy.random import Generator

from mc_nested.arrays import Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.games.episode import PlayedEpisode
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.main_choices import ChoiceStep, MainChoices
from mc_nested.learn.preset import Preset

RUN = np.zeros(1, dtype=np.int64)
"""The one run, as rows are named."""


def materials_of(agent: Agent, played: PlayedEpisode, planned: int) -> Int64s:
    """The material that was chosen when each observation was made, (steps + 1,); -1 before there was a choice."""
    if agent.main:
        return np.full(played.steps + 1, planned)
    return agent.chosen_materials(played.observations)


def record_episode(imagination: Imagination, played: PlayedEpisode, material: int) -> None:
    """Let the run know what happened, step by step."""
    materials, observations = np.array([material]), played.observations
    imagination.begin(RUN)
    for step in range(played.steps):
        here, after = observations[step : step + 1], observations[step + 1 : step + 2]
        did, earned = played.actions[step : step + 1], played.rewards[step : step + 1]
        imagination.observe(RUN, here, materials, did, earned, after)
    imagination.end(RUN, materials, np.array([played.score]))


def learn_episode(
    agent: Agent,
    choices: MainChoices | None,
    preset: Preset,
    played: PlayedEpisode,
    materials: Int64s,
    tick: int,
    random: Generator,
) -> None:
    """Store each step and update after it, then the main agent's choice: as if the episode were played now.

    Args:
        agent: what learns, in one run.
        choices: its main agent's; None if it has none.
        preset: the hyper-parameters.
        played: the episode.
        materials: as ``materials_of`` says.
        tick: of the training, after the episode's last step.
        random: the batches' numbers come from here.
    """
    batch, terminated = preset.update.batch, np.zeros(played.steps, dtype=np.bool_)
    terminated[-1] = played.terminated
    states = agent.low_level_states(played.observations, materials)
    draws = random.random((played.steps, preset.updates_a_step, 1, batch))
    rows = agent.low_level_rows(RUN, materials[:1])
    for at in range(played.steps):
        here, after = slice(at, at + 1), slice(at + 1, at + 2)
        seen = played.actions[here], played.rewards[here], states[after], terminated[here]
        agent.low_level.store(rows, states[here], *seen)
        for update in draws[at]:
            agent.low_level.learn(rows, update)
    if choices:
        ended = np.ones(1, dtype=np.bool_)
        step = ChoiceStep(
            states=played.observations[-1:],
            earned=np.array([played.score]),
            ended=ended,
            due=~ended,
            draws=random.random((1, batch)),
            tick=tick,
        )
        choices.learn(RUN, materials[:1], step)
