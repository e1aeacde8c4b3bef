from sim.client.game.keys import BINDINGS, SIDES_SWAPPED, GameKeys


def test_a_pressed_key_is_held_and_its_press_counted_once() -> None:
    keys = GameKeys()
    keys.press("W")
    assert keys.is_held("forward")
    assert (keys.presses("forward"), keys.presses("forward")) == (1, 0)
    keys.release("w")
    assert not keys.is_held("forward")


def test_presses_of_different_actions_are_counted_apart() -> None:
    keys = GameKeys()
    for key in ("right button", "right button", "1"):
        keys.press(key)
    assert (keys.presses("use"), keys.presses("hotbar.0"), keys.presses("attack")) == (2, 1, 0)


def test_a_key_without_an_action_does_nothing() -> None:
    keys = GameKeys()
    keys.press("z")
    keys.release("z")
    assert not any(keys.is_held(action) or keys.presses(action) for action in BINDINGS.values())


def test_forgotten_keys_are_neither_held_nor_pressed() -> None:
    keys = GameKeys()
    keys.press("w")
    keys.forget()
    assert not keys.is_held("forward")
    assert keys.presses("forward") == 0


def test_keys_that_are_down_count_again_but_buttons_and_unbound_keys_do_not() -> None:
    keys = GameKeys()
    keys.physical |= {"w", "right button", "z"}
    keys.read_again()
    assert keys.is_held("forward")
    assert not keys.is_held("use")
    assert keys.presses("forward") == 0


def test_the_stand_ins_left_and_right_keys_are_swapped() -> None:
    keys = GameKeys(SIDES_SWAPPED)
    keys.press("a")
    keys.press("w")
    assert keys.is_held("right")
    assert keys.is_held("forward")
    keys.release("a")
    keys.press("d")
    assert keys.is_held("left")
    assert not keys.is_held("right")


def test_a_press_starts_a_toggled_action_and_the_next_press_ends_it() -> None:
    keys = GameKeys()
    keys.toggled = frozenset({"use"})
    for is_held in (True, False, True):
        keys.press("right button")
        keys.release("right button")
        assert keys.is_held("use") is is_held
    assert keys.presses("use") == 3


def test_opening_a_screen_ends_actions_toggled_by_a_button_but_not_by_a_key() -> None:
    keys = GameKeys()
    keys.toggled = frozenset({"use", "attack", "sneak"})
    keys.physical.add("left.shift")
    for key in ("right button", "left button", "left.shift", "w"):
        keys.press(key)
    keys.forget()
    assert [keys.is_held(action) for action in ("use", "attack", "sneak", "forward")] == [True, True, True, False]
    keys.leave_world()
    assert [keys.is_held(action) for action in ("use", "attack", "sneak")] == [False, False, True]
    keys.press("left.shift")
    keys.read_again()
    assert not keys.is_held("sneak")
