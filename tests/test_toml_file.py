"""TOML files: a shipped name or a path, and every mistake one line that names the file, the key and what to do."""

from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict, Field

from mc_nested.errors import PresetError, ScenarioError
from mc_nested.toml_file import parse_document, parse_toml, read_shipped_or_named, read_toml_text, table_of_key


class Door(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    height: int


class House(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    name: str = Field(max_length=5)
    door: Door | None = None
    doors: list[Door] = []
    size: tuple[int, int] = (1, 1)


def mistake_in(text: str) -> str:
    with pytest.raises(PresetError) as caught:
        parse_toml(House, text, "house.toml", PresetError)
    return str(caught.value)


def test_arrays_become_tuples() -> None:
    house = parse_toml(House, 'name = "A"\nsize = [2, 3]\n[door]\nheight = 2', "house.toml", PresetError)
    assert (house.size, house.door) == ((2, 3), Door(height=2))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("size = [2, 3]", "house.toml: name: missing: add it"),
        ('name = "A"\nnmae = 1', "house.toml: nmae: unknown key: did you mean name?"),
        ('name = "A"\nzzz = 1', "house.toml: zzz: unknown key: remove it; known are name, door, doors, size"),
        ('name = "A"\n[door]\nheigth = 1', "house.toml: door.heigth: unknown key: did you mean height?"),
        ('name = "A"\n[door]', "house.toml: door.height: missing: add it"),
        ('name = "A"\n[door]\nheight = 1\nheigth = 1', "house.toml: door.heigth: unknown key: did you mean height?"),
        (
            'name = "A"\n[[doors]]\nheight = 1\nheigth = 1',
            "house.toml: doors.0.heigth: unknown key: did you mean height?",
        ),
        ('name = "A"\ndoor = 1', "house.toml: door: must be a table: write [door] and its keys below"),
    ],
)
def test_a_mistake_names_its_key_and_the_remedy(text: str, said: str) -> None:
    assert mistake_in(text) == said


def test_a_wrong_value_is_shown_shortened() -> None:
    assert mistake_in('name = "abcdef"').endswith("not 'abcdef': mend that key")
    long = mistake_in(f'name = "{"a" * 100}"')
    assert long.endswith(f"not '{'a' * 56}...: mend that key")


def test_text_that_is_not_toml_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"^x\.toml: not TOML \(.*\): mend that line"):
        parse_document("= 1", "x.toml", ScenarioError)


@pytest.mark.parametrize("text", ["a = 1\nb = ", 'a = 1\nb = "x', "a = 1\nb = [1,", "a = 1\n[tab", "a = 1\nb"])
def test_a_truncated_text_is_refused_with_the_number_of_its_last_line(text: str) -> None:
    with pytest.raises(ScenarioError) as told:
        parse_document(text, "x.toml", ScenarioError)
    assert "\\x00" not in str(told.value)
    assert str(told.value).startswith("x.toml: not TOML")
    assert "line 2" in str(told.value)


def test_a_shipped_name_comes_first_and_a_path_after(tmp_path: Path) -> None:
    def text_of(name: str | Path) -> str:
        return read_shipped_or_named(name, "preset", "mc_nested.learn.presets", ["paper"], PresetError)

    assert "episodes = 3000" in text_of("paper")
    own = tmp_path / "own.toml"
    own.write_bytes(b"\xef\xbb\xbfa = 1")  # with a byte order mark, as some editors write it
    assert text_of(own) == "a = 1"
    with pytest.raises(PresetError, match=r"no preset 'other': name one of paper, or a TOML file that exists$"):
        text_of("other")
    with pytest.raises(PresetError, match=r"did you mean .*own\.toml\?$"):
        text_of(tmp_path / "own")


def test_an_unreadable_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(PresetError, match="can't be read, it is not UTF-8 text"):
        read_toml_text(tmp_path / "x.toml", PresetError)
    with pytest.raises(PresetError, match="can't be read, No such file"):
        read_toml_text(tmp_path / "none.toml", PresetError)


def test_table_of_key_finds_the_table_of_an_optional_key() -> None:
    assert table_of_key(House, "door") is Door
    assert table_of_key(House, "name") is None
    assert table_of_key(House, "roof") is None
