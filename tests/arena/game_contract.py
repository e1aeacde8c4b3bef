"""The contract of every Game, whatever is behind it; test_game_contract checks that wrong Games fail it."""

from collections.abc import Callable, Sequence

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Game, Outcome
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import Scenario

BUMPS = (
    *(Action.F, Action.FD, Action.BD, Action.F, Action.FD),  # the far edge, then the block just placed before it
    *(Action.LD, Action.RD, Action.B, Action.BD, Action.FD),  # a placing that the block there voids, and blocks around
    *[Action.L] * 8,  # the left edge, from the middle
)
"""Moves and placings from the shipped scenarios' start, of which the rules void every kind."""


Truth = Callable[[], tuple[Cell, set[Cell]]]
"""The agent's true cell, and the cells that truly hold a block."""


def check_game(game: Game, scenario: Scenario, actions: Sequence[Action], truth: Truth | None = None) -> None:
    """Raise AssertionError where the game's outcomes break the rules, over one episode after an abandoned one.

    With a ``truth``, the outcomes must agree with it too. A resumable game must return to the state it was saved in.
    """
    assert game.reset(0) == scenario.start, "a reset leads to the start cell"
    game.act(Action.BD)
    assert game.reset(scenario.best_material) == scenario.start, "a reset leads to the start cell from anywhere"
    cell, placed = scenario.start, set[Cell]()
    assert truth is None or truth() == (cell, placed), "a reset clears the arena"
    half, kept, said = len(actions) // 2, {}, list[Outcome]()
    for step, action in enumerate(actions):
        if game.resumable and step == half:
            kept = game.resumable.snapshot()
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        outcome = game.act(action)
        said.append(outcome)
        assert outcome.cell == cell, f"{action.name} leads to {cell}"
        assert outcome.placed == block, f"{action.name} places a block in {block}"
        if block is not None:
            placed.add(block)
        assert truth is None or truth() == (cell, placed), f"{action.name} did what was said"
    if game.resumable and kept:
        game.reset(0)
        game.resumable.restore(kept)
        assert [game.act(action) for action in actions[half:]] == said[half:], "a restored episode goes on as before"


def check_following(game: Game, scenario: Scenario, actions: Sequence[Action], truth: Truth | None = None) -> None:
    """Raise AssertionError where an action that is told what follows does anything but what the rules say.

    One episode, after one that was abandoned while something was announced. A ``truth`` must agree at the end: until
    then the agent may be on its way.
    """
    game.reset(scenario.best_material)
    game.act(Action.BD, None, (Action.B, None))
    cell, placed = game.reset(scenario.best_material), set[Cell]()
    for action, then in zip(actions, [*actions, None][1:], strict=True):
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        outcome = game.act(action, None, None if then is None else (then, None))
        assert outcome == Outcome(cell, block), f"{action.name} does the same, whatever follows"
        placed |= {block} if block else set()
    assert truth is None or truth() == (cell, placed), "all was done that was said"


Kinds = Callable[[], dict[Cell, str]]
"""The block, as the scenario names it, that each cell of the arena truly holds."""


def check_materials(
    game: Game, scenario: Scenario, steps: Sequence[tuple[Action, int | None]], kinds: Kinds | None = None
) -> None:
    """Raise AssertionError where the material in hand changes an outcome, or a block isn't of that material.

    One episode after an abandoned one that ended with another material in hand; a step is an action and the material to
    take in hand before it, None to leave it.
    """
    first, last = 0, len(scenario.materials) - 1
    game.reset(first)
    game.act(Action.B, last)
    cell, in_hand, stands = game.reset(first), first, dict[Cell, str]()
    for action, material in steps:
        in_hand = in_hand if material is None else material
        cell = moved(cell, action, stands, scenario.size)
        block = landing(cell, action, stands, scenario.size)
        assert game.act(action, material) == Outcome(cell, block), f"{action.name} does the same with any material"
        if block is not None:
            stands[block] = scenario.materials[in_hand].block
        assert kinds is None or kinds() == stands, f"{action.name} places what is in hand"
