"""``mc-nested try-it``: what a volunteer who has the game runs, and the one file that comes of it."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.report.privacy import names_here
from calibration.try_it import TryIt, forty_actions, take_random_actions
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli.calibrate import FontOption
from mc_nested.cli.doctor import examined
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.options import opening_of
from mc_nested.cli.output_folder import output_folder
from mc_nested.errors import McNestedError, NotConfirmedError, StoppedError, UserError
from mc_nested.learn.evaluation import steps_of, take_steps
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from mc_nested.live.input.signals import signals_as_exit

BEFORE = """\
It plays in your game for some two minutes, puts back what stood there, and leaves one file that you can send.
Nothing is sent by itself. In the game, before you answer:
  - open a single-player Creative world with cheats, in English, in a window; press F3+P once;
  - from 1.21.9 on press F3+F6 and turn the block looked at on (looking_at_block, from 26.1 on looking_at_block_state);
  - go to flat, free ground; turn the debug screen on (F3), and look down at the ground before you.
To stop: press F12, or Ctrl+C here. Every key is released."""

MAY_BUILD = "May I build on the 17 x 17 blocks before you? What stands there is copied, and put back at the end."

WHICH_FONT = "Which file is the game's jar, as .minecraft/versions/1.20.1/1.20.1.jar? Its letters have to be known"


def try_it(
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="a new folder", show_default="one under runs/, by its date")
    ] = None,
    font: FontOption = None,
    yes: Annotated[bool, typer.Option("--yes", help="ask nothing: build on the ground before you")] = False,
) -> None:
    """Try everything in your game in a few minutes, and make one file of what happened, to send to those who ask.

    Whatever goes wrong, the file is made, and says where. The exit code is 2 then, 130 if you stopped it.
    """
    with output_folder(out, "try-it") as folder, signals_as_exit():
        tried = TryIt(folder.resolve(), opening_of("", "try-it", None), examined, names_here(), font)
        try:
            tried.run(
                {
                    "question": partial(_ask, yes=yes),
                    "doctor": partial(tried.examine, _ask_font),
                    "calibration": tried.calibrate,
                    "actions": partial(tried.play, forty_actions(), take_random_actions),
                    "line": partial(tried.play, load_scenario("line"), _build),
                    "undo": tried.put_back,
                }
            )
        except (StoppedError, KeyboardInterrupt, typer.Abort) as stop:
            raise Stopped(f"{tried.how_it_failed(stop)}; {_packed(tried)}") from stop
        except Exception as error:
            raise UserError(f"{tried.how_it_failed(error)}; {_packed(tried)}") from error
        except BaseException as end:
            typer.echo(f"{tried.how_it_failed(end)}; {_packed(tried)}", err=True)
            raise
        typer.echo(f"done in {sum(step.seconds for step in tried.steps):.0f} s; {_packed(tried)}")


def _packed(tried: TryIt) -> str:
    """Make the file, also where Ctrl+C comes once more, and say where it is, or why there is none."""
    try:
        with catch_interrupts():
            file = tried.pack()
    except (McNestedError, OSError) as error:
        return f"there is no file to send: {error}"
    return f"please send {file} ({file.stat().st_size / 1e6:.1f} MB); report.html beside it shows what is in it"


def _ask(*, yes: bool) -> None:
    typer.echo(BEFORE, err=True)
    if not (yes or typer.confirm(MAY_BUILD)):
        raise UserError("nothing was pressed or built, since you didn't agree")


def _ask_font() -> Path | None:
    """Ask for the game's font; None where the person doesn't know."""
    while named := typer.prompt(WHICH_FONT, default="", show_default=False):
        if Path(named).expanduser().is_file():
            break
        typer.echo(f"There is no file {named}.", err=True)
    return Path(named) if named else None


def _build(env: ArenaEnv) -> None:
    """Let the agent that comes with the package build the design, which it has never seen."""
    take_steps(env, steps_of(agent_of(shipped_weights(), env.scenario), env))
    if env.placed != env.scenario.design:
        raise NotConfirmedError(f"{len(env.placed & env.scenario.design)} of {env.scenario.blocks} blocks stand")
