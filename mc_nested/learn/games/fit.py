"""Which presets and scenarios games can play by themselves."""

from mc_nested.arena.scenario import Scenario
from mc_nested.errors import PresetError
from mc_nested.learn.preset import Preset


def check_games(scenario: Scenario, preset: Preset) -> None:
    """PresetError, one line, if games can't play that preset's episodes of that scenario by themselves."""
    if preset.excursions:  # each step of one depends on what the learner remembers of the best
        raise PresetError(
            "[excursions] need the learner at every step: with several games take the preset live or paper"
        )
    if scenario.parts:  # the main agent chooses within an episode
        raise PresetError(f"{scenario.name} has parts, which several games can't learn together: train with one game")
