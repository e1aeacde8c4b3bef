import pytest

from mc_nested.view.status import Learning
from mc_nested.view.words import LONG_S, Life, StatusShown, lasting, learning_lines, life_of, status_words, wrapped
from tests.view.shown import LEARNING, LIVE, shown


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(-1, "0 s"), (0.9, "0 s"), (59.9, "59 s"), (60, "1 min 0 s"), (3599, "59 min 59 s"), (3700, "1 h 1 min")],
)
def test_a_time_span_has_its_two_largest_units(seconds: float, words: str) -> None:
    assert lasting(seconds) == words


def test_status_line_gives_the_activity_and_its_duration() -> None:
    assert status_words(shown(after=2.0)) == (
        "plays",
        "moves back and places a block (B+D), from (1, 2): holds s for 4 ticks, for 2 s",
    )


def test_an_action_that_takes_too_long_is_stuck() -> None:
    assert status_words(shown(after=LONG_S))[0] == "stuck"


def test_status_line_says_so_if_nothing_is_heard_of_the_run() -> None:
    silent = StatusShown(LIVE, LIVE.at + LONG_S)

    assert status_words(silent) == (
        "stuck",
        "nothing was heard of the run for 10 s; before: moves back and places a block (B+D), from (1, 2)",
    )


@pytest.mark.parametrize(
    ("text", "width", "lines"),
    [
        ("", 10, [""]),
        ("one two three", 7, ["one two", "three"]),
        ("one two three", 8, ["one two", "three"]),
        ("a wordthatislong b", 5, ["a", "wordthatislong", "b"]),
    ],
)
def test_a_sentence_is_wrapped_between_words(text: str, width: int, lines: list[str]) -> None:
    assert wrapped(text, width) == lines


def test_a_long_practice_is_not_stuck() -> None:
    practises = LIVE.model_copy(update={"mood": "works"})

    assert status_words(shown(practises, after=100.0))[0] == "works"


def test_waiting_for_a_person_is_not_stuck() -> None:
    waiting = LIVE.model_copy(update={"mood": "waits", "doing": "waits for the game", "detail": ""})

    assert status_words(shown(waiting, after=60.0)) == ("waits", "waits for the game, for 1 min 0 s")


@pytest.mark.parametrize(
    ("fields", "life", "word", "part"),
    [
        ({"question": "Clear it?"}, "runs", "asks", "Clear it? Press y for yes, n for no."),
        ({"stopping": True}, "runs", "stops", "stopping: what is under way ends, then it is saved"),
        ({"paused": True}, "runs", "paused", "paused; press p to go on"),
        ({"pausing": True}, "runs", "paused", "pauses after what is under way; press p to go on"),
        ({"ended": "finished"}, "ended", "ended", "ended at 01:48:20: finished"),
        ({}, "gone", "gone", "the run's process is gone; it was last seen at 01:48:20"),
    ],
)
def test_the_status_line_says_that_a_run_asks_stops_pauses_or_has_ended(
    fields: dict[str, object], life: Life, word: str, part: str
) -> None:
    status = LIVE.model_copy(update=fields)

    found, sentence = status_words(StatusShown(status, status.at, life))

    assert (found, part in sentence) == (word, True)


def test_run_counts_as_alive_while_it_is_published_or_was_just_now_and_has_not_ended() -> None:
    ended = LIVE.model_copy(update={"ended": "finished"})

    assert life_of(LIVE, True, LIVE.at + 60) == "runs"
    assert life_of(LIVE, False, LIVE.at + 60) == "gone"
    assert life_of(LIVE, False, LIVE.at + 1) == "runs"  # on a disk without locks
    assert life_of(ended, True, LIVE.at) == life_of(ended, False, LIVE.at + 60) == "ended"


def test_progress_of_one_trial_gives_episodes_scores_known_cells_and_time_left() -> None:
    assert learning_lines(LEARNING) == [
        "12 of at most 41 episodes",
        "last score 18, best 24, of 26",
        "probing, 9 of 16 cells known",
        "game time left: about 5 min 30 s",
    ]


def test_progress_of_many_trials_gives_episodes_trials_at_the_optimum_and_mean_score() -> None:
    learning = Learning(trials=90, episodes=1234, episodes_at_most=18000, score=4.25, optimum=26, at_optimum=3)

    assert learning_lines(learning) == [
        "1,234 of at most 18,000 episodes",
        "90 trials, 3 at the optimum",
        "last score 4.25, of 26 (means)",
    ]
