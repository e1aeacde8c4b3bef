import pytest

from mc_nested.live.model.reading import Target
from sim.client.game.debug_entries import GAME_DEFAULT, TUTORIAL, Status
from sim.client.game.edition import Edition
from sim.client.game.f3_text import both_columns
from sim.client.game.game import VirtualGame
from sim.client.game.options import GameOptions
from sim.client.game.realm import Mode, Player, Realm, Stack
from sim.client.game.screens import MenuState
from sim.client.game.world import VirtualWorld

FRONT = (0, 64, 1)


def game(
    mode: Mode = "creative",
    z: float = 0.5,
    pitch: float = 65.0,
    version: str = "1.20.1",
    options: GameOptions | None = None,
) -> VirtualGame:
    """Return a game whose player is in the middle of block 0, 0, looks south at the floor, and holds two stones."""
    player = Player((0.5, 64.0, z), 0.0, pitch, mode=mode)
    player.hotbar[0] = Stack("stone", 2)
    return VirtualGame(Realm(Edition(version), VirtualWorld(64, "dirt"), player), options=options)


def ticks(played: VirtualGame, count: int) -> None:
    for _ in range(count):
        played.tick()


def click(played: VirtualGame) -> None:
    played.keys.press("right button")
    played.keys.release("right button")


def screen_of(played: VirtualGame) -> str:
    return played.screen


def built(played: VirtualGame) -> set[tuple[int, int, int]]:
    return set(played.realm.world.built())


def test_a_click_places_one_block_at_the_next_tick() -> None:
    played = game()
    click(played)
    assert built(played) == set()
    ticks(played, 10)
    assert built(played) == {FRONT}


def test_a_click_on_the_near_face_of_the_placed_block_places_nothing() -> None:
    played = game()
    for _ in range(3):
        click(played)
        ticks(played, 2)
    assert built(played) == {FRONT}


def test_clicks_of_one_tick_have_the_same_target() -> None:
    played = game(pitch=50.0)
    for _ in range(3):
        click(played)
    ticks(played, 1)
    assert built(played) == {FRONT}
    click(played)
    ticks(played, 1)
    assert built(played) == {FRONT, (0, 65, 1)}


def test_a_held_button_places_again_every_four_ticks() -> None:
    played = game(pitch=49.0)
    played.keys.press("right button")
    counts = []
    for _ in range(9):
        played.tick()
        counts.append(len(built(played)))
    assert counts == [1, 1, 1, 1, 2, 2, 2, 2, 2]


def test_a_toggled_use_key_places_every_four_ticks_until_the_next_click() -> None:
    played = game(pitch=49.0, options=GameOptions(toggle_use=True))
    click(played)
    counts = []
    for _ in range(5):
        played.tick()
        counts.append(len(built(played)))
    assert counts == [1, 1, 1, 1, 2]
    click(played)
    ticks(played, 20)
    assert len(built(played)) == 2


def test_a_held_left_button_breaks_a_block_every_five_ticks() -> None:
    for options in (None, GameOptions(toggle_attack=True)):
        played = game(pitch=90.0, options=options)
        played.keys.press("left button")
        if options:
            played.keys.release("left button")
        counts = []
        for _ in range(7):
            # The floor breaks below the player, who falls meanwhile: what is looked at goes down with them.
            played.tick()
            counts.append(len(built(played)))
        assert counts == [1, 1, 1, 1, 1, 2, 2]


@pytest.mark.parametrize(("z", "pitch", "count"), [(0.69, 70.0, 1), (0.71, 70.0, 0), (0.5, 80.0, 0)])
def test_a_block_that_would_touch_the_player_is_refused(z: float, pitch: float, count: int) -> None:
    played = game(z=z, pitch=pitch)
    click(played)
    ticks(played, 1)
    assert len(built(played)) == count


@pytest.mark.parametrize(("mode", "count"), [("creative", 1), ("survival", 0)])
def test_creative_reaches_half_a_block_farther(mode: Mode, count: int) -> None:
    played = game(mode, pitch=20.0)
    click(played)
    ticks(played, 1)
    assert len(built(played)) == count


def test_a_stack_runs_out_in_survival_mode() -> None:
    played = game("survival")
    for _ in range(3):
        click(played)
        ticks(played, 1)
        played.realm.player.look(played.realm.player.yaw + 90.0, 65.0)
    assert len(built(played)) == 2
    assert played.realm.player.hotbar[0] is None


def test_two_clicks_in_one_tick_use_up_one_block_in_survival_and_none_in_creative() -> None:
    for mode, left in (("survival", 1), ("creative", 2)):
        played = game("survival" if mode == "survival" else "creative")
        click(played)
        click(played)
        ticks(played, 1)
        assert played.realm.player.hotbar[0] == Stack("stone", left)


def test_a_number_key_selects_its_slot_and_an_empty_hand_places_nothing() -> None:
    played = game()
    played.keys.press("5")
    click(played)
    ticks(played, 1)
    assert played.realm.player.slot == 4
    assert built(played) == set()


