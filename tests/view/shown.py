"""Statuses for tests, and a screen as its text."""

import re
from html import unescape

from mc_nested.view.status import FORMAT, ActionSeen, ArenaSeen, Learning, ReadingSeen, Standing, Status
from mc_nested.view.words import StatusShown

COLUMN, LINE = 12.2, re.compile(r"line-(\d+)\)")
CELL = re.compile(r'<text class="[^"]*" x="([\d.]+)" y="[\d.]+" textLength="[\d.]+" clip-path="([^"]*)">(.*?)</text>')

SMALL = ArenaSeen(
    size=4,
    design=((1, 1), (2, 1), (2, 2)),
    stands=(Standing(1, 1, 1), Standing(3, 3, 1)),
    agents=(Standing(0, 0, 1),),
)

LEARNING = Learning(
    episodes=12,
    episodes_at_most=41,
    score=18.0,
    best=24.0,
    optimum=26.0,
    scores=(2.0, 6.0, 10.0, 13.0, 18.0),
    exploring="probing, 9 of 16 cells known",
    game_minutes_left=5.5,
)

LIVE = Status(
    format=FORMAT,
    at=1_000_000_100.0,
    what="train",
    title="corner, nested agent, preset model-based, in the running game",
    doing="moves back and places a block (B+D), from (1, 2)",
    detail="holds s for 4 ticks",
    mood="plays",
    since=1_000_000_099.6,
    arena=SMALL,
    reading=ReadingSeen(position=(10.5, 64.0, -7.5), yaw=0.0, pitch=45.0, target="minecraft:stone at 10 64 -6"),
    actions=(ActionSeen("F", (1, 1), None, 0.298), ActionSeen("R+D", (2, 1), (2, 2), 0.412)),
    learning=LEARNING,
    lines=("Switch to the game now with Alt+Tab.",),
)


def shown(status: Status = LIVE, *, after: float = 0.0) -> StatusShown:
    """Return a run that goes on, so many seconds later."""
    now = status.at + after
    return StatusShown(status.model_copy(update={"at": now}), now)


def screen_text(svg: str) -> str:
    """Return a screenshot of Textual's as the text on it."""
    lines: dict[int, dict[int, str]] = {}
    for x, line, text in CELL.findall(svg):
        if found := LINE.search(line):
            lines.setdefault(int(found[1]), {})[round(float(x) / COLUMN)] = unescape(text).replace("\xa0", " ")
    rows = []
    for number in range(max(lines, default=-1) + 1):
        row = ""
        for column, text in sorted(lines.get(number, {}).items()):
            row = row.ljust(column) + text
        rows.append(row.rstrip())
    return "\n".join(rows)
