import pytest

from sim.client.game.controls import Controls
from sim.client.game.debug_entries import GAME_DEFAULT, PERFORMANCE
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.options import GameOptions
from sim.client.game.realm import Player, Realm
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.world import VirtualWorld

SIZE = (427, 240)


class Played:
    """A game, its controls, and the clipboard that they use."""

    def __init__(
        self, version: str = "1.20.1", screen: ScreenName = "world", options: GameOptions | None = None
    ) -> None:
        realm = Realm(Edition(version), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5)))
        self.game = VirtualGame(realm, options=options)
        self.clipboard = "pasted"
        self.controls = Controls(self.game, lambda: self.clipboard, self.write)
        if screen != "world":
            self.game.open(screen)

    def write(self, text: str) -> None:
        self.clipboard = text

    def tap(self, *keys: str) -> None:
        """Press keys together, and release them the other way round."""
        for key in keys:
            self.controls.key(key, is_down=True)
        for key in reversed(keys):
            self.controls.key(key, is_down=False)

    def type(self, *characters: str) -> None:
        """Press the key of each character, and let its character come."""
        for character in characters:
            self.tap("space" if character == " " else character)
            self.controls.character(character)

    def click(self, name: ScreenName, label: str, now: float = 0.0) -> None:
        chosen = self.game.is_world_chosen
        buttons = menu(MenuState(name, is_chosen=chosen), self.game.edition, *SIZE).buttons
        button = next(each for each in buttons if each.label == label)
        self.click_at(round(button.middle[0]), round(button.middle[1]), now)

    def click_at(self, x: int, y: int, now: float = 0.0) -> None:
        self.controls.button("left", (x, y), SIZE, now, is_down=True)
        self.controls.button("left", (x, y), SIZE, now, is_down=False)

    def said(self) -> list[str]:
        return [line.text for line in self.game.chat.lines(self.game.ticks)]


def test_a_key_pressed_in_the_world_is_held_until_it_is_released() -> None:
    played = Played()
    played.controls.key("w", is_down=True)
    assert played.game.keys.is_held("forward")
    assert played.game.keys.physical == {"w"}
    played.controls.key("w", is_down=False)
    assert not played.game.keys.is_held("forward")
    assert played.game.keys.physical == set()


def test_f3_toggles_the_debug_screen_on_release_and_only_in_a_world() -> None:
    played = Played()
    played.controls.key("f3", is_down=True)
    assert played.game.has_f3
    played.controls.key("f3", is_down=False)
    assert not played.game.has_f3
    title = Played(screen="title")
    title.tap("f3")
    assert title.game.has_f3


def test_f3_pressed_on_another_screen_toggles_nothing() -> None:
    played = Played(screen="inventory")
    played.tap("f3")
    assert played.game.has_f3
    played.tap("esc")
    played.tap("f3")
    assert not played.game.has_f3


def test_f3_and_a_debug_letter_neither_toggles_the_screen_nor_presses_the_letters_key() -> None:
    played = Played()
    played.tap("f3", "d")
    assert played.game.has_f3
    assert not played.game.keys.presses("right")


def test_f3_and_a_movement_key_toggles_the_screen_and_presses_that_key() -> None:
    played = Played()
    played.tap("f3", "w")
    assert played.game.keys.presses("forward") == 1
    assert not played.game.has_f3


def test_f3_and_d_clears_the_chat() -> None:
    played = Played()
    played.game.chat.say("text", 0)
    played.tap("f3", "d")
    assert played.said() == []


@pytest.mark.parametrize(("version", "screen"), [("1.13.2", "pause"), ("1.14", "paused"), ("26.3", "paused")])
def test_f3_and_esc_pauses_without_a_menu_since_1_14(version: str, screen: ScreenName) -> None:
    played = Played(version)
    played.tap("f3", "esc")
    assert (played.game.screen, played.game.has_f3) == (screen, True)
    ticks = played.game.realm.player.feet
    played.game.tick()
    assert played.game.realm.player.feet == ticks
    played.tap("esc")
    assert str(played.game.screen) == "world"