def test_a_refused_placing_changes_nothing_and_the_next_one_is_not_refused() -> None:
    played = game()
    played.refuse_next()
    click(played)
    ticks(played, 1)
    assert built(played) == set()
    click(played)
    ticks(played, 1)
    assert built(played) == {FRONT}


def test_a_ghost_block_disappears_after_two_ticks() -> None:
    played = game()
    played.expect_ghost()
    click(played)
    counts = []
    for _ in range(4):
        played.tick()
        counts.append(len(built(played)))
    assert counts == [1, 1, 0, 0]


def test_the_chat_opens_at_the_next_tick_and_takes_the_keys() -> None:
    played = game()
    played.keys.press("w")
    played.keys.press("t")
    assert screen_of(played) == "world"
    ticks(played, 1)
    assert screen_of(played) == "chat"
    assert not played.keys.is_held("forward")


def test_held_keys_but_no_held_buttons_count_again_when_a_screen_closes() -> None:
    played = game()
    played.keys.physical |= {"w", "right button"}
    played.open("inventory")
    played.open("world")
    assert played.keys.is_held("forward")
    assert not played.keys.is_held("use")


def test_the_pause_menu_stops_the_world_and_the_inventory_does_not() -> None:
    for screen, moves in (("pause", False), ("inventory", True)):
        played = game()
        played.knock((0.3, 0.0, 0.0))
        played.open("pause" if screen == "pause" else "inventory")
        ticks(played, 3)
        assert (played.realm.player.feet[0] > 0.5) is moves


def test_a_death_empties_the_hotbar_and_respawning_leads_to_the_spawn_point() -> None:
    played = game()
    played.realm.spawn = (5.5, 64.0, 5.5)
    played.die()
    assert screen_of(played) == "death"
    assert not played.view().menu.is_ready
    ticks(played, 20)
    assert played.view().menu.is_ready
    played.do("respawn")
    assert (played.screen, played.realm.player.feet) == ("world", (5.5, 64.0, 5.5))
    assert played.realm.player.hotbar == [None] * 9


def test_game_rules_can_keep_the_hotbar_and_skip_the_death_screen() -> None:
    played = game()
    played.realm.rules |= {"keepInventory": "true", "doImmediateRespawn": "true"}
    played.die()
    assert screen_of(played) == "world"
    assert played.realm.player.hotbar[0] == Stack("stone", 2)


def test_a_player_who_falls_out_of_the_world_dies() -> None:
    played = game()
    played.realm.player.go_to((0.5, 1.0, 0.5))
    played.realm.world.fill((0, -10, 0), (0, 63, 0), "air")
    ticks(played, 60)
    assert screen_of(played) == "death"


def test_buttons_lead_from_a_world_to_the_title_and_back() -> None:
    played = game()
    played.do("leave")
    ticks(played, 19)
    assert screen_of(played) == "saving"
    ticks(played, 1)
    assert screen_of(played) == "title"
    played.do("to_worlds")
    assert not played.view().menu.is_chosen
    played.do("select_world")
    assert played.view().menu.is_chosen
    played.do("enter_selected")
    ticks(played, 40)
    assert (played.screen, played.realm.player.hotbar[0]) == ("world", Stack("stone", 2))


@pytest.mark.parametrize(("version", "pitch", "is_named"), [("1.12.2", 10.0, False), ("1.20.1", 10.0, True)])
def test_far_blocks_are_named_from_1_13_on(version: str, pitch: float, is_named: bool) -> None:
    f3 = game(version=version, pitch=pitch).view().f3
    assert f3 is not None
    assert (f3.target is not None) is is_named


def test_the_view_does_not_change_while_the_player_stands_still() -> None:
    played = game()
    ticks(played, 3)
    before = played.view()
    ticks(played, 100)
    assert played.view() == before


def test_messages_fade_after_nine_seconds_and_are_gone_after_ten() -> None:
    played = game()
    played.send("hello")
    ticks(played, 1)
    assert [(line.text, line.opacity) for line in played.view().chat] == [("<Player> hello", 8)]
    ticks(played, 179)
    assert played.view().chat[0].opacity == 8
    ticks(played, 10)
    assert 0 < played.view().chat[0].opacity < 8
    ticks(played, 11)
    assert played.view().chat == ()
    played.open("chat")
    assert len(played.view().chat) == 1


@pytest.mark.parametrize(("mode", "is_broken"), [("creative", True), ("survival", False)])
def test_a_left_click_breaks_the_target_in_creative_mode(mode: Mode, is_broken: bool) -> None:
    played = game(mode)
    played.keys.press("left button")
    played.tick()
    assert played.realm.world.built() == ({(0, 63, 1): "air"} if is_broken else {})


def test_q_drops_the_stack_in_hand() -> None:
    played = game()
    played.keys.press("q")
    played.tick()
    assert played.realm.player.hotbar[0] is None


