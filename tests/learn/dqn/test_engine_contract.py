"""The contract of every engine, and that both engines compute the same."""

import numpy as np
import pytest

from mc_nested.errors import DivergedError
from mc_nested.learn.dqn.engine import NetworkForm
from mc_nested.learn.dqn.engines import COMPILED, TORCH
from tests.learn.dqn.made_engines import RULE, batch_of, engine_of, part

ENGINES = pytest.mark.parametrize("name", [COMPILED, TORCH])


@pytest.mark.parametrize("rows", [1, 4])
def test_both_engines_agree_after_two_hundred_updates_of_the_papers_network(rows: int) -> None:
    rule = RULE._replace(target_period=50)
    ours, theirs = engine_of(COMPILED, rows, rule), engine_of(TORCH, rows, rule)
    np.testing.assert_array_equal(ours.online, theirs.online)
    for update in range(200):
        some = list(range(rows)) if update % 3 else [rows - 1]  # all rows at once, or one beside the others
        batch = part(batch_of(rows, update), some)
        errors = [engine.update(np.array(some), batch) for engine in (ours, theirs)]
        np.testing.assert_allclose(errors[0], errors[1], rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(ours.online, theirs.online, rtol=1e-3, atol=1e-5)
    np.testing.assert_allclose(ours.target, theirs.target, rtol=1e-3, atol=1e-5)
    assert ours.updates.tolist() == theirs.updates.tolist()
    np.testing.assert_allclose(ours.last.loss(), theirs.last.loss(), rtol=1e-3)
    np.testing.assert_allclose(ours.last.q(), theirs.last.q(), rtol=1e-3, atol=1e-4)


@pytest.mark.parametrize("rows", [None, [2, 0], [2, 1, 0], [1]])
def test_both_engines_give_the_same_q_values(rows: list[int] | None) -> None:
    ours, theirs = engine_of(COMPILED, 3), engine_of(TORCH, 3)
    named = None if rows is None else np.array(rows)
    states = np.array([5, 77, 1234])[: len(rows or [0, 1, 2])]
    np.testing.assert_allclose(ours.q_values(states, named), theirs.q_values(states, named), rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("saved_by", [COMPILED, TORCH])
def test_each_engine_continues_from_the_other_engines_saved_state(saved_by: str) -> None:
    one, other = engine_of(saved_by, 2), engine_of(TORCH if saved_by == COMPILED else COMPILED, 2)
    for update in range(5):
        one.update(np.arange(2), batch_of(2, update))
    assert one.form == other.form == NetworkForm("mlp", (4, 32, 32, 8))
    other.load({name: kept.copy() for name, kept in one.state().items()})
    for engine in (one, other):
        engine.update(np.arange(2), batch_of(2, 5))
    np.testing.assert_allclose(one.online, other.online, rtol=1e-4, atol=1e-6)


@ENGINES
def test_the_target_network_is_renewed_every_period_and_unchanged_in_between(name: str) -> None:
    engine = engine_of(name, 1)
    first = engine.target.copy()
    for update in range(1, 3):
        engine.update(np.array([0]), batch_of(1, update))
        np.testing.assert_array_equal(engine.target, first)
    engine.update(np.array([0]), batch_of(1, 3))
    np.testing.assert_array_equal(engine.target, engine.online)
    assert not np.array_equal(engine.target, first)


@ENGINES
def test_an_update_leaves_unnamed_rows_unchanged(name: str) -> None:
    engine = engine_of(name, 4)
    engine.update(np.arange(4), batch_of(4, 1))
    before = {part_: kept.copy() for part_, kept in engine.state().items()}
    engine.update(np.array([2, 0]), batch_of(2, 2))
    for part_, kept in engine.state().items():
        np.testing.assert_array_equal(kept[[1, 3]], before[part_][[1, 3]])
        assert not np.array_equal(kept[2], before[part_][2]) or part_ == "target"
    assert engine.updates.tolist() == [2, 1, 2, 1]


@ENGINES
def test_a_loaded_engine_continues_to_the_bit(name: str) -> None:
    one, other = engine_of(name, 2), engine_of(name, 2)
    one.update(np.arange(2), batch_of(2, 1))
    other.load({part_: kept.copy() for part_, kept in one.state().items()})
    for engine in (one, other):
        engine.update(np.arange(2), batch_of(2, 2))
    for part_, kept in one.state().items():
        np.testing.assert_array_equal(kept, other.state()[part_])


@ENGINES
def test_networks_of_another_shape_are_refused(name: str) -> None:
    engine = engine_of(name, 2)
    before = engine.online.copy()
    with pytest.raises(ValueError, match="networks of"):
        engine.load_online(np.zeros((2, 5), np.float32))
    with pytest.raises((ValueError, KeyError)):
        engine.load({**engine.state(), "online": np.zeros((2, 5), np.float32)})
    np.testing.assert_array_equal(engine.online, before)


@ENGINES
def test_loading_online_networks_also_sets_the_target_networks(name: str) -> None:
    engine = engine_of(name, 2)
    engine.load_online(engine.online[::-1].copy())
    np.testing.assert_array_equal(engine.target, engine.online)
    np.testing.assert_array_equal(engine.online[0], engine_of(name, 2).online[1])


@ENGINES
def test_diverging_networks_raise_an_error_that_names_the_learning_rate(name: str) -> None:
    engine = engine_of(name, 2, RULE._replace(learning_rate=1e38))

    def update_while_finite() -> None:
        for update in range(10):
            assert np.isfinite(engine.online).all(), "no update may pass that leaves what is no number"
            engine.update(np.arange(2), batch_of(2, update))

    with pytest.raises(DivergedError, match=r"learning_rate 1e\+38 is too high: after \d updates") as caught:
        update_while_finite()
    assert "\n" not in str(caught.value)


@ENGINES
def test_loss_and_q_value_are_nan_before_a_rows_first_update(name: str) -> None:
    engine = engine_of(name, 2)
    engine.update(np.array([1]), batch_of(1, 3))
    assert np.isnan(engine.last.loss()).tolist() == [True, False]
    assert np.isnan(engine.last.q()).tolist() == [True, False]
