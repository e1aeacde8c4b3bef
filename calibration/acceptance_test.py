"""The acceptance test: each of the eight actions once, with the new profile, in the real arena.

From above; S is the start, and blocks are named after the actions that place them. The agent ends where it began:

    7   . FD .
    6   LD . RD
    5   . S BD
"""

from statistics import median

from calibration.context import CalibrationContext, ReportPicture, StepResult
from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.errors import NotConfirmedError
from mc_nested.live.live_game import LiveGame, started_over
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import without_chat
from mc_nested.live.vision.game_screen import seen_gui_scale

ACTIONS = (Action.FD, Action.B, Action.LD, Action.R, Action.RD, Action.BD, Action.L, Action.F)

SCENARIO = Scenario(
    "proof", frozenset({(7, 7), (6, 6), (8, 6), (8, 5)}), (7, 5), len(ACTIONS), (Material("stone", 0.0, "stone"),)
)


def run_acceptance_test(context: CalibrationContext, profile: Profile) -> StepResult:
    """Take each action once, and check that the screen shows what the rules say. Then clear the blocks again.

    After a mishap it starts over once: a stall of a busy machine ends one try, a wrong profile each.

    Raises:
        LiveError: an action did not go as the rules say, or the game did not obey. The profile is not good.
        UserError: a profile without arena or font, or a world that others share.
    """
    return started_over(lambda: _take_each_action(context, profile), context.say, tries=2)


def _take_each_action(context: CalibrationContext, profile: Profile) -> StepResult:
    connection = context.connection.for_profile(profile)
    game = LiveGame(SCENARIO, profile, connection)
    cell, placed = game.reset(0), set[Cell]()
    for action in ACTIONS:
        outcome = game.act(action)
        expected_cell = rules.moved(cell, action, placed, SCENARIO.size)
        expected_block = rules.landing(expected_cell, action, placed, SCENARIO.size)
        if outcome != Outcome(expected_cell, expected_block):
            raise NotConfirmedError(
                f"{action.name} from cell {cell} should end in {expected_cell} with a block at {expected_block}, it "
                f"ended in {outcome.cell} with a block at {outcome.placed}: calibrate the walk again"
            )
        cell = outcome.cell
        placed |= {expected_block} if expected_block else set()
    picture = without_chat(connection.devices.display.grab(), seen_gui_scale(connection.screen))
    game.reset(0)
    effort, seconds = game.log.effort, median(game.log.seconds)
    repeats = effort.corrections + effort.second_clicks
    return StepResult(
        "proof",
        profile,
        (
            f"{len(ACTIONS)} actions, {len(placed)} blocks: each where it should be",
            f"{seconds:.2f} s an action (median), {repeats} moves and clicks repeated",
        ),
        len(ACTIONS),
        (ReportPicture("What the acceptance test built", picture, "cleared again afterwards"),),
    )