def test_a_jump_leaves_the_ground_and_lands_again() -> None:
    played = game()
    played.keys.press("space")
    played.tick()
    assert played.realm.player.feet[1] == pytest.approx(64.42)
    played.keys.release("space")
    ticks(played, 20)
    assert played.realm.player.feet == (0.5, 64.0, 0.5)


def test_the_debug_screen_describes_the_player_and_the_target() -> None:
    played = game()
    screen = played.view().f3
    assert screen is not None
    assert (screen.xyz, screen.yaw, screen.pitch) == ((0.5, 64.0, 0.5), 0.0, 65.0)
    assert screen.target == Target((0, 63, 1), "minecraft:dirt")
    played.realm.player.look(190.0, 65.0)
    turned = played.view().f3
    assert turned is not None
    assert turned.yaw == -170.0
    played.hide_f3()
    assert played.view().f3 is None


def test_a_push_adds_to_the_velocity_and_lifts_the_player() -> None:
    played = game()
    played.knock((0.4, 0.36, -0.2))
    assert not played.realm.player.on_ground
    played.tick()
    x, y, z = played.realm.player.feet
    assert (x, y, z) == pytest.approx((0.9, 64.0 + 0.36 - 0.0784, 0.3))


def test_a_lost_connection_saves_the_world_and_shows_its_reason() -> None:
    saved: list[Realm] = []
    realm = game().realm
    played = VirtualGame(realm, on_leave=saved.append)
    played.disconnect("Timed out")
    assert saved == [realm]
    assert played.view().menu == MenuState("disconnected", True, False, "Timed out")
    assert played.view().hotbar == ()


def test_tags_of_the_target_are_shown_since_1_13() -> None:
    for version, tags in (("1.12.2", ()), ("1.13", ("minecraft:planks",))):
        played = game(version=version)
        played.realm.world.put((0, 63, 1), "oak_planks")
        screen = played.view().f3
        assert screen is not None
        assert screen.tags == tags


def test_a_debug_screen_with_the_default_entries_names_no_target() -> None:
    realm = game(version="1.21.9").realm
    for entries, is_named in ((GAME_DEFAULT, False), (TUTORIAL, True)):
        screen = VirtualGame(realm, debug_entries=entries).view().f3
        assert screen is not None
        assert ("looking_at_block" in screen.shown) is is_named


def test_entries_that_are_always_on_are_shown_without_f3() -> None:
    entries: dict[str, Status] = {"player_position": "alwaysOn", "fps": "inOverlay"}
    played = VirtualGame(game(version="1.21.9").realm, debug_entries=entries)
    with_f3 = played.view().f3
    played.hide_f3()
    without = played.view().f3
    assert with_f3 is not None
    assert without is not None
    assert (with_f3.shown, with_f3.has_f3) == (("fps", "player_position"), True)
    assert (without.shown, without.has_f3, without.has_axes) == (("player_position",), False, False)
    old = VirtualGame(game(version="1.20.1").realm, debug_entries=entries)
    old.hide_f3()
    assert old.view().f3 is None


@pytest.mark.parametrize(("version", "is_seen"), [("1.21.8", False), ("1.21.9", True)])
def test_a_menu_shows_the_debug_screen_despite_a_hidden_hud_since_1_21_9(version: str, is_seen: bool) -> None:
    played = game(version=version)
    played.hides_hud = True
    assert played.view().f3 is None
    played.open("pause")
    assert (played.view().f3 is not None) is is_seen


def test_the_target_blocks_box_of_26_4_comes_back_at_the_end() -> None:
    entries: dict[str, Status] = dict.fromkeys(
        ("fps", "looking_at_block_state", "player_section_position"), "inOverlay"
    )
    played = VirtualGame(game(version="26.4", pitch=65.0).realm, debug_entries=entries)

    def columns() -> list[list[str]]:
        ticks(played, 2)
        screen = played.view().f3
        assert screen is not None
        return [[part[0].text for part in column] for column in both_columns(screen)]

    left = ["60 fps T: 60 (fifo) @60Hz", "Position"]
    assert columns() == [left, ["Looking At Block", "Help"]]
    played.realm.player.look(0.0, -90.0)
    assert columns() == [left, ["Help"]]
    played.realm.player.look(0.0, 65.0)
    assert columns() == [left, ["Help", "Looking At Block"]]
    played.hide_f3()
    assert played.view().f3 is None
    played.has_f3 = True
    assert columns() == [left, ["Looking At Block", "Help"]]


def test_the_debug_screen_names_the_target_block_of_the_tick_before() -> None:
    played = game(pitch=65.0)
    played.tick()
    played.realm.player.feet = (0.5, 64.0, 1.5)
    before = played.view().f3
    played.tick()
    after = played.view().f3
    assert before is not None
    assert after is not None
    assert (before.target, after.target) == (
        Target((0, 63, 1), "minecraft:dirt"),
        Target((0, 63, 2), "minecraft:dirt"),
    )
