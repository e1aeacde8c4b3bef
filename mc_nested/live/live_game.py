"""LiveGame: the Game that is played in a window, through the debug screen and timed keys."""

from pathlib import Path
from types import TracebackType

from mc_nested.arena import rules
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError, ProfileError, StoppedError
from mc_nested.live.action_log import ActionLog
from mc_nested.live.body import Body
from mc_nested.live.chat import Chat
from mc_nested.live.click_points import ClickPoints
from mc_nested.live.commands import reset_commands, teleport_command
from mc_nested.live.devices import Clock, Display, Keyboard, Pointer
from mc_nested.live.fingerprint import check_single_player
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.hands import Hands
from mc_nested.live.last_frames import LastFrames
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import World
from mc_nested.live.way_back import WayBack
from mc_nested.live.world_folder import restore_world

RESET_TRIES = 4
"""How often a reset is begun before its error is raised."""


class LiveGame:
    """A scenario's arena in a running game.

    Use it as a context manager, so that no key stays down whichever way the block is left. Where an action fails, it
    raises LiveError and has to be reset before the next one; a reset finds the way back into the world by itself, and
    raises LiveError where that fails too.

    Args:
        scenario: what is built, of which materials.
        profile: the user's calibrated facts, with an arena marked.
        display: the game's window.
        keyboard: its keys.
        pointer: its buttons.
        clock: the time that holds and waits run on.
        screen: what is read on the window.
        points: the places that menus are clicked at where labels aren't found.
        evidence: the folder that gets the last frames where a reset is given up.
        is_server_allowed: whether a game that others may share is played.
        hands: who presses, where somebody else opened and ends them; left out, its own.

    Raises:
        ProfileError: the profile has no arena, or fewer hotbar slots than the scenario has materials.
    """

    def __init__(
        self,
        scenario: Scenario,
        profile: Profile,
        *,
        display: Display,
        keyboard: Keyboard,
        pointer: Pointer,
        clock: Clock,
        screen: GameScreen,
        points: ClickPoints | None = None,
        evidence: Path | None = None,
        is_server_allowed: bool = False,
        hands: Hands | None = None,
    ) -> None:
        if len(scenario.materials) > len(profile.keys.hotbar):
            raise ProfileError(
                f"scenario {scenario.name} has {len(scenario.materials)} materials, the hotbar only "
                f"{len(profile.keys.hotbar)} slots: choose a scenario with fewer"
            )
        self._scenario = scenario
        self._profile = profile
        self._arena = profile.marked_arena()
        self._clock = clock
        self._display = display
        self._is_server_allowed = is_server_allowed
        self.hands = hands or Hands(display, keyboard, pointer, clock, profile.input)
        self._body = Body(profile, self.hands, screen, clock)
        self._chat = Chat(profile, self.hands, screen, clock)
        self._way_back = WayBack(profile, self.hands, screen, display, clock, points)
        self._last_frames = LastFrames(display, evidence, screen.scale)
        self.log = ActionLog(self._body.effort)
        self._commands = reset_commands(profile, scenario.start, [material.block for material in scenario.materials])
        self._cell: Cell | None = None
        self._placed: set[Cell] = set()
        self._material = 0

    def __enter__(self) -> "LiveGame":
        self.hands.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.hands.__exit__(kind, error, traceback)

    def reset(self, material: int) -> Cell:
        """Clear the marked blocks, stand on the start cell, take the material in hand; place and view are read back.

        Wherever the last action left the game, it is led back into the world first.
        """
        self._cell = None
        for tries_left in reversed(range(RESET_TRIES)):
            try:
                check_single_player(self._display.title(), is_server_allowed=self._is_server_allowed)
                self.hands.release_again()
                if self._way_back.find().screens:
                    self.log.recoveries += 1
                self._lay_out(material)
                break
            except StoppedError:
                raise
            except LiveError as error:
                self._last_frames.take()
                if not tries_left:
                    raise self._given_up(error) from None
                self.log.failed_resets += 1
            finally:
                self.hands.release_all()
        self._placed.clear()
        self._material = material
        self._cell = self._scenario.start
        return self._cell

    def act(self, action: Action) -> Outcome:
        """Do an action on the screen; where the rules void both its move and its block, nothing is pressed."""
        if self._cell is None:
            raise LiveError("the game must be reset first: the last reset or action failed, or there was none")
        cell, self._cell = self._cell, None
        began = self._clock.now()
        try:
            outcome = self._do(cell, action)
        except LiveError:
            self.log.failed_actions += 1
            raise
        finally:
            self.hands.release_all()
        self.log.seconds.append(self._clock.now() - began)
        self._cell = outcome.cell
        if outcome.placed is not None:
            self._placed.add(outcome.placed)
        return outcome

    def _given_up(self, error: LiveError) -> LiveError:
        """The same error, which also says where the last frames are, if there are any."""
        files = self._last_frames.save()
        return type(error)(f"{error}; what was seen last: {files[-1]}") if files else error

    def _do(self, cell: Cell, action: Action) -> Outcome:
        target = rules.moved(cell, action, self._placed)
        landing = rules.landing(target, action, self._placed)
        if target == cell and landing is None:
            return Outcome(self._body.stay_in(cell), None)
        shown_id = self._profile.shown_id(self._scenario.materials[self._material].block)
        if landing is not None:
            return Outcome(target, self._body.build(target, self._placed, shown_id))
        stance = self._body.move_to(target)
        self._body.check_front(stance, self._placed, shown_id)
        return Outcome(stance.cell, None)

    def _lay_out(self, material: int) -> None:
        if self._profile.world is not None:
            self._enter_anew(self._profile.world)
        else:
            self._command()
        self._body.check_screen()
        self.hands.tap(self._profile.keys.hotbar[material])
        self._body.arrive(self._scenario.start)

    def _enter_anew(self, world: World) -> None:
        """Where no commands are allowed: leave the world, restore its folder, and enter it again."""
        self._way_back.leave_world()
        restore_world(Path(world.folder).expanduser(), Path(world.template).expanduser())
        self._way_back.find()

    def _command(self) -> None:
        clear, *others = self._commands
        self._see_it_cleared(clear)
        for command in others:
            self._send(command)

    def _see_it_cleared(self, clear: str) -> None:
        """Clear the marked blocks, before the eyes of an agent who looks at one of them where there is one."""
        witness = next((cell for cell in sorted(self._placed) if self._is_free((cell[0], cell[1] - 1))), None)
        if witness is None:
            self._send(clear)
            return
        behind = witness[0], witness[1] - 1
        self._send(teleport_command(self._arena, behind, self._profile.body.pitch))
        self._body.arrive(behind)
        self._send(clear)
        self._body.see_floor_ahead()

    def _is_free(self, cell: Cell) -> bool:
        return rules.is_inside(cell) and cell not in self._placed

    def _send(self, command: str) -> None:
        # Where no debug screen is to be seen, nobody knows what a command would be typed into.
        self._body.check_screen()
        self._chat.send(command)
