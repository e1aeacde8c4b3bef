"""The proof: a few moves and placings with a fresh profile, each of the eight actions once, in the arena itself.

from above, S the start, blocks by the action that places them; the agent ends where it began:

    7   . FD .
    6   LD . RD
    5   . S BD
"""

from statistics import median

from calibration.report.chat_region import without_chat
from calibration.step import Bench, Found, Picture
from mc_nested.arena import rules
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import Action, Cell
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.errors import NotConfirmedError
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile
from mc_nested.live.session import overlay_of

ACTIONS = (Action.FD, Action.B, Action.LD, Action.R, Action.RD, Action.BD, Action.L, Action.F)

SCENARIO = Scenario(
    "proof", frozenset({(7, 7), (6, 6), (8, 6), (8, 5)}), (7, 5), len(ACTIONS), (Material("stone", 0.0, "stone"),)
)


def prove(bench: Bench, profile: Profile, *, is_server_allowed: bool = False) -> Found:
    """Do each action once, and see that the screen shows what the rules say; then clear the blocks again.

    Raises:
        LiveError: an action did not go as the rules say, or the game did not obey: the profile isn't good.
        UserError: a profile without arena or font, or a world that others share.
    """
    desktop = bench.desktop
    screen = WindowScreen(desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    game = LiveGame(
        SCENARIO,
        profile,
        display=desktop.display,
        keyboard=desktop.keyboard,
        pointer=desktop.pointer,
        clock=desktop.clock,
        screen=screen,
        is_server_allowed=is_server_allowed,
        hands=bench.hands,
    )
    cell, placed = game.reset(0), set[Cell]()
    for action in ACTIONS:
        outcome = game.act(action)
        wanted = rules.moved(cell, action, placed)
        landing = rules.landing(wanted, action, placed)
        if outcome != Outcome(wanted, landing):
            raise NotConfirmedError(
                f"{action.name} from cell {cell} should end in {wanted} with a block at {landing}, it ended in "
                f"{outcome.cell} with a block at {outcome.placed}: calibrate the walk again"
            )
        cell = outcome.cell
        placed |= {landing} if landing else set()
    seen = without_chat(desktop.display.grab(), screen.scale())
    game.reset(0)
    effort, seconds = game.log.effort, median(game.log.seconds)
    again = effort.corrections + effort.second_clicks
    return Found(
        "proof",
        profile,
        (
            f"{len(ACTIONS)} actions, {len(placed)} blocks: each where it should be",
            f"{seconds:.2f} s an action (median), {again} moves and clicks repeated",
        ),
        len(ACTIONS),
        (Picture("What the proof built", seen, "cleared again afterwards"),),
    )
