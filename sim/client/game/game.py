"""The game itself, a tick at a time: moving, placing, screens, chat. It knows no pixels and no latencies."""

from collections import deque
from collections.abc import Callable, Mapping

from mc_nested.live.model.reading import Target
from sim.client.game import physics
from sim.client.game.chat import ChatLine, TypedLine, VirtualChat
from sim.client.game.commands import chat_line
from sim.client.game.debug_entries import GAME_DEFAULT, PERFORMANCE, TUTORIAL, DebugEntries, shown_entries
from sim.client.game.debug_options import choices
from sim.client.game.edition import Edition
from sim.client.game.entry_boxes import stood_after
from sim.client.game.f3_screen import BY_ENTRIES, F3Screen, Stood, tags_of
from sim.client.game.keys import HOTBAR, GameKeys
from sim.client.game.options import HIDDEN, GameOptions
from sim.client.game.physics import Gaits
from sim.client.game.realm import SLOTS, Realm
from sim.client.game.screens import DEATH_WAIT, IN_WORLD, PAUSING, MenuState, ScreenName
from sim.client.game.view import Eye, Sight, View
from sim.client.game.widgets import Effect, EntryChange
from sim.client.game.world import AIR, Hit, block_of, cast_ray

REPEAT_TICKS = 4
"""While the right button is held, the game places again every so many ticks (FACTS: Standing, looking, placing)."""

BREAK_TICKS = 5
"""While the left button is held, the game breaks another block every so many ticks."""

SIGHT = 20.0
"""Blocks within which the debug screen names a block; before 1.13 only within reach (FACTS: The F3 debug screen)."""

_REACH = {"creative": 5.0, "survival": 4.5}
_LOADING_TICKS = {"loading": 40, "saving": 20}
_PROFILES: Mapping[Effect, DebugEntries] = {"default_profile": GAME_DEFAULT, "performance_profile": PERFORMANCE}
_LEADS_TO: Mapping[Effect, ScreenName] = {
    "resume": "world",
    "to_title": "title",
    "to_worlds": "worlds",
    "to_servers": "servers",
    "enter_world": "loading",
    "enter_selected": "loading",
}
_VOID = 64
"""Blocks below the floor at which a falling player dies."""


