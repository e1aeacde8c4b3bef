"""LiveGame: the Game that is played in a window, by reading the debug screen and timing keys."""

from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError, NotInFrontError, ProfileError, StoppedError, TakenOverError
from mc_nested.live.action_log import ActionLog
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.stops import Takeover
from mc_nested.live.journal import Fact
from mc_nested.live.menus.chat import Chat
from mc_nested.live.menus.click_points import ClickPoints
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.menus.reset import reset_commands, restore_world, teleport_command
from mc_nested.live.model.timing import PERSON_LOOK_S
from mc_nested.live.motion.move_and_place import Body
from mc_nested.live.motion.overlap_plan import Leg
from mc_nested.live.motion.person import Person
from mc_nested.live.profile.tables import Profile, WorldTable
from mc_nested.live.vision.chat_region import LastFrames
from mc_nested.live.vision.game_screen import seen_gui_scale

RESET_TRIES = 4
"""Attempts at a reset before its error is raised."""

HANDS_OFF_S = 1.0
"""Seconds that a player who has the game gets to take their hands off before a reset presses anything."""

TRIES = 3
"""Attempts at an episode: a mishap in the running game may end all but the last."""

Played = TypeVar("Played")


def started_over(episode: Callable[[], Played], say: Callable[[str], None], tries: int = TRIES) -> Played:
    """Play the episode and return what it returns; start over after a mishap, and raise the last try's LiveError.

    ``say`` is told of each mishap. What a person did on purpose is none: StoppedError and NotInFrontError are raised at
    once.
    """
    for tries_left in reversed(range(tries)):
        try:
            return episode()
        except (StoppedError, NotInFrontError):  # noqa: PERF203 - each try may fail
            raise
        except LiveError as error:
            if not tries_left:
                raise
            say(f"{error}; the episode starts over")
    raise AssertionError("the last try returned or raised")


def check_fits(scenario: Scenario, profile: Profile, profile_name: str | None = None) -> None:
    """Raise ProfileError, one line, if a profile can't play a scenario: too many materials, or too small an arena.

    A smaller scenario is played in the arena's near left corner. ``profile_name`` is for the step to repeat.
    """
    if len(scenario.materials) > len(profile.keys.hotbar):
        raise ProfileError(
            f"scenario {scenario.name} has {len(scenario.materials)} materials, the hotbar only "
            f"{len(profile.keys.hotbar)} slots: choose a scenario with fewer"
        )
    size = profile.marked_arena().size
    if scenario.size > size:
        named = f" --profile {profile_name}" if profile_name else ""
        marked = " --mark-only" if profile.world else ""
        raise ProfileError(
            f"scenario {scenario.name} needs {scenario.size} x {scenario.size} cells, and the profile's arena has "
            f"{size} x {size}: run mc-nested calibrate arena --size {scenario.size}{marked}{named}"
        )


