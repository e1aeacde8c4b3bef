import threading

import pytest

from mc_nested.arena.action import Action
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.view.board import Board, Doing, action_seen, detail_of, doing_of, named, reading_seen, words_of
from mc_nested.view.status import MOST_ACTIONS, ActionSeen, ReadingSeen


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def a_board() -> tuple[Board, Clock]:
    clock = Clock()
    return Board("train", "a title", clock), clock


def test_new_board_has_only_its_kind_its_title_and_the_time() -> None:
    board, clock = a_board()
    clock.now = 101.0

    status = board.status()

    assert (status.what, status.title, status.doing, status.since, status.at) == (
        "train",
        "a title",
        "begins",
        100.0,
        101.0,
    )


def test_board_says_since_when_the_current_activity_lasts() -> None:
    board, clock = a_board()
    clock.now = 105.0
    board.note("waits", on="the game")
    clock.now = 109.0

    status = board.status()

    assert (status.doing, status.mood, status.since) == ("waits for the game", "waits", 105.0)


def test_typing_or_walking_ends_the_waiting() -> None:
    board, clock = a_board()
    board.does("Arena")
    board.note("waits", on="the game")
    clock.now = 105.0
    board.note("types", line="/time set 6000")
    clock.now = 109.0
    board.note("plans", key="w", ticks=9, sneak=True)

    status = board.status()

    assert (status.doing, status.detail, status.mood, status.since) == (
        "Arena",
        "holds w for 9 ticks, sneaking",
        "works",
        105.0,
    )


def test_a_reset_that_waited_goes_on_as_a_reset() -> None:
    board, _ = a_board()
    board.note("resets", material=0, placed=(), pressed=(), tick_phase=(0.0, 0.0, 0.0))
    resetting = board.status().doing
    board.note("waits", on="the game")
    board.note("recovers", screen="pause")
    board.note("types", line="/time set 6000")

    status = board.status()

    assert (status.doing, status.detail, status.mood) == (resetting, "types /time set 6000", "plays")


def test_repeating_the_current_activity_changes_nothing() -> None:
    board, clock = a_board()
    board.does("trains")
    clock.now = 105.0
    board.does("trains")

    assert board.status().since == 100.0


def test_same_action_again_counts_its_time_anew() -> None:
    board, clock = a_board()
    board.note("acts", action=0, cell=(0, 14))
    clock.now = 105.0
    board.note("acts", action=0, cell=(0, 14))

    assert board.status().since == 105.0


def test_board_says_works_once_an_action_is_done() -> None:
    board, _ = a_board()
    board.note("acts", action=0, cell=(0, 0))
    board.note("done", cell=(0, 1), placed=None, seconds=0.3)

    assert (board.status().doing, board.status().mood) == ("chooses what to do next, or practises", "works")


def test_activity_counts_its_time_anew_after_a_pause() -> None:
    board, clock = a_board()
    board.show(paused=True)
    clock.now = 160.0
    board.go_on()

    assert (board.status().paused, board.status().since) == (False, 160.0)


def test_detail_is_cleared_once_the_next_action_begins() -> None:
    board, _ = a_board()
    board.note("acts", action=0, cell=(0, 0))
    board.note("plans", key="w", ticks=5, sneak=False)
    assert board.status().detail == "holds w for 5 ticks"

    board.note("acts", action=1, cell=(0, 1))
    assert board.status().detail == ""


def test_board_keeps_the_last_actions_with_their_names() -> None:
    board, _ = a_board()
    for number in range(MOST_ACTIONS + 5):
        board.note("acts", action=6, cell=(number, 0))
        board.note("done", cell=(number + 1, 0), placed=None, seconds=0.3)

    actions = board.status().actions

    assert len(actions) == MOST_ACTIONS
    assert actions[-1] == ActionSeen("R+D", (MOST_ACTIONS + 5, 0), None, 0.3)


def test_where_the_time_of_actions_goes_is_said_by_their_notes() -> None:
    """0.5 s with a key down for 8 ticks, 0.1 s of choosing, 0.3 s with a key down for 4 ticks."""
    board, clock = a_board()
    for ticks, seconds in ((8, 0.5), (4, 0.3)):
        board.note("acts", action=0, cell=(0, 0))
        board.note("plans", key="w", ticks=ticks, sneak=False)
        board.note("done", cell=(0, 1), placed=None, seconds=seconds)
        clock.now += 0.1

    assert board.status().share == "walking 67 %, confirming 22 %, deciding 11 %"


