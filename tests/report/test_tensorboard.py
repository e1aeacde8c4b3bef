"""TensorBoard events, read back by TensorBoard itself."""

from pathlib import Path

import pytest
from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.report import tensorboard
from mc_nested.report.tensorboard import TensorBoard
from tests.learn.made_trainings import SHORT
from tests.learn.test_trainer import LINE, trainer_of


def read(folder: Path) -> EventAccumulator:
    found = EventAccumulator(str(folder))
    found.Reload()
    return found


@pytest.mark.parametrize("agent", AGENT_SPECS)
def test_every_run_has_its_scores_epsilon_loss_values_and_rate(tmp_path: Path, agent: str) -> None:
    trainer = trainer_of([LINE] * 2, SHORT.model_copy(update={"episodes": 40}), spec=AGENT_SPECS[agent])
    folders = [tmp_path / "a", tmp_path / "b"]
    board = TensorBoard(folders, trainer)
    while not trainer.finished:
        trainer.tick()
        board.write()
    for run, folder in enumerate(folders):
        found = read(folder)
        roles = ["low"] if agent == "single" else ["low", "main"]
        expected = {"score/greedy", "score/training", "epsilon/main", "epsilon/nested", "updates a second, all runs"}
        assert set(found.Tags()["scalars"]) == expected | {f"{name}/{role}" for name in ("loss", "q") for role in roles}
        rows = [row for row in trainer.evaluation_rows if row.trial == run]
        assert [(event.step, event.value) for event in found.Scalars("score/greedy")] == [
            (row.episode, row.score) for row in rows
        ]
        scores = [row.score for row in trainer.episode_rows if row.trial == run]
        means = [sum(scores[at : at + 5]) / 5 for at in range(0, 40, 5)]
        assert [event.value for event in found.Scalars("score/training")] == pytest.approx(means)
        assert all(event.value >= 0 for event in found.Scalars("loss/low"))


def test_earlier_evaluations_are_not_written_again(tmp_path: Path) -> None:
    trainer = trainer_of([LINE])
    for _ in range(2):
        board = TensorBoard([tmp_path], trainer)
        goal = len(trainer.evaluation_rows) + 2
        while len(trainer.evaluation_rows) < goal:
            trainer.tick()
        board.write()
    assert [event.step for event in read(tmp_path).Scalars("score/greedy")] == [5, 10, 15, 20]


def test_is_installed_says_whether_tensorboard_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    assert tensorboard.is_installed()
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    assert not tensorboard.is_installed()


def test_the_rate_is_the_updates_per_second_since_the_last_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = iter([100.0, 102.0, 105.0])
    monkeypatch.setattr("mc_nested.report.tensorboard.time.monotonic", lambda: next(times))
    trainer = trainer_of([LINE])
    board = TensorBoard([tmp_path], trainer)
    updates = [trainer.agent.updates]
    for _ in range(2):
        goal = len(trainer.evaluation_rows) + 1
        while len(trainer.evaluation_rows) < goal:
            trainer.tick()
        updates.append(trainer.agent.updates)
        board.write()
    rates = [event.value for event in read(tmp_path).Scalars("updates a second, all runs")]
    assert rates == pytest.approx([(updates[1] - updates[0]) / 2, (updates[2] - updates[1]) / 3])
