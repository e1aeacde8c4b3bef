from functools import partial

from sim.client.desktop.clock import VirtualClock


def test_what_is_due_happens_at_its_time_and_in_order() -> None:
    clock = VirtualClock(10.0)
    seen: list[tuple[str, float]] = []

    def note(name: str) -> None:
        seen.append((name, clock.now()))

    for name, at in (("late", 13.0), ("second", 12.0), ("first", 11.0), ("third", 12.0)):
        clock.call_at(at, partial(note, name))
    clock.sleep_until(12.5)
    assert seen == [("first", 11.0), ("second", 12.0), ("third", 12.0)]
    assert clock.now() == 12.5
    clock.sleep(0.5)
    assert seen[-1] == ("late", 13.0)


def test_an_event_may_plan_the_next_one_within_the_same_sleep() -> None:
    clock = VirtualClock(0.0)
    ticks: list[float] = []

    def tick() -> None:
        ticks.append(clock.now())
        clock.call_at(clock.now() + 1, tick)

    clock.call_at(0.5, tick)
    clock.sleep_until(3.0)
    assert ticks == [0.5, 1.5, 2.5]


def test_time_never_goes_back() -> None:
    clock = VirtualClock(5.0)
    happened: list[float] = []
    clock.call_at(1.0, lambda: happened.append(clock.now()))
    clock.sleep_until(2.0)
    assert clock.now() == 5.0
    assert happened == [5.0]