@pytest.mark.parametrize(("version", "screen"), [("1.21.8", "world"), ("1.21.9", "debug_options")])
def test_f3_and_f6_opens_the_debug_options_since_1_21_9(version: str, screen: ScreenName) -> None:
    played = Played(version)
    played.tap("f3", "f6")
    assert played.game.screen == screen
    played.tap("esc")
    assert played.game.screen == ("pause" if screen == "world" else "world")


def test_clicks_on_the_debug_options_show_the_target_block() -> None:
    played = Played("26.1")
    played.game.do("default_profile")
    played.tap("f3", "f6")
    played.type(*"looking_x")
    played.tap("backspace")
    shown = played.game.view().menu
    assert (shown.searched, shown.choices[0]) == ("looking_", ("looking_at_block_state", "never"))
    button = next(each for each in menu(shown, played.game.edition, *SIZE).buttons if each.label == "In Overlay")
    played.click_at(round(button.middle[0]), round(button.middle[1]))
    assert played.game.debug_entries == {**GAME_DEFAULT, "looking_at_block_state": "inOverlay"}
    done = next(each for each in menu(shown, played.game.edition, *SIZE).buttons if each.label == "Done")
    played.click_at(round(done.middle[0]), round(done.middle[1]))
    assert str(played.game.screen) == "world"
    played.game.do("performance_profile")
    assert played.game.debug_entries == PERFORMANCE


@pytest.mark.parametrize("screen", ["world", "pause", "paused", "title"])
def test_o_opens_the_friends_since_26_2_and_closes_them(screen: ScreenName) -> None:
    old = Played("26.1", screen)
    old.type("o")
    assert old.game.screen == screen
    played = Played("26.2", screen)
    for key in ("o", "esc"):
        played.tap("o")
        assert played.game.screen == ("title_friends" if screen == "title" else "friends")
        assert played.game.is_in_world == (screen != "title")
        played.tap(key)
        assert played.game.screen == screen


@pytest.mark.parametrize("screen", ["chat", "inventory", "death", "worlds", "debug_options"])
def test_o_does_not_open_the_friends_over_other_screens(screen: ScreenName) -> None:
    played = Played("26.2", screen)
    played.tap("o")
    assert played.game.screen == screen