class LiveGame:
    """A scenario's arena in a running game.

    Use it as a context manager: then no key stays down, however the block is left. An action that fails raises
    LiveError, and the game must be reset before the next one. A reset recovers to the world by itself, and raises
    LiveError where that fails too.

    Args:
        scenario: what is built, of which materials.
        profile: the user's calibrated facts, with an arena marked.
        connection: the running game.
        points: where menus are clicked if their labels aren't found.
        evidence: the folder for the last frames, written when a reset fails for good.
        restore: makes a world's folder the same as its template, for games without commands.
        overlaps: whether the next action's walk begins before an action is confirmed, where the next one is known.
        takeover: how the run lets a player take over; the controller is what switches over.

    Raises:
        ProfileError: the profile has no arena, or ``check_fits`` refuses it.
    """

    resumable = None
    """A window's episode can't be saved half-way."""

    def __init__(
        self,
        scenario: Scenario,
        profile: Profile,
        connection: GameConnection,
        *,
        points: ClickPoints | None = None,
        evidence: Path | None = None,
        restore: Callable[[Path, Path], None] = restore_world,
        overlaps: bool = True,
        takeover: Takeover | None = None,
    ) -> None:
        check_fits(scenario, profile)
        self._scenario = scenario
        self._profile = profile
        self._arena = profile.marked_arena()
        self.connection = connection
        self._controller = connection.controller
        self._clock = connection.devices.clock
        self._journal = connection.journal
        self._body = Body(profile, connection)
        takeover = takeover or Takeover()
        self._person = Person(profile, connection, scenario.size, takeover)
        self._say = takeover.say
        self._chat = Chat(profile, connection)
        self._recovery = Recovery(profile, connection, points)
        self._last_frames = LastFrames(connection.devices.display, evidence, lambda: seen_gui_scale(connection.screen))
        self.log = ActionLog(self._body.effort)
        self._commands = reset_commands(profile, scenario.start, [material.block for material in scenario.materials])
        self._cell: Cell | None = None
        self._placed: dict[Cell, str] = {}
        self._others: frozenset[Cell] = frozenset()
        self._material = 0
        self._restore = restore
        self._overlaps = overlaps
        self._announced: Following | None = None

    def __enter__(self) -> "LiveGame":
        self.connection.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self.connection.__exit__()

    def reset(self, material: int) -> Cell:
        """Clear the marked blocks, stand on the start cell, select the material; position and view are read back.

        If the last action left another screen open, that is left first. A player who has taken over is told to take the
        hands off, and has the game again afterwards; one who takes over meanwhile has to give it back.
        """
        self._cell, self._announced = None, None
        self.log.pauses()
        self._controller.release_all()
        self._body.forget()
        self._person.forget()
        self._journal.note("resets", material=material, **self._known())
        with self._hands_off():
            self._reset(material)
        self._placed.clear()
        self._material = material
        self._cell = self._scenario.start
        self._journal.note("stands", cell=self._cell)
        return self._cell

    def _reset(self, material: int) -> None:
        for tries_left in reversed(range(RESET_TRIES)):
            try:
                self.connection.check_single_player()
                self._controller.release_again()
                if self._recovery.recover():
                    self.log.recoveries += 1
                self._prepare(material)
                break
            except StoppedError:
                raise
            except LiveError as error:
                self._journal.note("fails", problem=str(error))
                self._last_frames.take()
                if not tries_left:
                    raise self._with_evidence(error) from None
                self.log.failed_resets += 1
                if isinstance(error, TakenOverError):
                    self._wait_for_the_game()
            finally:
                self._controller.release_all()

    @contextmanager
    def _hands_off(self) -> Iterator[None]:
        """Borrow the game for the block from a player who has taken over."""
        if self._controller.take_back() or not self._controller.has_yielded:
            yield
            return
        with self._controller.borrowed():
            self._say("The episode is over: hands off while the arena is reset.")
            self._clock.sleep_until(self._clock.now() + HANDS_OFF_S)
            yield
        if not self._controller.take_back() and self._controller.has_yielded:
            self._say("The arena is reset: it is yours again.")

    def _wait_for_the_game(self) -> None:
        """Wait until a player who has taken over during a reset gives the game back."""
        key = self._profile.keys.takeover
        self._say(f"The arena is only half reset: close the chat, give back with {key}, and it is done again.")
        while self._controller.has_yielded and not self._controller.take_back():
            self._person.check_running()
            self._clock.sleep_until(self._clock.now() + PERSON_LOOK_S)

    def see_others(self, placed: Collection[Cell], cells: Collection[Cell]) -> None:
        """Take note of other builders of this arena: where all blocks stand now, and which cells the others are in."""
        self._placed, self._others = dict.fromkeys(placed, self._shown_id), frozenset(cells)

    def go_on_from(
        self,
        placed: Collection[Cell],
        pressed: Iterable[str],
        tick_phase: tuple[float, float, float],
        chat: Iterable[tuple[float, int]],
    ) -> None:
        """Begin the next reset with what another LiveGame knew there, as the journal's note of its reset says."""
        self._placed = dict.fromkeys(placed, "")  # a reset asks where they are, not what
        self._controller.go_on_after(pressed)
        self._body.tick_phase.go_on_from(tick_phase)
        self.connection.chat_lines.go_on_from(chat)

    def _known(self) -> dict[str, Fact]:
        return {
            "placed": tuple(sorted(self._placed)),
            "pressed": self._controller.pressed_before,
            "tick_phase": self._body.tick_phase.state,
            "chat": self.connection.chat_lines.state,
        }

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        """Perform an action on the screen. Where the rules void both its move and its block, nothing is pressed.

        Before it, the hotbar key of another material is pressed. No screen says what is in the hand: that it was taken
        is confirmed by the next block, which must be of it. With ``following`` its key may be down on return; it goes
        up in time, also if nothing more is asked for. While a player has taken over, their next action is waited for
        instead; once they have given back, the agent goes on from where they stand.
        """
        announced, self._announced = self._announced, None
        if self._cell is None:
            raise LiveError("the game must be reset first: the last reset or action failed, or there was none")
        cell, self._cell = self._cell, None
        if announced not in (None, (action, material)):
            self._controller.release_all()
            was, now = (" and ".join(map(str, each)) for each in (announced, (action, material)))
            raise ValueError(f"{was} was announced as the action that follows, not {now}: reset the game")
        told: dict[str, Fact] = {} if material is None else {"material": material}
        if following is not None and self._overlaps:
            told["following"] = (int(following[0]), following[1])
        self._journal.note("acts", action=int(action), cell=cell, **told)
        began = self._clock.now()
        self.log.begins(began, self._controller.held_s(began))
        self._controller.is_attended = True
        try:
            outcome = self._outcome(cell, action, material, following if self._overlaps else None)
        except BaseException as error:
            self._controller.release_all()
            if isinstance(error, LiveError):
                self.log.failed_actions += 1
                self._journal.note("fails", problem=str(error))
            raise
        if not self._body.is_under_way:
            self._controller.release_all()
        self._controller.is_attended = False
        ended = self._clock.now()
        instead = {} if outcome.instead is None else {"instead": int(outcome.instead)}
        if instead:
            self.log.pauses()
        else:
            self.log.ends(ended, self._controller.held_s(ended))
        self._journal.note("done", cell=outcome.cell, placed=outcome.placed, seconds=ended - began, **instead)
        self._cell = outcome.cell
        self._announced = following if self._body.is_under_way else None
        if outcome.placed is not None:
            self._placed[outcome.placed] = self._shown_id
        return outcome

    def _with_evidence(self, error: LiveError) -> LiveError:
        """Return the error with a note of where the last frames were saved, if there are any."""
        files = self._last_frames.save()
        return type(error)(f"{error}; what was seen last: {files[-1]}") if files else error

    def _outcome(self, cell: Cell, action: Action, material: int | None, following: Following | None) -> Outcome:
        """Perform an action; or, while a player has taken over, return what they did, also of what was under way."""
        while True:
            try:
                if not (self._controller.has_yielded or self._person.is_followed):
                    if material is not None:
                        self._take_in_hand(material)
                    return self._perform(cell, action, following)
                self._material = self._material if material is None else material
                outcome = self._person.follow(cell, self._placed, self._shown_id)
                if outcome is not None:
                    return outcome
                self._stand_again(cell)
            except TakenOverError:  # noqa: PERF203 - each try may be interrupted
                self._person.check_running()
                self._body.forget()

    def _stand_again(self, cell: Cell) -> None:
        """Go on after a player: stand in a cell and look ahead, the material in hand."""
        self._body.forget()
        if self._profile.world is None:
            self._send(teleport_command(self._arena, cell, self._profile.body.pitch))
            self._body.arrive(cell)
        self._body.take(self._profile.keys.hotbar[self._material])
        self._person.forget()

    def _perform(self, cell: Cell, action: Action, following: Following | None) -> Outcome:
        solid = self._placed.keys() | self._others
        leg = self._leg(cell, action, solid)
        if not (leg.sign or leg.places):
            return Outcome(self._body.stay_in(cell), None)
        then = solid | {rules.front_of(leg.cell)} if leg.places else solid
        after = following and self._leg(leg.cell, following[0], then)
        after = after if after and after.sign else None  # one that stays is no walk
        return Outcome(leg.cell, self._body.go_on(leg, after, self._placed, self._shown_id))

    def _leg(self, cell: Cell, action: Action, solid: Collection[Cell]) -> Leg:
        """Return an action as the body does it."""
        target = rules.moved(cell, action, solid, self._scenario.size)
        axis, sign = rules.axis_of(action)
        places = rules.landing(target, action, solid, self._scenario.size) is not None
        return Leg(target, axis, sign if target != cell else 0, places)

    @property
    def _shown_id(self) -> str:
        """The id of the material in hand, as the debug screen shows it."""
        return self._profile.shown_id(self._scenario.materials[self._material].block)

    def _take_in_hand(self, material: int) -> None:
        if material != self._material:
            self._body.take(self._profile.keys.hotbar[material])
            self._material = material

    def _prepare(self, material: int) -> None:
        if self._profile.world is not None:
            self._restore_world(self._profile.world)
        else:
            self._send_reset_commands()
        self._body.take(self._profile.keys.hotbar[material])
        self._body.arrive(self._scenario.start)
        self._body.check_ground_is_named(self._profile.game.version)

    def _restore_world(self, world: WorldTable) -> None:
        """Leave the world, restore its folder, and enter it again: for games without commands."""
        self._recovery.leave_world()
        self._restore(Path(world.folder).expanduser(), Path(world.template).expanduser())
        self._recovery.recover()

    def _send_reset_commands(self) -> None:
        clear, *others = self._commands
        self._clear_and_confirm(clear)
        for command in others:
            self._send(command)

    def _clear_and_confirm(self, clear: str) -> None:
        """Clear the marked blocks; if a block was placed, face it and see it go."""
        if not self._placed:
            self._send(clear)
            return
        # The agent once stood behind each block, and a block there would sort before this one: so that cell is free.
        right, forward = min(self._placed)
        behind = right, forward - 1
        self._send(teleport_command(self._arena, behind, self._profile.body.pitch))
        self._body.arrive(behind)
        self._send(clear)
        self._body.check_floor_ahead()

    def _send(self, command: str) -> None:
        # Without a debug screen, the command could be typed into anything.
        self._body.check_screen()
        self._chat.send(command)
