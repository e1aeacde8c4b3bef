"""Recovery: from any screen to the world in bounded time, never from a server's world to one's own.

Leaving a screen: the button with its label, else its point, else nothing at all.
"""

import numpy as np
import pytest

from mc_nested.errors import LiveError, NotInFrontError, StoppedError
from mc_nested.live.menus.click_points import ClickPoints, record_point
from mc_nested.live.menus.recovery import EFFECT_S, FRONT_PATIENCE_S, PATIENCE_S, UNKNOWN_S, Recovery
from mc_nested.live.menus.screens import ScreenName, menu_name
from mc_nested.live.profile.tables import GameVersion, KeysTable, Profile, WorldTable
from tests.live.menus.fake_menus import BUTTONS, PROBLEM, FakeMenus, connection_of

SERVER = "Minecraft 1.20.1 - Multiplayer (3rd-party Server)"


def recovery_in(menus: FakeMenus, profile: Profile | None = None) -> Recovery:
    return Recovery(profile or Profile(), connection_of(menus))


def test_recovery_presses_nothing_in_the_world() -> None:
    menus = FakeMenus()
    assert recovery_in(menus).recover() == ()
    assert menus.pressed == []
    assert menus.clock.now() == 100.0


@pytest.mark.parametrize(
    ("shown", "passed"),
    [
        ("chat", ("chat",)),
        ("pause", ("pause",)),
        ("death", ("death",)),
        ("title", ("title", "worlds")),
        ("worlds", ("worlds",)),
        ("disconnected", ("disconnected", "servers", "title", "worlds")),
        ("servers", ("servers", "title", "worlds")),
    ],
)
def test_recovery_leads_back_from_every_known_screen_and_returns_the_screens_passed(
    shown: str, passed: tuple[str, ...]
) -> None:
    menus = FakeMenus(shown)
    assert recovery_in(menus).recover() == passed
    assert menus.shown == "world"


def test_recovery_looks_for_the_effect_of_a_click_after_0_3_s() -> None:
    menus = FakeMenus("pause")
    recovery_in(menus).recover()
    # The mouse is moved for a tick, pressed for the 0.08 s of a click, and then comes the effect.
    assert menus.clock.now() == pytest.approx(100.0 + 0.05 + 0.08 + EFFECT_S)


def test_an_unknown_screen_gets_the_debug_key_and_then_esc_each_after_a_while() -> None:
    menus = FakeMenus("inventory")
    assert recovery_in(menus, Profile(keys=KeysTable(debug="f4"))).recover() == ("unknown",)
    assert menus.pressed == ["f4", "esc"]
    waited = menus.clock.now() - 100.0
    assert 2 * UNKNOWN_S < waited < 2 * UNKNOWN_S + 6 * EFFECT_S


def test_a_debug_screen_that_is_off_is_switched_on() -> None:
    menus = FakeMenus(has_debug=False)
    recovery_in(menus).recover()
    assert menus.pressed == ["f3"]
    assert menus.has_debug


def test_an_unknown_screen_that_closes_by_itself_gets_no_key() -> None:
    class Loading(FakeMenus):
        """Shows the world after the fifth look."""

        def is_in_front(self) -> bool:
            self.shown = "world" if self.looks >= 5 else "loading"
            return True

    menus = Loading()
    assert recovery_in(menus).recover() == ("unknown",)
    assert menus.pressed == []


def test_recovery_starts_over_with_the_debug_key_on_an_unknown_screen_after_a_known_one() -> None:
    class Changing(FakeMenus):
        """Unknown until the debug key was pressed, then the pause menu once, then unknown for good."""

        def is_in_front(self) -> bool:
            if self.pressed == ["f3"]:
                self.shown = "pause"
            elif self.pressed:
                self.shown = "inventory" if self.pressed[-1] != "esc" else self.shown
            return True

    menus = Changing("inventory")
    assert recovery_in(menus).recover() == ("unknown", "pause", "unknown")
    assert menus.pressed == ["f3", (427, 100), "f3", "esc"]


def test_recovery_that_fails_in_time_names_the_screen_and_the_readers_problem() -> None:
    menus = FakeMenus("death", greyed={"Respawn"})
    with pytest.raises(LiveError, match=rf"not reached in 60 s, the screen is death \({PROBLEM}\)"):
        recovery_in(menus).recover()
    assert PATIENCE_S <= menus.clock.now() - 100.0 < PATIENCE_S + 2 * EFFECT_S


def test_another_window_in_front_is_waited_for() -> None:
    menus = FakeMenus("pause", front_from=110.0)
    recovery_in(menus).recover()
    assert menus.pressed == [(427, 100)]
    assert menus.clock.now() >= 110.0


