"""The contract of every TeamGame, whatever is behind it; test_team_game_contract checks that wrong ones fail it."""

from collections.abc import Callable, Sequence

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, TeamGame, resolved

Truth = Callable[[], tuple[tuple[Cell, ...], set[Cell]]]
"""The builders' true cells, and the cells that truly hold a block."""

Ticks = Sequence[Sequence[Action | None]]


def check_team_game(game: TeamGame, team: Team, ticks: Ticks, truth: Truth | None = None) -> None:
    """Raise AssertionError where the game's outcomes break the rules, over one episode after an abandoned one.

    With a ``truth``, the outcomes must agree with it too. A resumable game must return to the state it was saved in.
    """
    scenario = team.scenario
    assert game.reset(0) == team.starts, "a reset leads to the start cells"
    game.act([Action.BD] * team.builders)
    assert game.reset(scenario.best_material) == team.starts, "a reset leads to the start cells from anywhere"
    cells, placed = team.starts, set[Cell]()
    assert truth is None or truth() == (cells, placed), "a reset clears the arena"
    half, kept, said = len(ticks) // 2, {}, []
    for tick, actions in enumerate(ticks):
        if game.resumable and tick == half:
            kept = game.resumable.snapshot()
        right = resolved(cells, placed, actions, scenario.size, scenario.blocks - len(placed))
        outcomes = game.act(actions)
        said.append(outcomes)
        assert outcomes == right, f"tick {tick} leads to {right}"
        cells = tuple(outcome.cell for outcome in outcomes)
        placed |= {outcome.placed for outcome in outcomes if outcome.placed is not None}
        assert truth is None or truth() == (cells, placed), f"tick {tick} did what was said"
    if game.resumable and kept:
        game.reset(0)
        game.resumable.restore(kept)
        assert [game.act(actions) for actions in ticks[half:]] == said[half:], "a restored episode goes on as before"
