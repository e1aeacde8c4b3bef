"""This computer plays a training's episodes: in the simulator, on the virtual client, or in its running game."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.game import PlayLog
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.options import played_live
from mc_nested.errors import DesktopError, LiveError, NotInFrontError
from mc_nested.learn.objective_training import ObjectivesTraining
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from mc_nested.live.action_log import FailureBudget
from mc_nested.live.session import Opening
from mc_nested.view.publisher import Publisher
from sim.grid import GridVectorEnv
from sim.team_grid import team_arenas
from sim.worlds import Backend, as_shown, open_arenas


@dataclass(frozen=True)
class OwnPlayer:
    """A trainer and its arenas here; ``log`` says what playing took, None of the simulator."""

    training: Trainer | ObjectivesTraining
    arenas: GridVectorEnv | ArenaVectorEnv | TeamVectorEnv
    log: PlayLog | None
    was_paused_lately: Callable[[], bool]
    failures: FailureBudget = field(default_factory=FailureBudget)

    def play_on(self) -> list[str]:
        """Play one tick, and return the practice's news. A mishap in a running game costs its episode, and is counted.

        A person in another window who pauses, or did so shortly before, is not counted as a mishap.
        """
        try:
            self.training.tick()
        except DesktopError:
            self.training.abandon_episodes()
            raise
        except LiveError as error:
            self.training.abandon_episodes()
            if not (isinstance(error, NotInFrontError) and self.was_paused_lately()):
                self.failures.record_failure(error, self.training.env_steps)
        return self.training.practice.news()

    def end(self) -> None:
        """Do nothing: what is under way is saved half-way, or starts over."""

    def in_words(self) -> str:
        """Return an empty text: this computer alone plays."""
        return ""

    def summary(self) -> dict[str, Any]:
        """Return what playing in a running game, or on the virtual client, took; nothing for the simulator."""
        return played_live(self.log, self.failures)


@contextmanager
def own_player(folder: RunFolder, opening: Opening, publisher: Publisher) -> Iterator[OwnPlayer]:
    """Yield an untrained trainer for that folder's training, in arenas that are open for the block.

    Errors as ``open_arenas`` raises them.
    """
    config = folder.config
    with open_arenas(Backend(config.backend), folder.scenarios, opening, config.seed) as (opened, log):
        env = team_arenas(folder.team, config.trials) if folder.team else opened
        agent = folder.new_agent(config.trials, config.preset.device)
        shown = env if isinstance(env, TeamVectorEnv) else as_shown(env, config.preset.states)
        view = agent.view_of(shown, folder.scenarios)
        asked = folder.scenarios, agent, config.preset, config.seed, config.stop_at_optimum
        trainer = ObjectivesTraining(*asked) if config.trains_objectives else Trainer(view, *asked)
        yield OwnPlayer(trainer, env, log, lambda: publisher.was_paused_lately)
