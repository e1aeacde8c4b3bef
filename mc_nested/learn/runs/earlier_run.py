"""What an earlier training gives to begin another with (``train --from``)."""

from dataclasses import dataclass
from pathlib import Path

from mc_nested.arrays import Arrays
from mc_nested.errors import RunError
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.training import Training


@dataclass(frozen=True)
class EarlierRun:
    """The best trial of an earlier training: its policy, and what it has learnt of its game, where its preset imagines.

    ``online`` are its networks by role. ``same_design`` and ``same_materials``: whether its game pays for the same
    cells and the same materials as the new one; what it learnt of the others doesn't count then.
    """

    online: Arrays
    game: Arrays | None
    same_design: bool
    same_materials: bool
    path: Path

    def begin(self, trainer: Training) -> None:
        """Let every run of the trainer begin from it; RunError if its learnt game doesn't fit."""
        trainer.begin_from(self.online, evaluated_first=self.game is None or self.same_design)
        if self.game is not None and trainer.practice.imagination is not None:
            try:
                trainer.practice.imagination.begin_from(self.game, pays=self.same_design, materials=self.same_materials)
            except (KeyError, ValueError, TypeError) as error:
                raise RunError(f"{self.path}: its learnt game is damaged: train it again") from error


def earlier_run(run: Path, wanted: RunFolder) -> EarlierRun:
    """Return the best trial of that training, for the wanted one; RunError if its networks don't fit."""
    folder = RunFolder.open(run)
    theirs, ours = folder.new_agent(1), wanted.new_agent(1)
    if (theirs.spec, theirs.forms, theirs.networks) != (ours.spec, ours.forms, ours.networks):
        team = folder.config.team
        who = f"--builders {len(team.starts)} --networks {team.networks}" if team else f"--agent {folder.config.agent}"
        raise RunError(
            f"{run}: its networks don't fit this training: take {who}, its preset, and a design of "
            f"{folder.scenario.blocks} blocks in an arena of {folder.scenario.size} x {folder.scenario.size}"
        )
    best = int(folder.policies()["scores"].argmax())
    return EarlierRun(
        online=folder.policy_of(best),
        game=folder.learnt_game(best),
        same_design=folder.scenario.design == wanted.scenario.design,
        same_materials=folder.scenario.materials == wanted.scenario.materials,
        path=run,
    )
