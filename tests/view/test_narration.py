import pytest

from mc_nested.arena.action import Action
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.view.narration import Doing, action_seen, detail_of, doing_of, named, reading_seen, words_of
from mc_nested.view.status import ActionSeen, ReadingSeen


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
        ("stands", {"cell": (0, 0)}, Doing("stands at the start, and chooses")),
        (
            "recovers",
            {"screen": "pause"},
            Doing("finds its way back to the world, from the screen: pause", "waits"),
        ),
    ],
)
def test_what_begins_with_a_note(kind: NoteKind, facts: dict[str, Fact], doing: Doing) -> None:
    assert doing_of(kind, facts) == doing


@pytest.mark.parametrize("kind", ["plans", "clicks", "types", "reads", "done"])
def test_other_notes_begin_nothing_new(kind: NoteKind) -> None:
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
def test_the_part_of_it_that_is_under_way(kind: NoteKind, facts: dict[str, Fact], detail: str) -> None:
    assert detail_of(kind, facts) == detail


def test_an_action_is_seen_with_what_it_did() -> None:
    facts: dict[str, Fact] = {"cell": (2, 3), "placed": (2, 4), "seconds": 0.4}

    assert action_seen(Action.RD, facts) == ActionSeen("R+D", (2, 3), (2, 4), 0.4)
    assert action_seen(Action.R, {**facts, "placed": None}).placed is None


def test_a_reading_is_seen_with_the_block_looked_at() -> None:
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
