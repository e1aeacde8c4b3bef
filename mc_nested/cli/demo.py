"""``mc-nested demo``: the main job in one command."""

from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.cli.options import DEFAULT_PROFILE, opening_of
from mc_nested.cli.output import Output
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.play import play
from mc_nested.cli.training_loop import HowToRun, run_training
from mc_nested.learn.preset import load_preset
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.runs.run_folder import RunFolder

MOST_EPISODES = 1000
"""The training ends far earlier: at its first greedy episode that builds all."""


def demo() -> None:
    """Train the nested agent on the line until it builds all of it, and show that: the first thing to try."""
    output = Output()
    config = RunConfig(
        agent="nested",
        backend="sim",
        trials=1,
        seed=0,
        stop_at_optimum=True,
        preset_name="paper",
        preset=load_preset("paper").model_copy(update={"episodes": MOST_EPISODES}),
        scenario=table_of(load_scenario("line")),
    )
    with output_folder(None, "demo") as path:
        output.note("Training the nested agent on the line, until a greedy episode builds all of it:\n")
        run_training(RunFolder.new(path, config), False, HowToRun(output, opening_of(DEFAULT_PROFILE, "demo", None)))
    output.note("\nWhat the trained agent builds:\n")
    play(path)
