"""The debug screen of the 26.4 snapshots: names and values in two aligned columns, in boxes with titles.

It has the contents of older screens, and can't be read yet (FACTS: The F3 debug screen).
"""

from sim.client.drawing.layers import Blend, Layer
from sim.client.drawing.letters import Letters
from sim.client.game.f3_text import F3Screen, left_lines, right_lines

_MARGIN, _PITCH, _GAP = 3, 9, 5
_TEXT = (224, 224, 224)


def group_layers(screen: F3Screen, letters: Letters) -> list[Layer]:
    """The layers of one such screen, from the back to the front."""
    texts = [line.text for line in (*left_lines(screen), *right_lines(screen))]
    rows = [(name, value) for name, colon, value in (text.partition(": ") for text in texts) if colon]
    middle = _MARGIN + max(letters.width(name) for name, _ in rows)
    right = middle + _GAP + max(letters.width(value) for _, value in rows)
    scale = letters.scale
    box = (0, 0, (right + _MARGIN) * scale, (2 * _MARGIN + _PITCH * (len(rows) + 1)) * scale)
    layers: list[Layer] = [Blend(box, (80, 80, 80), 144), letters.text(screen.title, _MARGIN, _MARGIN, _TEXT)]
    for row, (name, value) in enumerate(rows, 1):
        top = _MARGIN + _PITCH * row
        layers.append(letters.text(name, middle - letters.width(name), top, _TEXT))
        layers.append(letters.text(value, middle + _GAP, top, _TEXT))
    return layers