def test_another_window_that_stays_in_front_is_an_error_and_nothing_is_pressed() -> None:
    menus = FakeMenus("pause", front_from=1000.0)
    with pytest.raises(NotInFrontError, match="not by a click"):
        recovery_in(menus).recover()
    assert menus.pressed == []
    assert FRONT_PATIENCE_S <= menus.clock.now() - 100.0 < FRONT_PATIENCE_S + 2 * EFFECT_S


@pytest.mark.parametrize("shown", ["title", "worlds", "servers", "disconnected"])
def test_recovery_from_a_server_presses_nothing_on_screens_outside_the_world(shown: str) -> None:
    menus = FakeMenus(shown, window_title=SERVER)
    with pytest.raises(LiveError, match=f"the server was left, the screen is {shown}"):
        recovery_in(menus).recover()
    assert menus.pressed == []


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        (SERVER, "Minecraft 1.20.1 - Singleplayer", "was a server's, and is your own now"),
        ("Minecraft 1.20.1 - Singleplayer", SERVER, "was your own, and is a server's now"),
    ],
)
def test_recovery_refuses_a_servers_world_after_an_own_one_and_the_reverse(
    before: str, after: str, message: str
) -> None:
    menus = FakeMenus(window_title=before)
    recovery = recovery_in(menus)
    menus.window_title = after
    with pytest.raises(LiveError, match=message):
        recovery.recover()


class Torn(FakeMenus):
    """The first picture of the hotbar is torn."""

    def shows_world(self) -> bool:
        self.looks_at_hotbar = getattr(self, "looks_at_hotbar", 0) + 1
        return self.looks_at_hotbar > 1 and super().shows_world()


def test_recovery_presses_nothing_after_a_single_torn_picture() -> None:
    menus = Torn()
    assert recovery_in(menus).recover() == ()
    assert menus.pressed == []
    assert menus.clock.now() - 100.0 < EFFECT_S


class Hidden(FakeMenus):
    """The world's hotbar is never seen as the game draws it."""

    def shows_world(self) -> bool:
        return False


def test_recovery_that_never_sees_the_hotbar_says_so_soon() -> None:
    menus = Hidden()
    with pytest.raises(LiveError, match=r"the hotbar isn't seen .*: take off a resource pack"):
        recovery_in(menus).recover()
    assert menus.pressed == ["esc", (427, 100)]
    assert menus.clock.now() - 100.0 < 5 * EFFECT_S


@pytest.mark.parametrize("shown", ["world", "chat", "pause", "death"])
def test_leave_world_ends_on_the_title_screen(shown: str) -> None:
    menus = FakeMenus(shown)
    recovery = recovery_in(menus)
    recovery.leave_world()
    assert menus.shown == "title"
    assert recovery.screen_name() == "title"
    assert menus.pressed[-1] == (427, 200)


def test_leave_world_refuses_to_leave_a_servers_world() -> None:
    menus = FakeMenus(window_title=SERVER)
    with pytest.raises(LiveError, match="is not left, since nothing leads back"):
        recovery_in(menus).leave_world()
    assert menus.pressed == []


def test_leave_world_gives_up_on_an_unknown_screen_without_pressing_a_key() -> None:
    menus = FakeMenus("inventory")
    with pytest.raises(LiveError, match="title screen was not reached, the screen is unknown"):
        recovery_in(menus).leave_world()
    assert menus.pressed == []
    assert PATIENCE_S <= menus.clock.now() - 100.0 < PATIENCE_S + 2 * EFFECT_S


def test_the_panic_key_ends_the_wait_for_the_front() -> None:
    menus = FakeMenus(front_from=1000.0)
    connection = connection_of(menus)
    recovery = Recovery(Profile(), connection)
    connection.controller.stop("the panic key was pressed")
    with pytest.raises(StoppedError, match="the panic key was pressed"):
        recovery.recover()
    assert menus.clock.now() - 100.0 < 2 * EFFECT_S


OWN_WORLD = Profile(world=WorldTable(folder="~/saves/arena", template="~/template", name="Arena"))


def navigator_in(menus: FakeMenus, profile: Profile | None = None, points: ClickPoints | None = None) -> Recovery:
    return Recovery(profile or Profile(), connection_of(menus), points or {})


def point_in(menus: FakeMenus, name: str, at: tuple[int, int] = (200, 60)) -> ClickPoints:
    """Return a point recorded on the picture that is shown now."""
    menus.frame = np.random.default_rng(1).integers(0, 256, (480, 854, 3), np.uint8)
    return {name: record_point(name, menus.frame, at, menus.scale)}


