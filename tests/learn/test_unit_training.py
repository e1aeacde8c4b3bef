"""Units that train: the same however they are cut and however often they are stopped, and saved before much is lost."""

from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.unit_training import OUTCOME, RunOutcome, UnitOutcome, UnitTraining, outcome_of
from mc_nested.learn.units import Unit, cut_into_units
from sim.grid import GridVectorEnv
from tests.learn.experiments import BAR, DOT, one_unit, runs_of, small_preset


def training(unit: Unit, folder: Path) -> UnitTraining:
    return UnitTraining(unit, folder, GridVectorEnv(unit.scenarios))


def train(unit: Unit, folder: Path) -> UnitOutcome:
    own = training(unit, folder)
    while not own.trainer.finished:
        own.tick()
    own.finish()
    outcome = outcome_of(unit, folder)
    assert outcome
    return outcome


@pytest.mark.parametrize(
    ("agent", "encoding"),
    [("nested", "scaled"), ("hierarchical", "scaled"), ("single", "scaled"), ("nested", "one-hot")],
)
def test_what_comes_out_does_not_depend_on_the_cut(agent: str, encoding: str, tmp_path: Path) -> None:
    runs = runs_of([agent], [DOT, BAR], 3, small_preset().model_copy(update={"encoding": encoding}))
    found: list[dict[tuple[str, int], RunOutcome]] = []
    for parts in (1, 4):
        found.append({})
        for unit in cut_into_units(runs, parts, seed=3):
            outcome = train(unit, tmp_path / f"{parts}" / unit.name)
            keys = [(scenario.name, trial) for scenario, trial in zip(unit.scenarios, unit.trials, strict=True)]
            found[-1].update(zip(keys, outcome.runs, strict=True))
    assert found[0] == found[1]
    assert len(found[0]) == 6
    assert found[0]["bar", 0] != found[0]["bar", 1]


def test_an_outcome_says_what_was_evaluated_and_what_it_took(tmp_path: Path) -> None:
    unit = one_unit("nested", [DOT, BAR], 2)
    outcome = train(unit, tmp_path)
    assert [row.episode for row in outcome.runs[0].evaluations] == [5, 10, 15, 20]
    assert outcome.networks == 2
    assert outcome.seconds > 0
    for scenario, run in zip(unit.scenarios, outcome.runs, strict=True):
        # An update a step from the fourth transition on, and one an episode for the main agent, likewise.
        assert run.updates == (run.env_steps - 3) + (20 - 3)
        assert 20 <= run.env_steps <= 20 * scenario.step_limit
        assert {row.material for row in run.evaluations} <= {"wood", "stone"}
        assert run.score == run.evaluations[-1].score


def test_no_run_loses_more_than_an_evaluation_interval(tmp_path: Path) -> None:
    unit = one_unit("nested", [DOT, BAR], 2, episodes=50)
    own = training(unit, tmp_path)
    for tick in range(200):
        own.tick()
        if tick % 20 == 0 and (tmp_path / "checkpoint").exists():
            lost = own.trainer.episodes_done - training(unit, tmp_path).trainer.episodes_done
            assert lost.min() >= 0
            assert lost.max() < unit.preset.evaluate_every
    assert own.trainer.episodes_done.max() > 3 * unit.preset.evaluate_every


def test_stopped_time_and_again_the_same_comes_out(tmp_path: Path) -> None:
    unit = one_unit("hierarchical", [DOT, BAR], 2)
    straight = train(unit, tmp_path / "straight")
    own = training(unit, tmp_path / "stopped")
    ticks = 0
    while not own.trainer.finished:
        own.tick()
        ticks += 1
        if ticks % 37 == 0:
            own.save()
            own = training(unit, tmp_path / "stopped")
        elif ticks % 50 == 0:  # a kill: what came after the last save is done again
            own = training(unit, tmp_path / "stopped")
    assert own.trainer.finished
    own.finish()
    stopped = outcome_of(unit, tmp_path / "stopped")
    assert stopped
    assert stopped.runs == straight.runs


def test_a_finished_unit_leaves_its_outcome_alone(tmp_path: Path) -> None:
    unit = one_unit("nested", [DOT], 1)
    assert outcome_of(unit, tmp_path / "unit") is None
    train(unit, tmp_path / "unit")
    assert [path.name for path in (tmp_path / "unit").iterdir()] == [OUTCOME]


def test_an_outcome_of_another_unit_or_half_of_one_is_refused(tmp_path: Path) -> None:
    unit = one_unit("nested", [DOT], 1)
    train(unit, tmp_path)
    with pytest.raises(RunError, match="belongs to another experiment"):
        outcome_of(one_unit("nested", [DOT], 1, episodes=21), tmp_path)
    whole = (tmp_path / OUTCOME).read_bytes()
    (tmp_path / OUTCOME).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(RunError, match="remove it to train that anew") as caught:
        outcome_of(unit, tmp_path)
    assert "\n" not in str(caught.value)


def test_a_full_disk_costs_one_line_and_not_the_last_save(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    unit = one_unit("nested", [DOT], 2, episodes=50)
    own = training(unit, tmp_path)

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    while (own.trainer.episodes_done < 14).all():
        own.tick()
    saved = training(unit, tmp_path).trainer.ticks
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full)
        with pytest.raises(RunError, match=r"No space left on device.*: make room"):
            own.save()
    assert 0 < training(unit, tmp_path).trainer.ticks == saved