def test_the_last_reading_is_kept() -> None:
    board, _ = a_board()
    assert board.status().reading is None
    board.note("reads", problem="no XYZ line")
    assert board.status().reading == ReadingSeen(problem="no XYZ line")


def test_one_thread_reads_the_board_while_another_plays() -> None:
    board, _ = a_board()
    over = threading.Event()

    def play() -> None:
        while not over.is_set():
            board.note("acts", action=6, cell=(1, 0))
            board.note("done", cell=(2, 0), placed=None, seconds=0.3)

    thread = threading.Thread(target=play)
    thread.start()
    try:
        for _ in range(200):
            assert board.status().doing in (
                "begins",
                "moves right and places a block (R+D), from (1, 0)",
                "chooses what to do next, or practises",
            )
    finally:
        over.set()
        thread.join()


@pytest.mark.parametrize(
    ("action", "name", "words"),
    [
        (Action.F, "F", "moves forward (F)"),
        (Action.R, "R", "moves right (R)"),
        (Action.BD, "B+D", "moves back and places a block (B+D)"),
        (Action.LD, "L+D", "moves left and places a block (L+D)"),
    ],
)
def test_an_action_has_its_name_in_the_paper_and_words(action: Action, name: str, words: str) -> None:
    assert named(action) == name
    assert words_of(action) == words


@pytest.mark.parametrize(
    ("kind", "facts", "doing"),
    [
        ("waits", {"on": "the game"}, Doing("waits for the game", "waits")),
        ("acts", {"action": 7, "cell": (1, 2)}, Doing("moves back and places a block (B+D), from (1, 2)", "plays")),
        ("fails", {"problem": "no block was seen"}, Doing("was set back: no block was seen", "fails")),
        ("follows", {}, Doing("the player plays, and gives back with the same key", "player")),
        ("stands", {"cell": (0, 0)}, Doing("stands at the start, and chooses")),
        (
            "recovers",
            {"screen": "pause"},
            Doing("finds its way back to the world, from the screen: pause", "waits"),
        ),
    ],
)
def test_each_kind_of_note_begins_its_activity(kind: NoteKind, facts: dict[str, Fact], doing: Doing) -> None:
    assert doing_of(kind, facts) == doing


@pytest.mark.parametrize("kind", ["plans", "clicks", "types", "reads", "done"])
def test_other_notes_begin_no_activity(kind: NoteKind) -> None:
    assert doing_of(kind, {}) is None


@pytest.mark.parametrize(
    ("kind", "facts", "detail"),
    [
        ("plans", {"key": "s", "ticks": 4, "sneak": False}, "holds s for 4 ticks"),
        ("plans", {"key": "w", "ticks": 1, "sneak": True}, "holds w for 1 tick, sneaking"),
        ("clicks", {"attempt": 0}, "clicks"),
        ("clicks", {"attempt": 1}, "clicks again, the block was not seen: attempt 2"),
        ("types", {"line": "/tp 1 2 3"}, "types /tp 1 2 3"),
        ("acts", {"action": 0, "cell": (0, 0)}, ""),
    ],
)
def test_note_gives_the_detail_of_the_current_activity(kind: NoteKind, facts: dict[str, Fact], detail: str) -> None:
    assert detail_of(kind, facts) == detail


def test_done_action_is_shown_with_its_cell_block_and_duration() -> None:
    facts: dict[str, Fact] = {"cell": (2, 3), "placed": (2, 4), "seconds": 0.4}

    assert action_seen(Action.RD, facts) == ActionSeen("R+D", (2, 3), (2, 4), 0.4)
    assert action_seen(Action.R, {**facts, "placed": None}).placed is None
    assert action_seen(Action.R, {**facts, "instead": int(Action.FD)}).name == "F+D", "what a player did"


def test_reading_is_shown_with_pose_and_looked_at_block_or_with_its_problem() -> None:
    facts: dict[str, Fact] = {
        "xyz": (1.5, 64.0, -2.5),
        "yaw": 0.0,
        "pitch": 45.0,
        "target": ((1, 63, -2), "minecraft:stone"),
    }

    assert reading_seen(facts) == ReadingSeen(
        position=(1.5, 64.0, -2.5), yaw=0.0, pitch=45.0, target="minecraft:stone at 1 63 -2"
    )
    assert reading_seen({**facts, "target": None}).target is None
    assert reading_seen({"problem": "no XYZ line"}) == ReadingSeen(problem="no XYZ line")