@pytest.mark.parametrize(
    ("name", "label", "after"),
    [
        ("pause", "Back to Game", "world"),
        ("death", "Respawn", "world"),
        ("disconnected", "Back to Server List", "servers"),
        ("title", "Singleplayer", "worlds"),
    ],
)
def test_a_screen_is_left_by_its_button(name: ScreenName, label: str, after: str) -> None:
    menus = FakeMenus(name)
    navigator_in(menus).leave(name)
    assert menus.pressed == [BUTTONS[name][label]]
    assert menus.shown == after


def test_the_chat_is_left_by_esc() -> None:
    menus = FakeMenus("chat")
    navigator_in(menus).leave("chat")
    assert (menus.pressed, menus.shown) == (["esc"], "world")


def test_save_and_quit_leads_from_the_pause_menu_to_the_title() -> None:
    menus = FakeMenus("pause")
    navigator_in(menus).leave_world()
    assert (menus.pressed, menus.shown) == ([(427, 200)], "title")


def test_a_greyed_button_is_not_clicked() -> None:
    menus = FakeMenus("death", greyed={"Respawn"})
    navigator_in(menus).leave("death")
    assert menus.pressed == []


def test_a_button_whose_label_is_unread_is_clicked_at_its_point() -> None:
    menus = FakeMenus("pause", labels=set())
    navigator_in(menus, points=point_in(menus, "back_to_game")).leave("pause")
    assert menus.pressed == [(200, 60)]


def test_a_button_whose_label_is_read_is_clicked_there_and_not_at_its_point() -> None:
    menus = FakeMenus("pause")
    navigator_in(menus, points=point_in(menus, "back_to_game")).leave("pause")
    assert menus.pressed == [BUTTONS["pause"]["Back to Game"]]


def test_a_button_without_a_read_label_or_point_is_not_clicked() -> None:
    menus = FakeMenus("disconnected", labels=set())
    navigator_in(menus, points=point_in(menus, "singleplayer")).leave("disconnected")
    assert menus.pressed == []


def test_a_pause_menu_with_a_covered_first_button_is_left_by_esc() -> None:
    menus = FakeMenus("pause", labels={"Save and Quit to Title"})
    assert menu_name(menus) == "pause"
    navigator_in(menus).leave("pause")
    assert (menus.pressed, menus.shown) == (["esc"], "world")


@pytest.mark.parametrize(("version", "y"), [("1.20.1", 132), ("1.12.2", 100)])
def test_the_first_world_is_chosen_and_played_if_the_profile_names_none(version: str, y: int) -> None:
    # 854 pixels at GUI scale 2 have their middle at 213: (213 - 119 + 60) * 2 across, (48 or 32, + 18) * 2 down.
    menus = FakeMenus("worlds")
    navigator = navigator_in(menus, Profile(game=GameVersion(version=version)))
    navigator.leave("worlds")
    assert (menus.pressed, menus.shown) == ([(308, y)], "worlds")
    navigator.leave("worlds")
    assert (menus.pressed[1:], menus.shown) == ([(300, 420)], "world")
    menus.shown = "worlds"
    navigator.leave("worlds")
    assert menus.pressed[2:] == [(308, y)]


def test_the_first_worlds_row_is_found_at_another_gui_scale() -> None:
    # 854 pixels at GUI scale 4 are 214 wide, rounded up, with their middle at 107: (107 - 119 + 60) * 4, (48 + 18) * 4.
    menus = FakeMenus("worlds", scale=4)
    navigator_in(menus).leave("worlds")
    assert menus.pressed == [(192, 264)]


def test_the_world_that_the_profile_names_is_chosen_by_its_name() -> None:
    menus = FakeMenus("worlds", world_names={"Arena": (250, 300)})
    navigator = navigator_in(menus, OWN_WORLD)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == [(250, 300), (300, 420)]


def test_nothing_is_clicked_if_the_profiles_world_is_not_in_the_list() -> None:
    menus = FakeMenus("worlds")
    points = point_in(menus, "world")
    navigator = navigator_in(menus, OWN_WORLD, points)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == []


def test_a_world_is_chosen_again_while_its_play_button_is_greyed() -> None:
    menus = FakeMenus("worlds", greyed={"Play Selected World"})
    navigator = navigator_in(menus)
    navigator.leave("worlds")
    navigator.leave("worlds")
    assert menus.pressed == [(308, 132), (308, 132)]


def test_a_list_of_worlds_without_readable_labels_is_clicked_at_the_worlds_point() -> None:
    menus = FakeMenus("worlds", labels=set())
    navigator_in(menus, points=point_in(menus, "world", (400, 90))).leave("worlds")
    assert menus.pressed == [(400, 90)]


def test_a_readable_list_of_worlds_is_clicked_at_its_first_row_and_not_at_the_point() -> None:
    menus = FakeMenus("worlds")
    navigator_in(menus, points=point_in(menus, "world", (400, 90))).leave("worlds")
    assert menus.pressed == [(308, 132)]
