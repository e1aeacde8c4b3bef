"""The reference of the Env, as the registered environment is."""

from scripts.documentation.env_reference import markdown


def test_it_says_what_goes_in_and_what_comes_out() -> None:
    page = markdown()
    assert "| `scenario` |" in page
    assert "| action | `Discrete(8)` |" in page
    assert "| 7 | `B+D` | a cell back, then a block in front of the agent |" in page
    assert "| `placed` | `tuple[int, int]` | Where a block landed; not there if none did. |" in page
    assert "Render modes: `rgb_array`, `ansi`." in page
