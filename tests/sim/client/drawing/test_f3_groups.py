from sim.client.drawing.f3_groups import group_layers
from sim.client.drawing.letters import Letters
from sim.client.game.f3_text import F3Screen, left_lines, right_lines
from tests.sim.client.playing import FONT

SCREEN = F3Screen("26.4", 2, (0.5, 64.0, 0.5), 0.0, 0.0)


def test_names_end_and_values_begin_at_one_column_in_a_box() -> None:
    letters = Letters(FONT, 2)
    box, title, *texts = group_layers(SCREEN, letters)
    lines = [line.text for line in (*left_lines(SCREEN), *right_lines(SCREEN)) if ": " in line.text]
    names, values = texts[::2], texts[1::2]
    assert len(names) == len(values) == len(lines)
    widest = max(letters.width(line.partition(": ")[0]) for line in lines)
    assert {name.rect[2] for name in names} == {2 * (3 + widest)}
    assert {value.rect[0] for value in values} == {2 * (3 + widest + 5)}
    assert title.rect[:2] == (6, 6)
    assert box.rect[:2] == (0, 0)
    assert box.rect[2] == max(value.rect[2] for value in values) + 6


def test_each_row_is_nine_gui_pixels_below_the_one_before() -> None:
    box, title, *texts = group_layers(SCREEN, Letters(FONT, 1))
    tops = [text.rect[1] for text in (title, *texts[::2])]
    assert tops == [3 + 9 * row for row in range(len(tops))]
    assert box.rect[3] == tops[-1] + 9 + 3
    assert [text.rect[1] for text in texts[1::2]] == tops[1:]
