import threading

from mc_nested.view.board import Board
from mc_nested.view.status import MOST_ACTIONS, ActionSeen, ReadingSeen


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def a_board() -> tuple[Board, Clock]:
    clock = Clock()
    return Board("train", "a title", clock), clock


def test_a_board_begins_with_nothing_but_its_name_and_the_time() -> None:
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


def test_it_says_since_when_something_is_done() -> None:
    board, clock = a_board()
    clock.now = 105.0
    board.note("waits", on="the game")
    clock.now = 109.0

    status = board.status()

    assert (status.doing, status.mood, status.since) == ("waits for the game", "waits", 105.0)


def test_who_types_or_walks_or_clicks_waits_no_longer() -> None:
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


def test_what_is_said_again_goes_on_as_before() -> None:
    board, clock = a_board()
    board.does("trains")
    clock.now = 105.0
    board.does("trains")

    assert board.status().since == 100.0


def test_an_action_that_is_done_again_begins_anew() -> None:
    board, clock = a_board()
    board.note("acts", action=0, cell=(0, 14))
    clock.now = 105.0
    board.note("acts", action=0, cell=(0, 14))

    assert board.status().since == 105.0


def test_what_comes_after_an_action_can_take_its_time() -> None:
    board, _ = a_board()
    board.note("acts", action=0, cell=(0, 0))
    board.note("done", cell=(0, 1), placed=None, seconds=0.3)

    assert (board.status().doing, board.status().mood) == ("chooses what to do next, or practises", "works")


def test_after_a_pause_it_begins_anew() -> None:
    board, clock = a_board()
    board.show(paused=True)
    clock.now = 160.0
    board.go_on()

    assert (board.status().paused, board.status().since) == (False, 160.0)


def test_the_detail_ends_with_what_it_is_a_part_of() -> None:
    board, _ = a_board()
    board.note("acts", action=0, cell=(0, 0))
    board.note("plans", key="w", ticks=5, sneak=False)
    assert board.status().detail == "holds w for 5 ticks"

    board.note("acts", action=1, cell=(0, 1))
    assert board.status().detail == ""


def test_the_last_actions_are_kept_with_the_name_they_began_with() -> None:
    board, _ = a_board()
    for number in range(MOST_ACTIONS + 5):
        board.note("acts", action=6, cell=(number, 0))
        board.note("done", cell=(number + 1, 0), placed=None, seconds=0.3)

    actions = board.status().actions

    assert len(actions) == MOST_ACTIONS
    assert actions[-1] == ActionSeen("R+D", (MOST_ACTIONS + 5, 0), None, 0.3)


def test_the_last_reading_is_kept() -> None:
    board, _ = a_board()
    assert board.status().reading is None
    board.note("reads", problem="no XYZ line")
    assert board.status().reading == ReadingSeen(problem="no XYZ line")


def test_it_is_read_by_one_thread_while_another_plays() -> None:
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