class VirtualGame:
    """A game that one player plays.

    Args:
        realm: the world, changed as it is played.
        keys: the key bindings and their state.
        ground: the floor that the player walks on.
        debug_entries: what the debug screen shows, from 1.21.9 on.
        options: what its options.txt says.
        on_leave: called with the realm when the world is saved.
        on_enter: returns the realm when the world is entered again.
    """

    def __init__(
        self,
        realm: Realm,
        *,
        keys: GameKeys | None = None,
        ground: physics.Ground = physics.STONE,
        debug_entries: DebugEntries = TUTORIAL,
        options: GameOptions | None = None,
        on_leave: Callable[[Realm], None] = lambda _: None,
        on_enter: Callable[[Realm], Realm] = lambda realm: realm,
    ) -> None:
        self.realm = realm
        self.options = options or GameOptions()
        self.keys = keys or GameKeys()
        self.keys.toggled = self.options.toggled
        self._ground = ground
        self.chat = VirtualChat()
        self.screen: ScreenName = "world"
        self._behind: ScreenName = "world"
        self.ticks = 0
        self.has_f3 = True
        self.hides_hud = False
        self.pointer = (-1, -1)
        self.is_world_chosen = False
        self.reason = ""
        self.notices: tuple[str, ...] = ()
        self.debug_entries, self.searched = debug_entries, ""
        self._on_leave, self._on_enter = on_leave, on_enter
        self._since = 0
        self._use_delay = self._attack_delay = 0
        self._sent: deque[str] = deque()
        self._ghosts: list[tuple[int, tuple[int, int, int]]] = []
        self._refusals_to_come, self._ghosts_to_come = 0, 0
        self._gaits = Gaits(realm.edition)
        self._is_at_wall = False
        self._rested_at: tuple[int, physics.Vector] | None = None
        self._looked: tuple[tuple[object, ...], Hit | None] = ((), None)
        self._looked_on_f3: tuple[tuple[object, ...], Hit | None] = ((), None)
        self._shown_f3: tuple[tuple[object, ...], F3Screen | None] = ((), None)
        self._stood: Stood = ((), ())
        self._before = self._aim()

    @property
    def edition(self) -> Edition:
        """The game's version."""
        return self.realm.edition

    @property
    def is_in_world(self) -> bool:
        """Whether a world is being played, whatever screen is over it."""
        return self.screen in IN_WORLD

    @property
    def is_info_reduced(self) -> bool:
        """Whether the option or the rule leaves the position out of the debug screen."""
        return self.options.reduced_debug_info or self.realm.rule("reducedDebugInfo", "reduced_debug_info", False)

    def open(self, screen: ScreenName, typed: str = "") -> None:
        """Show a screen, the chat with ``typed`` in it; over the world, it takes the keys.

        A line that is broken off by this is kept as a draft, from 1.21.9 on (FACTS: The chat's line).
        """
        self.chat.close(keeps_draft=self.edition.since(1, 21, 9))
        if screen == "world":
            self.keys.forget()
            self.keys.read_again()
        else:
            self.keys.leave_world()
        if screen == "chat":
            self.chat.open(typed)
        self.searched = ""
        self.screen, self._since, self.is_world_chosen = screen, self.ticks, False

    def leave_chat(self) -> None:
        """Return from the chat to the world; its line is kept only where the options say so."""
        self.chat.close(keeps_draft=self.edition.since(1, 21, 9) and self.options.save_chat_drafts)
        self.open("world")

    def open_friends(self) -> None:
        """Show the friends over the screen that is open."""
        self._behind = self.screen
        self.open("title_friends" if self.screen == "title" else "friends")

    def close_friends(self) -> None:
        """Show the screen that the friends were opened over."""
        self.open(self._behind)

    def send(self, line: str) -> None:
        """Send a line of the chat; the server takes it at the next tick, unless the options hide the chat."""
        if self.options.chat_visibility != HIDDEN:
            self._sent.append(line)

    def do(self, effect: Effect | EntryChange) -> None:
        """Carry out the effect of a button."""
        if isinstance(effect, EntryChange):
            self.debug_entries = {**self.debug_entries, effect.entry: effect.status}
        elif effect in _PROFILES:
            self.debug_entries = _PROFILES[effect]
        elif effect in _LEADS_TO:
            self.open(_LEADS_TO[effect])
        elif effect == "leave":
            self._on_leave(self.realm)
            self.open("saving")
        elif effect == "respawn":
            self._respawn()
        elif effect == "behind":
            self.close_friends()
        elif effect == "select_world":
            self.is_world_chosen = True

    def die(self) -> None:
        """Kill the player, who loses the hotbar unless the rules keep it."""
        realm = self.realm
        if not realm.rule("keepInventory", "keep_inventory", False):
            realm.player.hotbar[:] = [None] * SLOTS
        if realm.rule("doImmediateRespawn", "immediate_respawn", False):
            self._respawn()
        else:
            self.open("death")

    def disconnect(self, reason: str) -> None:
        """Lose the connection; what was built so far is saved."""
        self._on_leave(self.realm)
        self.reason = reason
        self.open("disconnected")

    def knock(self, velocity: physics.Vector) -> None:
        """Push the player, in blocks a tick."""
        player = self.realm.player
        x, y, z = (own + part for own, part in zip(player.velocity, velocity, strict=True))
        player.velocity, player.on_ground = (x, y, z), False

    def hide_f3(self) -> None:
        """Switch the debug screen off."""
        self.has_f3 = False

    def refuse_next(self) -> None:
        """Refuse one more block that the player places."""
        self._refusals_to_come += 1

    def expect_ghost(self) -> None:
        """Place one more block as a ghost: the server takes it back two ticks later."""
        self._ghosts_to_come += 1

    def tick(self) -> None:
        """Advance by a twentieth of a second."""
        self.ticks += 1
        wait = _LOADING_TICKS.get(self.screen)
        if wait is not None and self.ticks - self._since >= wait:
            self._finish_loading()
        if not self.is_in_world or self.screen in PAUSING:
            return
        for due, block in [ghost for ghost in self._ghosts if ghost[0] <= self.ticks]:
            self.realm.world.put(block, AIR)
            self._ghosts.remove((due, block))
        while self._sent:
            for answer in chat_line.run(self._sent.popleft(), self.realm):
                self.chat.say(answer.text, self.ticks, is_error=answer.is_error)
        if self.screen == "world":
            self._handle_keys()
        self._before = self._aim()
        if self.screen != "death":
            self._move()
            if self.realm.player.feet[1] < self.realm.world.floor - _VOID:
                self.die()

    def view(
        self, fps: int = 60, size: tuple[int, int] = (854, 480), scale: int = 2, *, is_drawn: bool = False
    ) -> View:
        """Return what the game shows now.

        Its debug screen names ``fps`` frames a second and a window of ``size`` pixels. ``scale`` is that of
        the debug screen. ``is_drawn`` adds the world as the player sees it.
        """
        player = self.realm.player
        is_ready = self.screen != "death" or self.ticks - self._since >= DEATH_WAIT
        state = MenuState(self.screen, is_ready, self.is_world_chosen, self.reason)
        if self.screen == "debug_options":
            shown = choices(self.debug_entries, self.edition, self.searched)
            state = state._replace(choices=shown, searched=self.searched)
        if not self.is_in_world:
            return View(state, (0, 0, 0), pointer=self.pointer, notices=self.notices)
        pointer = (-1, -1) if self.screen == "world" else self.pointer
        scene, sight = block_of(player.feet), self.sight() if is_drawn else None
        if self.hides_hud:
            # From 1.21.9 on a screen that is open shows the debug text all the same.
            f3 = self._f3(fps, size, scale) if self.screen != "world" and self.edition.since(1, 21, 9) else None
            return View(state, scene, f3, pointer=pointer, notices=self.notices, sight=sight)
        return View(
            state,
            scene,
            self._f3(fps, size, scale),
            tuple(player.hotbar),
            player.slot,
            self._messages(),
            self._typed(),
            player.mode == "creative",
            pointer,
            self.notices,
            sight,
        )

    def _messages(self) -> tuple[ChatLine, ...]:
        options = self.options
        return () if options.chat_visibility == HIDDEN else self.chat.lines(self.ticks, options.message_ground)

    def _typed(self) -> TypedLine | None:
        chat = self.chat
        return None if chat.typed is None else TypedLine(chat.typed, chat.is_draft, self.options.typed_ground)

    def sight(self) -> Sight:
        """Return the world as the player sees it now."""
        player, world = self.realm.player, self.realm.world
        hit = self.target_block(self.reach())
        stack = player.hotbar[player.slot]
        return Sight(
            Eye(self.realm.eye(), player.yaw, player.pitch),
            world.seen(),
            world.floor,
            world.floor_block,
            hit.block if hit else None,
            stack.block if stack else None,
        )

    def target_block(self, reach: float) -> Hit | None:
        """Return the block that the player looks at, if it is within ``reach`` blocks."""
        player, world = self.realm.player, self.realm.world
        now = (player.feet, player.yaw, player.pitch, player.is_sneaking, world.revision)
        if self._looked[0] != now:
            self._looked = (now, cast_ray(self.realm.eye(), player.yaw, player.pitch, SIGHT, world.is_solid))
        hit = self._looked[1]
        return hit if hit is not None and hit.distance <= reach else None

    def target_on_f3(self) -> Hit | None:
        """Return the block that the debug screen names.

        It is seen from where the eyes were a tick ago (FACTS: The F3 debug screen).
        """
        eye, yaw, pitch = self._before
        world, reach = self.realm.world, SIGHT if self.edition.since(1, 13) else self.reach()
        now = (self._before, world.revision)
        if self._looked_on_f3[0] != now:
            self._looked_on_f3 = (now, cast_ray(eye, yaw, pitch, SIGHT, world.is_solid))
        hit = self._looked_on_f3[1]
        return hit if hit is not None and hit.distance <= reach else None

    def _aim(self) -> tuple[physics.Vector, float, float]:
        """Return the eyes' position and the view, in blocks and degrees."""
        player = self.realm.player
        return self.realm.eye(), player.yaw, player.pitch

    def reach(self) -> float:
        """Return how far from the eye blocks can be placed, in blocks."""
        return _REACH[self.realm.player.mode]

    def _finish_loading(self) -> None:
        if self.screen == "saving":
            self.open("title")
            return
        self.realm = self._on_enter(self.realm)
        self.chat = VirtualChat(self.chat.draft)
        self.open("world")

    def _respawn(self) -> None:
        self.realm.player.go_to(self.realm.spawn)
        self.realm.player.look(0.0, 0.0)
        self.open("world")

    def _handle_keys(self) -> None:
        """Handle keys in order: the hotbar, attacks, uses, a held use, the inventory; the chat last."""
        keys, player = self.keys, self.realm.player
        self._use_delay, self._attack_delay = max(0, self._use_delay - 1), max(0, self._attack_delay - 1)
        for slot, binding in enumerate(HOTBAR):
            if keys.presses(binding):
                player.slot = slot
        if keys.presses("drop"):
            player.hotbar[player.slot] = None
        self._handle_clicks()
        if keys.presses("inventory"):
            self.open("inventory")
            return
        # A hidden chat opens only from 26.1 on (FACTS: The chat's line).
        opens = self.options.chat_visibility != HIDDEN or self.edition.since(26, 1)
        for binding, typed in (("chat", ""), ("command", "/")):
            if keys.presses(binding) and opens:
                self.open("chat", typed)
                return

    def _handle_clicks(self) -> None:
        keys = self.keys
        attacks, uses = keys.presses("attack"), keys.presses("use")
        if not (attacks or uses or keys.is_held("use") or keys.is_held("attack")):
            return
        target = self.target_block(self.reach())
        if attacks or (keys.is_held("attack") and not self._attack_delay):
            self._attack_delay = BREAK_TICKS
            if target is not None and self.realm.player.mode == "creative":
                self.realm.world.put(target.block, AIR)
        for _ in range(uses):
            self._use(target)
        if keys.is_held("use") and not self._use_delay:
            self._use(target)

    def _use(self, target: Hit | None) -> None:
        """Right-click: place the block in hand, unless the game refuses (FACTS: Standing, looking, placing)."""
        self._use_delay = REPEAT_TICKS
        player, world = self.realm.player, self.realm.world
        stack = player.hotbar[player.slot]
        if target is None or stack is None or world.block_at(target.before) != AIR:
            return
        height = self.realm.size()[0]
        if any(physics.overlaps(feet, height, target.before) for feet in (player.feet, *self.realm.others())):
            return
        if self._refusals_to_come:
            self._refusals_to_come -= 1
            return
        world.put(target.before, stack.block)
        player.use_one()
        if self._ghosts_to_come:
            self._ghosts_to_come -= 1
            self._ghosts.append((self.ticks + 2, target.before))

    def _move(self) -> None:
        keys, player, world = self.keys, self.realm.player, self.realm.world
        player.is_sneaking = keys.is_held("sneak")
        forward = keys.is_held("forward") - keys.is_held("back")
        left = keys.is_held("left") - keys.is_held("right")
        gait = self._gaits.tick(
            is_forward=forward > 0,
            sneaks=player.is_sneaking,
            may_sprint=player.on_ground and not self._is_at_wall,
        )
        is_pushed = forward or left or keys.is_held("jump")
        rests = player.on_ground and max(abs(player.velocity[0]), abs(player.velocity[2])) < physics.STANDSTILL
        if rests and not is_pushed and self._rested_at == (world.revision, player.feet):
            return
        if keys.is_held("jump") and player.on_ground:
            player.velocity = (player.velocity[0], physics.JUMP, player.velocity[2])
        push = physics.wish(forward, left, gait, player.yaw)
        before, height = player.feet, self.realm.size()[0]
        player.feet, player.velocity, player.on_ground = physics.step(
            before,
            player.velocity,
            push,
            height,
            world.is_solid,
            on_ground=player.on_ground,
            ground=self._ground.under(gait),
            sneaks=player.is_sneaking,
        )
        self._stop_at_others(before, height)
        self._is_at_wall = bool(is_pushed) and not (player.velocity[0] or player.velocity[2])
        # A player who stands still on the ground stays there until a key or the world changes.
        self._rested_at = (world.revision, before) if player.on_ground and player.feet == before else None

    def _stop_at_others(self, before: physics.Vector, height: float) -> None:
        """Take back the part of the step that led into another player, and the speed along it."""
        player = self.realm.player
        feet = physics.kept_apart(before, player.feet, self.realm.others(), height)
        if feet != player.feet:
            east, up, south = player.velocity
            stays_x, stays_z = feet[0] != player.feet[0], feet[2] != player.feet[2]
            player.velocity = (0.0 if stays_x else east, up, 0.0 if stays_z else south)
            player.feet = feet

    def _f3(self, fps: int, size: tuple[int, int], scale: int) -> F3Screen | None:
        realm, player = self.realm, self.realm.player
        is_reduced = self.is_info_reduced
        entries: tuple[str, ...] | None = None
        if self.edition.layout in BY_ENTRIES:
            entries = shown_entries(self.debug_entries, self.edition, has_f3=self.has_f3, is_reduced=is_reduced)
        if not (self.has_f3 if entries is None else entries):
            self._shown_f3, self._stood = ((), None), ((), ())
            return None
        hit = self.target_on_f3()
        about = (player.feet, player.yaw, player.pitch, hit, realm.world.revision, fps, size, scale)
        now = (*about, is_reduced, entries, self.has_f3)
        if self._shown_f3[0] != now:
            self._shown_f3 = now, self._new_f3(hit, fps, size, scale, entries, is_reduced=is_reduced)
        return self._shown_f3[1]

    def _new_f3(
        self,
        hit: Hit | None,
        fps: int,
        size: tuple[int, int],
        scale: int,
        entries: tuple[str, ...] | None,
        *,
        is_reduced: bool,
    ) -> F3Screen:
        realm = self.realm
        player, edition = realm.player, self.edition
        name = realm.world.block_at(hit.block) if hit else ""
        before = self._shown_f3[1]
        if before is not None and before.entries != entries:
            self._stood = ((), ())
        screen = F3Screen(
            edition.layout,
            scale,
            player.feet,
            (player.yaw + 180.0) % 360.0 - 180.0,
            player.pitch,
            target=Target(hit.block, edition.shown_id(name)) if hit else None,
            tags=tags_of(name, edition),
            reduced=is_reduced,
            version=edition.version,
            fps=fps,
            size=size,
            entries=entries,
            has_f3=self.has_f3,
            stood=self._stood,
        )
        if edition.layout == "26.4":
            self._stood = stood_after(screen, screen.rows)
        return screen
