"""Random streams: a pure function of seed, run and tick."""

import numpy as np

from mc_nested.learn.streams import TICKS_A_CHUNK, Purpose, Streams, stream

TICKS = [0, 1, TICKS_A_CHUNK - 1, TICKS_A_CHUNK, 10 * TICKS_A_CHUNK + 3]


def test_a_ticks_numbers_do_not_depend_on_the_ticks_before() -> None:
    onward, jumping = Streams(7, runs=[0, 1], width=5), Streams(7, runs=[0, 1], width=5)
    walked = {tick: onward.at(tick).copy() for tick in range(TICKS[-1] + 1)}
    for tick in reversed(TICKS):
        np.testing.assert_array_equal(jumping.at(tick), walked[tick])


def test_a_ticks_numbers_stay_when_those_of_the_next_one_are_drawn() -> None:
    streams = Streams(7, runs=[0], width=5)
    last = streams.at(TICKS_A_CHUNK - 1)
    kept = last.copy()
    streams.at(TICKS_A_CHUNK)
    np.testing.assert_array_equal(last, kept)


def test_a_runs_numbers_do_not_depend_on_the_runs_beside_it() -> None:
    alone, beside = Streams(7, runs=[5], width=5), Streams(7, runs=range(3, 9), width=5)
    for tick in TICKS:
        np.testing.assert_array_equal(alone.at(tick)[0], beside.at(tick)[2])


def test_streams_differ_by_seed_run_and_tick() -> None:
    numbers = [Streams(seed, runs=range(3), width=4).at(tick).copy() for seed in (0, 1) for tick in TICKS]
    rows = [tuple(row) for drawn in numbers for row in drawn]
    assert len(set(rows)) == len(rows) == 2 * len(TICKS) * 3
    assert all(0 <= number < 1 for row in rows for number in row)


def test_initial_streams_differ_by_seed_and_run() -> None:
    drawn = {stream(Purpose.INITIAL, seed, run).random() for seed in (0, 1) for run in (0, 1)}
    assert len(drawn) == 4


def test_the_main_agents_batches_differ_by_seed_run_and_tick() -> None:
    ways = [(seed, run, tick) for seed in (0, 1) for run in (0, 1) for tick in (0, 1, 5000)]
    drawn = [stream(Purpose.MAIN_UPDATES, *way).random() for way in ways]
    assert len({*drawn, stream(Purpose.INITIAL, 0, 0).random(), Streams(0, [0], 1).at(0)[0, 0]}) == len(ways) + 2
    assert drawn == [stream(Purpose.MAIN_UPDATES, *way).random() for way in ways]


def test_practice_streams_differ_by_seed_run_and_episode_and_from_all_others() -> None:
    ways = [(seed, run, at) for seed in (0, 1) for run in (0, 1) for at in (0, 1, 5000)]
    drawn = [stream(Purpose.PRACTICE, *way).random() for way in ways]
    others = [stream(Purpose.MAIN_UPDATES, *way).random() for way in ways] + [stream(Purpose.INITIAL, 0, 0).random()]
    assert len({*drawn, *others, Streams(0, [0], 1).at(0)[0, 0]}) == len(drawn) + len(others) + 1
    assert drawn == [stream(Purpose.PRACTICE, *way).random() for way in ways]


def test_plan_episode_and_practice_streams_differ_by_seed_run_and_number() -> None:
    purposes = Purpose.PLANS, Purpose.EPISODES, Purpose.PRACTICE
    ways = [(seed, run, number) for seed in (0, 1) for run in (0, 1) for number in (0, 1, 5000)]
    drawn = [stream(purpose, *way).random() for purpose in purposes for way in ways]
    assert len(set(drawn)) == 3 * len(ways)
    assert drawn == [stream(purpose, *way).random() for purpose in purposes for way in ways]