def test_a_click_beside_the_friends_closes_them_and_one_on_them_does_not() -> None:
    played = Played("26.2", "pause")
    played.tap("o")
    played.click_at(SIZE[0] // 2, SIZE[1] // 2)
    assert played.game.screen == "friends"
    played.click_at(5, SIZE[1] // 2)
    assert str(played.game.screen) == "pause"


def test_f3_and_p_switches_the_pause_without_focus() -> None:
    played = Played()
    played.tap("f3", "p")
    assert not played.controls.pauses_unfocused
    played.controls.stay_unfocused()
    assert str(played.game.screen) == "world"
    played.tap("f3", "p")
    assert played.said() == ["[Debug]: Pause on lost focus: enabled", "[Debug]: Pause on lost focus: disabled"]
    played.controls.stay_unfocused()
    assert played.game.screen == "pause"


def test_losing_the_focus_pauses_only_the_world() -> None:
    played = Played(screen="inventory")
    played.controls.stay_unfocused()
    assert played.game.screen == "inventory"


def test_f3_and_c_copies_the_position_since_1_13() -> None:
    played = Played()
    played.tap("f3", "c")
    assert played.clipboard == "/execute in minecraft:overworld run tp @s 0.50 64.00 0.50 0.00 0.00"
    assert played.said() == ["[Debug]: Copied location to clipboard"]
    old = Played("1.12.2")
    old.tap("f3", "c")
    assert old.clipboard == "pasted"


def test_f3_and_c_copies_nothing_with_reduced_debug_info() -> None:
    played = Played()
    played.game.realm.rules["reducedDebugInfo"] = "true"
    played.tap("f3", "c")
    assert played.clipboard == "pasted"


def test_f1_hides_the_hud_and_shows_it_again() -> None:
    played = Played()
    played.tap("f1")
    assert played.game.hides_hud
    played.tap("f1")
    assert not played.game.hides_hud


def test_the_mouse_turns_by_its_sensitivity() -> None:
    played = Played()
    played.controls.turn(100, -20)
    assert (played.game.realm.player.yaw, played.game.realm.player.pitch) == pytest.approx((15.0, -3.0))
    played.controls.turn(20, 40)
    assert (played.game.realm.player.yaw, played.game.realm.player.pitch) == pytest.approx((18.0, 3.0))


def test_a_lost_focus_releases_every_key() -> None:
    played = Played()
    played.controls.key("w", is_down=True)
    played.controls.lose_focus()
    assert not played.game.keys.is_held("forward")
    assert played.game.keys.physical == set()


@pytest.mark.parametrize(
    ("screen", "after"),
    [
        ("world", "pause"),
        ("pause", "world"),
        ("inventory", "world"),
        ("chat", "world"),
        ("worlds", "title"),
        ("death", "death"),
        ("title", "title"),
    ],
)
def test_esc_leads_from_each_screen_to_the_one_that_the_game_shows(screen: ScreenName, after: str) -> None:
    played = Played(screen=screen)
    played.tap("esc")
    assert played.game.screen == after


def test_e_closes_the_inventory_and_no_other_screen() -> None:
    played = Played(screen="inventory")
    played.tap("w")
    assert played.game.screen == "inventory"
    played.tap("e")
    assert str(played.game.screen) == "world"
    paused = Played(screen="pause")
    paused.tap("e")
    assert paused.game.screen == "pause"


def test_characters_are_typed_into_the_chat_and_keys_alone_type_nothing() -> None:
    played = Played(screen="chat")
    played.type("h", "~", " ", "x")
    for key in ("backspace", "f5", "left.shift", "z"):
        played.tap(key)
    assert played.game.chat.typed == "h~ "


def test_characters_are_dropped_while_the_chat_is_closed() -> None:
    played = Played()
    played.controls.character("x")
    played.game.open("chat")
    assert played.game.chat.typed == ""


def test_control_pastes_and_selects_but_types_no_letter() -> None:
    played = Played(screen="chat")
    played.type("a")
    played.controls.key("left.control", is_down=True)
    played.type("x")
    played.controls.key("left.control", is_down=False)
    assert played.game.chat.typed == "a"
    played.tap("left.control", "a")
    assert played.game.chat.is_selected
    played.tap("left.control", "v")
    assert played.game.chat.typed == "pasted"


def test_an_unfinished_line_comes_back_as_a_draft_since_1_21_9() -> None:
    for version, draft in (("1.21.8", ""), ("1.21.9", "/tp")):
        played = Played(version, "chat")
        played.type("/", "t", "p")
        played.game.die()
        played.game.do("respawn")
        played.tap("t")
        played.game.tick()
        assert (played.game.chat.typed, played.game.chat.is_draft) == (draft, bool(draft))


def test_a_line_comes_back_after_esc_only_with_the_option_for_drafts() -> None:
    for saves in (False, True):
        played = Played("26.1", "chat", GameOptions(save_chat_drafts=saves))
        played.type("h", "i")
        for _ in range(2):
            played.tap("esc")
            assert played.game.screen == "world"
            played.game.open("chat")
            assert played.game.chat.typed == ("hi" if saves else "")
        played.tap("enter")
        played.game.open("chat")
        assert played.game.chat.typed == ""


def test_the_command_key_brings_back_only_drafts_that_are_commands() -> None:
    for draft, typed in (("/tp", "/tp"), ("hi", "/")):
        played = Played("26.1", "chat")
        played.type(*draft)
        played.game.open("inventory")
        played.game.open("world")
        played.tap("/")
        played.game.tick()
        assert played.game.chat.typed == typed


@pytest.mark.parametrize(("version", "opens"), [("1.20.1", False), ("26.1", True)])
def test_a_hidden_chat_opens_from_26_1_on_and_sends_nothing(version: str, opens: bool) -> None:
    played = Played(version, options=GameOptions(chat_visibility=2))
    played.tap("t")
    played.game.tick()
    assert (played.game.screen == "chat") is opens
    played.game.open("chat")
    played.type("h")
    played.tap("enter")
    played.game.tick()
    assert played.said() == []
    assert played.game.view().chat == ()


def test_the_option_for_reduced_debug_info_reduces_the_screen_and_f3_c() -> None:
    played = Played(options=GameOptions(reduced_debug_info=True))
    played.tap("f3", "c")
    assert played.clipboard == "pasted"
    f3 = played.game.view().f3
    assert f3 is not None
    assert f3.reduced


def test_enter_sends_the_line_and_an_empty_one_is_not_sent() -> None:
    played = Played(screen="chat")
    played.type("h")
    played.tap("enter")
    assert played.game.screen == "world"
    played.game.tick()
    assert played.said() == ["<Player> h"]
    played.game.open("chat")
    played.type(" ")
    played.tap("enter")
    played.game.tick()
    assert played.said() == ["<Player> h"]


@pytest.mark.parametrize(("version", "after"), [("1.15.2", "worlds"), ("1.16", "loading")])
def test_enter_plays_the_chosen_world_since_1_16(version: str, after: str) -> None:
    played = Played(version, "worlds")
    played.tap("enter")
    assert played.game.screen == "worlds"
    played.game.is_world_chosen = True
    played.tap("esc2")
    assert played.game.screen == "worlds"
    played.tap("enter")
    assert played.game.screen == after


def test_enter_does_nothing_on_the_title() -> None:
    played = Played(screen="title")
    played.game.is_world_chosen = True
    played.tap("enter")
    assert played.game.screen == "title"


def test_a_mouse_button_in_the_world_counts_as_a_key_of_the_game() -> None:
    played = Played()
    played.controls.button("right", (0, 0), SIZE, 0.0, is_down=True)
    assert played.game.keys.is_held("use")
    assert played.game.keys.physical == {"right button"}
    played.controls.button("right", (0, 0), SIZE, 0.0, is_down=False)
    assert not played.game.keys.is_held("use")
    assert played.game.keys.physical == set()


def test_only_the_left_button_clicks_on_a_menu() -> None:
    played = Played(screen="pause")
    x, y = (round(part) for part in menu(MenuState("pause"), played.game.edition, *SIZE).buttons[0].middle)
    played.controls.button("right", (x, y), SIZE, 0.0, is_down=True)
    assert played.game.screen == "pause"
    played.controls.button("left", (x, y), SIZE, 0.0, is_down=True)
    assert str(played.game.screen) == "world"


def test_clicks_beside_buttons_and_on_an_inactive_one_do_nothing() -> None:
    played = Played(screen="pause")
    played.click_at(0, 0)
    assert played.game.screen == "pause"
    worlds = Played(screen="worlds")
    worlds.click("worlds", "Play Selected World")
    assert worlds.game.screen == "worlds"


ROW = menu(MenuState("worlds"), Edition("1.20.1"), *SIZE).buttons[1]


@pytest.mark.parametrize(("second", "after"), [(0.2, "loading"), (0.25, "worlds"), (0.4, "worlds")])
def test_a_world_is_entered_by_two_quick_clicks(second: float, after: str) -> None:
    played, (x, y) = Played(screen="worlds"), (round(part) for part in ROW.middle)
    played.click_at(x, y, 0.0)
    assert played.game.is_world_chosen
    played.click_at(x, y, second)
    assert played.game.screen == after


def test_a_click_elsewhere_and_one_on_a_world_are_not_a_double_click() -> None:
    played, (x, y) = Played(screen="worlds"), (round(part) for part in ROW.middle)
    played.click_at(0, 0, 0.0)
    played.click_at(x, y, 0.1)
    assert played.game.screen == "worlds"
