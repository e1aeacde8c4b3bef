"""LiveGame: the Game that is played in a window, through the debug screen and timed keys."""

from types import TracebackType

from mc_nested.arena import rules
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError, ProfileError
from mc_nested.live.body import Body, Read
from mc_nested.live.commands import reset_commands
from mc_nested.live.devices import Clock, Display, Keyboard, Pointer
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile


class LiveGame:
    """A scenario's arena in a running game.

    Use it as a context manager, so that no key stays down whichever way the block is left. Where a reset or an
    action fails, it raises LiveError and has to be reset before the next action.

    Args:
        scenario: what is built, of which materials.
        profile: the user's calibrated facts, with an arena marked.
        display: the game's window.
        keyboard: its keys.
        pointer: its buttons.
        clock: the time that holds and waits run on.
        read: takes a picture of the debug screen and reads it.

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
        read: Read,
    ) -> None:
        if len(scenario.materials) > len(profile.keys.hotbar):
            raise ProfileError(
                f"scenario {scenario.name} has {len(scenario.materials)} materials, the hotbar only "
                f"{len(profile.keys.hotbar)} slots: choose a scenario with fewer"
            )
        self._scenario = scenario
        self._profile = profile
        self._hands = Hands(display, keyboard, pointer, clock, profile.input)
        self._body = Body(profile, self._hands, read, clock)
        self._commands = reset_commands(profile, scenario.start, [material.block for material in scenario.materials])
        self._cell: Cell | None = None
        self._placed: set[Cell] = set()
        self._material = 0

    def __enter__(self) -> "LiveGame":
        self._hands.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._hands.__exit__(kind, error, traceback)

    def reset(self, material: int) -> Cell:
        """Clear the marked blocks, stand on the start cell, take the material in hand; place and view are read back."""
        self._cell = None
        # Where no debug screen is to be seen, nobody knows what a command would be typed into.
        self._body.check_screen()
        try:
            for command in self._commands:
                self._hands.type_command(self._profile.keys.chat, command)
            self._hands.tap(self._profile.keys.hotbar[material])
            self._body.arrive(self._scenario.start)
        finally:
            self._hands.release_all()
        self._placed.clear()
        self._material = material
        self._cell = self._scenario.start
        return self._cell

    def act(self, action: Action) -> Outcome:
        """Do an action on the screen; where the rules void both its move and its block, nothing is pressed."""
        if self._cell is None:
            raise LiveError("the game must be reset first: the last reset or action failed, or there was none")
        cell, self._cell = self._cell, None
        try:
            outcome = self._do(cell, action)
        finally:
            self._hands.release_all()
        self._cell = outcome.cell
        if outcome.placed is not None:
            self._placed.add(outcome.placed)
        return outcome

    def _do(self, cell: Cell, action: Action) -> Outcome:
        target = rules.moved(cell, action, self._placed)
        landing = rules.landing(target, action, self._placed)
        if target == cell and landing is None:
            return Outcome(self._body.stay_in(cell), None)
        seen = self._body.move_to(target)
        if landing is None:
            return Outcome(seen, None)
        block = self._scenario.materials[self._material].block
        return Outcome(seen, self._body.place(target, self._profile.shown_id(block)))
