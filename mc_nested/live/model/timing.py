"""Seconds: the usual latencies, and how often the screen is looked at, an interval for each kind of awaited change."""

from mc_nested.live.model.kinematics import TICK_S

CAPTURE_LATENCY_S = 0.028
"""From a tick until its step is on the screen, on average: half a frame, and 10 to 30 ms for the picture."""

INPUT_LATENCY_S = 0.0125
"""From a press until the game has it, on average: 5 to 20 ms."""

FRAME_S = 1 / 60
"""While the agent moves: a frame of the game, so that no wait is much longer than it must be."""

HALF_FRAME_S = FRAME_S / 2
"""While a walk is recorded, and while a block is awaited: two looks a frame, so that a step is seen within a frame of
being drawn."""

THIRD_FRAME_S = FRAME_S / 3
"""While an action waits for a step: seen a few milliseconds later, the next press may be felt a whole tick later."""

EARLY_LOOK_S = FRAME_S
"""How long before a step is seen on average looks for it begin: latencies differ from step to step by a frame or so."""

SAME_FRAME_S = 0.005
"""After a look: another one within this time would see the same frame."""

TYPING_LOOK_S = 0.02
"""While typing and waiting for answers: about a frame of the game, and less than half a tick."""

KEY_LOOK_S = TICK_S
"""While the effect of a key or an overdue release is awaited: the game takes keys once a tick."""

MENU_LOOK_S = 0.1
"""In menus: the time from moving the mouse until the button under it is drawn highlighted."""

PERSON_LOOK_S = 0.25
"""While a person acts: a few frames of the game, so that a position seen twice is one where the player stands."""


def surely_seen_after(capture_latency_s: float) -> float:
    """Return the seconds after a tick when its step is surely on the screen, and the next isn't (FACTS: Latencies).

    A step is seen ``capture_latency_s`` after its tick on average, and the next one a tick later: so in the middle.
    """
    return capture_latency_s + TICK_S / 2
