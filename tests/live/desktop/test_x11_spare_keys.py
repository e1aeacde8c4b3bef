"""Spare keys of an X server: lent to characters, four to a key, and given back."""

import sys

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("keys of an X server", allow_module_level=True)

from mc_nested.live.desktop.x11_spare_keys import STATES, SpareKeys
from tests.live.desktop.fake_x_display import FIRST, FakeXDisplay

SPARE = FIRST + 100
LETTERS = [ord(letter) for letter in "abcdeF"]


def test_each_character_has_its_own_key_and_state() -> None:
    display = FakeXDisplay(spare=3)
    lent = SpareKeys(display).lend(LETTERS)  # type: ignore[arg-type]  # as much of a display as is used
    assert list(lent) == LETTERS
    assert list(lent.values()) == [
        *((SPARE, state) for state in STATES),
        (SPARE + 1, STATES[0]),
        (SPARE + 1, STATES[1]),
    ]


def test_free_places_on_a_lent_key_repeat_its_last_character() -> None:
    display = FakeXDisplay(spare=3)
    SpareKeys(display).lend(LETTERS)  # type: ignore[arg-type]
    assert display.changed == {SPARE: LETTERS[:4], SPARE + 1: [ord("e"), ord("F"), ord("F"), ord("F")]}


def test_characters_without_a_spare_key_left_are_left_out() -> None:
    display = FakeXDisplay(spare=1)
    assert list(SpareKeys(display).lend(LETTERS)) == LETTERS[:4]  # type: ignore[arg-type]


def test_the_keys_are_changed_together_and_again_after_a_pause(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    display = FakeXDisplay(spare=3)
    seen: list[tuple[int, int]] = []
    monkeypatch.setattr("time.sleep", lambda _: seen.append((display.changes, display.syncs)))
    SpareKeys(display).lend(LETTERS)  # type: ignore[arg-type]
    assert seen == [(2, 1)], "two keys, with one round trip to the server behind them"
    assert (display.changes, display.syncs) == (4, 2)


def test_lending_no_characters_changes_no_key_and_does_not_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    display = FakeXDisplay(spare=3)
    monkeypatch.setattr("time.sleep", lambda _: pytest.fail("it waited"))
    assert SpareKeys(display).lend([]) == {}  # type: ignore[arg-type]
    assert display.changes == 0


def test_spare_keys_type_nothing_after_they_are_given_back() -> None:
    display = FakeXDisplay(spare=3)
    before = list(display.rows)
    keys = SpareKeys(display)  # type: ignore[arg-type]
    keys.lend(LETTERS)
    assert display.rows != before
    keys.close()
    assert display.rows == before
    changes = display.changes
    keys.close()
    assert display.changes == changes
