"""Every recording in this folder reads and decides as it did: drop one in, and it is a test.

``NAME.mcap`` is read with the font ``NAME.png`` beside it, or with the virtual client's own. Cut a part out of a longer
one with ``mc-nested recordings cut REC tests/recordings/NAME.mcap --no-pictures``.
"""

from pathlib import Path

import pytest

from mc_nested.live.recording.replay import replay
from mc_nested.live.vision.font import load_font
from tests.sim.client.playing import FONT

RECORDINGS = sorted(Path(__file__).parent.glob("*.mcap"))


def test_there_are_some() -> None:
    assert RECORDINGS


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.stem)
def test_it_is_read_and_decided_as_it_was(path: Path) -> None:
    font = path.with_suffix(".png")
    seen = replay(path, load_font(font) if font.is_file() else FONT)
    assert seen.differences == []
    assert seen.damaged == []
    assert seen.read_anew > 0
    assert seen.followed == seen.actions
